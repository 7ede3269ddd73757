#include "hamilcar/io/key_table.hpp"

#include <algorithm>

namespace hamilcar::io {

namespace {

template <class T>
void add_missing(std::vector<T>& to, const std::vector<T>& others) {
    for (const T& other : others) {
        if (std::ranges::find(to, other) == to.end()) to.push_back(other);
    }
}

void join(ValueRule& to, const ValueRule& other) {
    if (to == other || other.shapes == 0) return;
    if (to.shapes == 0) {
        to = other;
        return;
    }
    const bool both_text = to.shapes & other.shapes & Shape::text;
    if (both_text && (to.words.empty() || other.words.empty())) {
        to.words.clear();
    } else {
        add_missing(to.words, other.words);
    }
    if (to.shapes & other.shapes & Shape::numbers) {
        to.count = to.count == other.count ? to.count : 0;
    } else if (other.shapes & Shape::numbers) {
        to.count = other.count;
    }
    to.shapes |= other.shapes;
    if (other.least <= to.least) {
        to.least_included = other.least_included || (other.least == to.least && to.least_included);
        to.least = other.least;
    }
    to.most = std::max(to.most, other.most);
    if (to.otherwise != other.otherwise) to.otherwise = {};
}

bool same_but_for_what_is_below(const KeyRecord& a, const KeyRecord& b) {
    return a.value == b.value && a.required == b.required && a.below.size() == b.below.size();
}

void collect(const TableRecord& a, const TableRecord& b, const TablePath& owner, std::string_view ignored,
             TablePath& here, std::vector<TablePath>& found) {
    const auto is_ignored = [&](const std::string& key) { return key == ignored && here == owner; };
    bool differ = a.choices != b.choices;
    for (const KeyRecord& key : b.keys) differ |= !is_ignored(key.key) && !a.find(key.key);
    for (const KeyRecord& key : a.keys) {
        if (is_ignored(key.key)) continue;
        const KeyRecord* other = b.find(key.key);
        differ |= !other || !same_but_for_what_is_below(key, *other);
        if (!other || key.below.empty() || other->below.empty()) continue;
        here.push_back(key.key);
        collect(key.below[0], other->below[0], owner, ignored, here, found);
        here.pop_back();
    }
    if (differ) found.push_back(here);
}

// Where tables may have any name, one of them may have the name of this key: it must have what those must have, no
// more.
void loosen_for_any_name(KeyRecord& key, const TableRecord& other) {
    const KeyRecord* any = other.find(any_name);
    if (!any || key.key == any_name || key.below.empty() || any->below.empty()) return;
    key.below[0].choices.clear();
    for (KeyRecord& inner : key.below[0].keys) {
        const KeyRecord* same = any->below[0].find(inner.key);
        inner.required = inner.required && same && same->required;
    }
}

}  // namespace

const KeyRecord* TableRecord::find(std::string_view key) const {
    const auto found = std::ranges::find(keys, key, &KeyRecord::key);
    return found == keys.end() ? nullptr : &*found;
}

KeyRecord* TableRecord::find(std::string_view key) {
    return const_cast<KeyRecord*>(std::as_const(*this).find(key));
}

void join(KeyRecord& to, const KeyRecord& other) {
    join(to.value, other.value);
    add_missing(to.expectations, other.expectations);
    add_missing(to.meanings, other.meanings);
    to.required &= other.required;
    if (to.below.empty()) {
        to.below = other.below;
    } else if (!other.below.empty()) {
        join(to.below[0], other.below[0]);
    }
}

void join(TableRecord& to, const TableRecord& other) {
    for (KeyRecord& key : to.keys) {
        if (other.find(key.key)) continue;
        key.required = false;
        loosen_for_any_name(key, other);
    }
    for (const KeyRecord& key : other.keys) {
        if (KeyRecord* same = to.find(key.key)) {
            join(*same, key);
        } else {
            to.keys.push_back(key);
            to.keys.back().required = false;
            loosen_for_any_name(to.keys.back(), to);
        }
    }
    std::erase_if(to.choices,
                  [&](const Json& choice) { return std::ranges::find(other.choices, choice) == other.choices.end(); });
}

TableRecord& table_at(TableRecord& root, const TablePath& path) {
    TableRecord* at = &root;
    for (const std::string& key : path) at = &at->find(key)->below.at(0);
    return *at;
}

std::vector<TablePath> differing_tables(const TableRecord& a, const TableRecord& b, const TablePath& owner,
                                        std::string_view ignored) {
    std::vector<TablePath> found;
    TablePath here;
    collect(a, b, owner, ignored, here, found);
    return found;
}

}  // namespace hamilcar::io
