#include "hamilcar/io/key_record.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "hamilcar/base/key_unit.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

ValueRule in_range(unsigned shapes, const Range& range) {
    return {.shapes = shapes,
            .min = range.min,
            .max = range.max,
            .min_included = range.min_included,
            .is_whole = range.is_whole};
}

template <class T>
void add_missing(std::vector<T>& to, const std::vector<T>& others) {
    for (const T& other : others) {
        if (std::ranges::find(to, other) == to.end()) to.push_back(other);
    }
}

// Either of two values is allowed.
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
    if (other.min <= to.min) {
        to.min_included = other.min_included || (other.min == to.min && to.min_included);
        to.min = other.min;
    }
    to.max = std::max(to.max, other.max);
    if (to.fallback != other.fallback) to.fallback = {};
}

// The key of a table, new or known, for everything but what is below.
KeyRecord& add(TableRecord& to, const KeyRecord& other) {
    KeyRecord* known = to.find(other.key);
    if (!known) known = &to.keys.emplace_back(KeyRecord{.key = other.key});
    join(known->value, other.value);
    add_missing(known->expectations, other.expectations);
    add_missing(known->meanings, other.meanings);
    if (known->each.empty()) known->each = other.each;
    known->wanted |= other.wanted, known->may_miss |= other.may_miss;
    return *known;
}

TableRecord& table_below(KeyRecord& key) {
    return key.below.empty() ? key.below.emplace_back() : key.below[0];
}

bool is_empty(const TableRecord& table) {
    return table.keys.empty() && table.choices.empty();
}

// Moves what stands in the tables of all branches to the table itself.
void move_common(TableRecord& to, const std::vector<TableRecord*>& branches) {
    const auto same_in = [](const TableRecord& table, const KeyRecord& key) {
        const KeyRecord* same = table.find(key.key);
        return same && same->value == key.value && same->required() == key.required();
    };
    for (const KeyRecord& key : std::vector(branches[0]->keys)) {
        if (!std::ranges::all_of(branches, [&](const TableRecord* branch) { return same_in(*branch, key); })) continue;
        KeyRecord& common = add(to, key);
        std::vector<TableRecord*> below;
        for (TableRecord* branch : branches) {
            add(to, *branch->find(key.key));
            if (!branch->find(key.key)->below.empty()) below.push_back(&branch->find(key.key)->below[0]);
        }
        if (!below.empty()) table_below(common);
        if (below.size() == branches.size()) move_common(common.below[0], below);
        for (TableRecord* branch : branches) {
            std::erase_if(branch->keys, [&](const KeyRecord& own) {
                return own.key == key.key && (own.below.empty() || is_empty(own.below[0]));
            });
        }
    }
    for (const Choice& choice : std::vector(branches[0]->choices)) {
        const auto has = [&](const TableRecord* branch) {
            return std::ranges::find(branch->choices, choice) != branch->choices.end();
        };
        if (!std::ranges::all_of(branches, has)) continue;
        add_missing(to.choices, {choice});
        for (TableRecord* branch : branches) std::erase(branch->choices, choice);
    }
}

}  // namespace

KeyRecord* TableRecord::find(std::string_view key) {
    return const_cast<KeyRecord*>(std::as_const(*this).find(key));
}

const KeyRecord* TableRecord::find(std::string_view key) const {
    const auto found = std::ranges::find(keys, key, &KeyRecord::key);
    return found == keys.end() ? nullptr : &*found;
}

void TableRecord::ask(std::string_view key, bool wanted, const ValueRule& value, const std::string& expectation) {
    KeyRecord asked{.key = std::string(key), .value = value, .wanted = wanted};
    if (!expectation.empty()) asked.expectations.push_back(expectation);
    for (const TableRecord* at = this; at; at = at->branch) {
        const KeyRecord* known = at->find(key);
        asked.may_miss |= known && known->may_miss;
    }
    add(here(), asked);
}

void TableRecord::has(std::string_view key) {
    ask(key, false, {}, "");
    here().find(key)->may_miss = true;
}

void TableRecord::number(std::string_view key, const Range& range, std::optional<double> fallback) {
    ValueRule rule = in_range(Shape::number, range);
    const double written = fallback.value_or(0) / unit_of_key(key).to_si;
    const bool enough = range.min_included ? written >= range.min : written > range.min;
    if (fallback && enough && written <= range.max) rule.fallback = written;  // or "none", or another key's value
    ask(key, !fallback, rule, with_unit("a " + std::string(range.words), key));
}

void TableRecord::number_or(std::string_view word, std::string_view key, const Range& range) {
    ValueRule rule = in_range(Shape::number | Shape::text, range);
    rule.words = {std::string(word)};
    ask(key, true, rule, with_unit("a " + std::string(range.words), key) + " or '" + std::string(word) + "'");
}

void TableRecord::numbers(std::string_view key, const Range& range, std::size_t count,
                          std::span<const double> fallback) {
    ValueRule rule = in_range(Shape::numbers, range);
    rule.count = count;
    std::vector<double> written;
    for (const double value : fallback) written.push_back(value / unit_of_key(key).to_si);
    const bool from_elsewhere = std::ranges::any_of(written, [](double value) { return std::isnan(value); });
    if (!written.empty() && !from_elsewhere) rule.fallback = written;
    ask(key, fallback.empty(), rule,
        with_unit(count > 0 ? std::to_string(count) + " numbers" : "a list of numbers", key));
    here().find(key)->each = with_unit("a " + std::string(range.words), key);
}

void TableRecord::flag(std::string_view key, bool fallback) {
    ask(key, false, {.shapes = Shape::flag, .fallback = fallback}, "true or false");
}

void TableRecord::text(std::string_view key) {
    ask(key, true, {.shapes = Shape::text}, "a text in quotes");
}

void TableRecord::value(std::string_view key) {
    ask(key, true, {.shapes = Shape::number | Shape::text | Shape::flag}, "a number, a word in quotes, true or false");
}

void TableRecord::texts(std::string_view key) {
    ask(key, false, {.shapes = Shape::texts}, "a list of texts in quotes");
}

// Names that a person invents make a list of words open: any text will do.
void TableRecord::one_of(std::string_view key, std::span<const std::string_view> words,
                         std::optional<std::size_t> fallback) {
    ValueRule rule{.shapes = Shape::text};
    std::vector<std::string_view> fixed;
    std::ranges::copy_if(words, std::back_inserter(fixed), [](std::string_view word) { return word != any_name; });
    const bool open = words.empty() || fixed.size() < words.size();
    std::string expectation;  // closed lists tell their words themselves
    if (open) expectation = (fixed.empty() ? "" : quoted_list(fixed) + " or ") + "a name from this file";
    if (!open) rule.words.assign(words.begin(), words.end());
    if (fallback && words[*fallback] != any_name) rule.fallback = std::string(words[*fallback]);
    ask(key, !fallback, rule, expectation);
}

TableRecord& TableRecord::table(std::string_view key, unsigned shape) {
    ask(key, true, {.shapes = shape}, "");
    return table_below(*here().find(key));
}

void TableRecord::choose(Choice choice, std::size_t count, const std::function<void(std::size_t)>& read) {
    TableRecord& common = here();
    choice.branches.resize(count);
    std::vector<TableRecord*> branches;
    for (std::size_t i = 0; i < count; ++i) {
        branches.push_back(common.branch = &choice.branches[i]);
        read(i);
    }
    common.branch = nullptr;
    move_common(common, branches);
    if (!std::ranges::all_of(choice.branches, is_empty)) add_missing(common.choices, {choice});
}

void TableRecord::note(std::string_view key, std::string_view meaning, std::string_view where) {
    if (KeyRecord* known = here().find(key)) known->meanings = {{std::string(meaning), std::string(where)}};
}

void TableRecord::note_overlay(std::string_view key, std::span<const std::string_view> fixed) {
    if (const KeyRecord* known = find(key); known && !known->below.empty())
        return;  // by another table of the same list
    TableRecord above;
    join(above, *this);
    loosen(above);
    std::erase_if(above.keys, [&](const KeyRecord& one) {
        return one.key == key || std::ranges::find(fixed, one.key) != fixed.end();
    });
    for (KeyRecord& one : above.keys) {
        if (one.key == any_name) one.below.clear();  // which one it is, only a reader of both tables knows
    }
    has(key);
    join(table(key, Shape::table), above);
}

void loosen(TableRecord& table) {
    TableRecord all;
    join(all, table);
    table = std::move(all);
    for (KeyRecord& key : table.keys) {
        key.may_miss = true;
        if (!key.below.empty()) loosen(key.below[0]);
    }
}

void join(TableRecord& to, const TableRecord& other) {
    for (const KeyRecord& key : other.keys) {
        KeyRecord& known = add(to, key);
        if (!key.below.empty()) join(table_below(known), key.below[0]);
    }
    for (const Choice& choice : other.choices) {
        for (const TableRecord& branch : choice.branches) join(to, branch);
    }
}

void merge(TableRecord& to, const TableRecord& other) {
    for (const KeyRecord& key : other.keys) {
        KeyRecord& known = add(to, key);
        if (!key.below.empty()) merge(table_below(known), key.below[0]);
    }
    add_missing(to.choices, other.choices);
}

TableRecord record_keys(const std::function<void(const TableReader&)>& read) {
    TableRecord file;
    read(TableReader(file));
    return file;
}

}  // namespace hamilcar::io
