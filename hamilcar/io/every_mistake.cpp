#include "hamilcar/io/every_mistake.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hamilcar/base/key_unit.hpp"
#include "hamilcar/io/chosen_keys.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t most_told = 20;
constexpr std::size_t most_found =
    100;  // who gives more gave something else: looking for all of them would take its time

struct Mistake {
    bool known_key;  // those about unknown ones are told first: they may be why another is missing
    int generation;
    std::size_t line, column;
    std::string text;
};

class Comparison {
public:
    void compare(const Node& node, const std::string& path, const TableRecord& format) {
        const auto [table, unread, contradictions] = chosen_keys(node, format);
        for (const auto& [entry, other] : contradictions) {
            tell_value(*entry, full(path, entry->key), "either this or '" + other->key + "', not both");
        }
        std::vector<const Node*> unknown;
        const KeyRecord* any = table.find(any_name);
        for (const Node& entry : entries(node)) {
            const KeyRecord* key = table.find(entry.key);
            if (!key) key = any;
            if (key) {
                check(entry, full(path, entry.key), *key);
            } else if (std::ranges::find(unread, &entry) == unread.end()) {
                unknown.push_back(&entry);
            }
        }
        for (const KeyRecord& key : table.keys) {
            if (key.required() && key.key != any_name && !node.find(key.key)) tell_missing(node, path, key, unknown);
        }
        for (const Node* entry : unknown) tell_unknown(*entry, path, table);
    }

    std::vector<Mistake> mistakes;

private:
    static const std::vector<Node>& entries(const Node& table) { return std::get<TableValue>(table.value).entries; }
    static std::string full(const std::string& path, const std::string& key) {
        return path.empty() ? key : path + "." + key;
    }

    bool enough_found() const { return mistakes.size() >= most_found; }
    void tell(bool known_key, const Node& at, TextPosition position, const std::string& message) {
        try {
            fail_at(*at.file, position, message);
        } catch (const Error& error) {
            mistakes.push_back({known_key, at.file->generation, position.line, position.column, error.what()});
        }
    }
    void tell_value(const Node& value, const std::string& path, const std::string& expectation) {
        if (enough_found()) return;
        tell(true, value, value.begin, "key '" + path + "' = " + value.written() + ": expected " + expectation);
    }
    void tell_unknown(const Node& entry, const std::string& path, const TableRecord& table) {
        if (enough_found()) return;
        std::vector<std::string_view> known;
        for (const KeyRecord& key : table.keys) known.push_back(key.key);
        const std::string hint = did_you_mean(entry.key, known);
        tell(false, entry, entry.key_begin,
             "key '" + full(path, entry.key) + "' = " + entry.written() +
                 " is unknown: " + (hint.empty() ? "expected " + quoted_list(known) : hint));
    }
    // A key that is unknown and looks like this one is the one that was meant.
    void tell_missing(const Node& table, const std::string& path, const KeyRecord& key,
                      std::vector<const Node*>& unknown) {
        if (enough_found()) return;
        const auto meant = std::ranges::find_if(unknown, [&](const Node* entry) {
            const std::string_view candidate = entry->key;
            return nearest_word(key.key, {&candidate, 1}).has_value();
        });
        if (meant == unknown.end()) {
            const std::string expectation = expected(key, full(path, key.key));
            return tell(true, table, table.begin,
                        "key '" + full(path, key.key) + "' is missing: expected " + expectation);
        }
        const Node& entry = **meant;
        tell(false, entry, entry.key_begin,
             "key '" + full(path, entry.key) + "' = " + entry.written() + " is unknown: did you mean '" + key.key +
                 "', " + expected(key, full(path, key.key)) + "?");
        unknown.erase(meant);
    }
    static std::string expected(const KeyRecord& key, const std::string& path) {
        if (key.expectations.empty() && !key.value.words.empty()) {
            const std::vector<std::string_view> words(key.value.words.begin(), key.value.words.end());
            return (words.size() > 1 ? "one of " : "") + quoted_list(words);
        }
        std::string out;
        for (const std::string& one : key.expectations) out += (out.empty() ? "" : ", or ") + one;
        if (key.value.shapes & Shape::table) out += (out.empty() ? "" : ", or ") + std::string("a table");
        if (key.value.shapes & Shape::tables) out += (out.empty() ? "" : ", or ") + ("at least one [[" + path + "]]");
        return out;
    }

    void check(const Node& value, const std::string& path, const KeyRecord& key) {
        const ValueRule& rule = key.value;
        if (rule.shapes == 0) return;  // its presence alone says something
        const auto reject = [&] { tell_value(value, path, expected(key, path)); };
        if (std::holds_alternative<double>(value.value)) {
            if (!(rule.shapes & Shape::number)) return reject();
            return check_number(value, path, key);
        }
        if (std::holds_alternative<bool>(value.value)) {
            if (!(rule.shapes & Shape::flag)) reject();
        } else if (const auto* text = std::get_if<std::string>(&value.value)) {
            if (!(rule.shapes & Shape::text) || text->empty()) return reject();
            check_word(value, path, key, *text);
        } else if (const auto* list = std::get_if<ListValue>(&value.value)) {
            check_list(value, *list, path, key);
        } else if (std::holds_alternative<TableValue>(value.value)) {
            if (!(rule.shapes & Shape::table)) return reject();
            if (!key.below.empty()) compare(value, path, key.below[0]);
        } else {
            reject();
        }
    }
    void check_number(const Node& value, const std::string& path, const KeyRecord& key) {
        const double number = std::get<double>(value.value);
        const ValueRule& rule = key.value;
        const bool enough = rule.min_included ? number >= rule.min : number > rule.min;
        const bool fits = std::isfinite(number) && (!rule.is_whole || number == std::floor(number));
        const bool is_item = path.ends_with(']') && !key.each.empty();
        if (!enough || number > rule.max || !fits) tell_value(value, path, is_item ? key.each : expected(key, path));
    }
    void check_word(const Node& value, const std::string& path, const KeyRecord& key, const std::string& text) {
        const std::vector<std::string_view> words(key.value.words.begin(), key.value.words.end());
        if (words.empty() || std::ranges::find(words, text) != words.end()) return;
        const std::string hint = words.size() > 1 ? did_you_mean(text, words) : "";
        tell_value(value, path, expected(key, path) + (hint.empty() ? "" : "; " + hint));
    }
    void check_list(const Node& value, const ListValue& list, const std::string& path, const KeyRecord& key) {
        const ValueRule& rule = key.value;
        const bool tables = rule.shapes & Shape::tables, texts = rule.shapes & Shape::texts,
                   numbers = rule.shapes & Shape::numbers;
        const bool enough = texts || (rule.count > 0 ? list.items.size() == rule.count : !list.items.empty());
        if (!(tables || texts || numbers) || !enough) return tell_value(value, path, expected(key, path));
        for (std::size_t i = 0; i < list.items.size(); ++i) {
            const Node& item = list.items[i];
            const std::string place = tables ? item_path(path, item, i) : path + "[" + std::to_string(i) + "]";
            if (tables && std::holds_alternative<TableValue>(item.value)) {
                if (!key.below.empty()) compare(item, place, key.below[0]);
            } else if (numbers && std::holds_alternative<double>(item.value)) {
                check_number(item, place, key);
            } else if (!texts || !std::holds_alternative<std::string>(item.value)) {
                tell_value(item, place, tables ? "a table" : numbers ? key.each : expected(key, path));
            }
        }
    }
};

// "file:line:column: key 'x'", which tells two mistakes apart.
std::string_view place_in(std::string_view message) {
    const std::size_t key = message.find("key '");
    const std::size_t end = key == message.npos ? key : message.find('\'', key + 5);
    return message.substr(0, end);
}

}  // namespace

std::vector<std::string> mistakes_of(const Node& document, const TableRecord& format) {
    Comparison comparison;
    comparison.compare(document, "", format);
    std::ranges::stable_sort(comparison.mistakes, {}, [](const Mistake& one) {
        return std::tuple(one.known_key, one.generation, one.line, one.column);
    });
    std::vector<std::string> out;
    for (Mistake& one : comparison.mistakes) out.push_back(std::move(one.text));
    return out;
}

void with_every_mistake(const Node& document, DescribeFormat describe, const std::function<void()>& read) {
    try {
        read();
    } catch (const Error& first) {
        if (first.code() != ExitCode::bad_file) throw;
        std::vector<std::string> all = mistakes_of(document, format_of(describe));
        const auto same = std::ranges::find(all, place_in(first.what()), [](const auto& one) { return place_in(one); });
        if (same == all.end()) {
            all.insert(all.begin(), first.what());
        } else {
            *same = first.what();  // the reader knows best what it expects
        }
        if (all.size() == 1) throw;
        std::string text = std::to_string(all.size()) + (all.size() < most_found ? " mistakes" : " mistakes or more");
        for (std::size_t i = 0; i < std::min(all.size(), most_told); ++i) text += "\n" + all[i];
        if (all.size() > most_told) text += "\nand " + std::to_string(all.size() - most_told) + " more";
        throw Error(ExitCode::bad_file, text, first.key());
    }
}

}  // namespace hamilcar::io
