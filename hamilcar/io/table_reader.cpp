// Lookups with checks. The message about a value is made in `reject`, the one about a key in `require` and `finish`.
#include "hamilcar/io/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>

#include "hamilcar/base/key_unit.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/key_record.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

TableValue& as_table(Node& node) {
    return std::get<TableValue>(node.value);
}

bool is_known(Node& table, std::string_view key) {
    return std::ranges::find(as_table(table).known, key) != as_table(table).known.end();
}

std::string at_index(const std::string& path, std::size_t index) {
    return path + "[" + std::to_string(index) + "]";
}

// What was asked for in one table counts as asked in another one, and in those below.
void take_known(Node& from, Node& to) {
    auto *list = std::get_if<ListValue>(&to.value), *items = std::get_if<ListValue>(&from.value);
    if (list && items) {
        std::unordered_map<std::string, Node*> by_path;  // a list of a hostile file is long
        for (std::size_t i = 0; i < items->items.size(); ++i)
            by_path[item_path("", items->items[i], i)] = &items->items[i];
        for (std::size_t i = 0; i < list->items.size(); ++i) {
            const auto same = by_path.find(item_path("", list->items[i], i));
            if (same != by_path.end()) take_known(*same->second, list->items[i]);
        }
        return;
    }
    if (!std::holds_alternative<TableValue>(to.value) || !std::holds_alternative<TableValue>(from.value)) return;
    for (const std::string& key : as_table(from).known) as_table(to).known.push_back(key);
    for (Node& entry : as_table(to).entries) {
        if (Node* same = from.find(entry.key)) take_known(*same, entry);
    }
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();  // a number, where there is no file

std::string describe(const Range& range, std::string_view key) {
    return with_unit("a " + std::string(range.words), key);
}

}  // namespace

std::string TableReader::full(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

void TableReader::reject(const Node& value, const std::string& path, const std::string& expectation) const {
    fail_at(*value.file, value.begin, "key '" + path + "' = " + value.written() + ": expected " + expectation);
}

Node* TableReader::find(std::string_view key) const {
    if (!is_known(*node_, key)) as_table(*node_).known.emplace_back(key);
    return node_->find(key);
}

Node& TableReader::require(std::string_view key, const std::string& expectation) const {
    if (Node* node = find(key)) return *node;
    // A key that has not been asked for yet and that looks like this one is the one that was meant.
    for (const Node& entry : as_table(*node_).entries) {
        const std::string_view candidate = entry.key;
        if (is_known(*node_, candidate) || !nearest_word(key, {&candidate, 1})) continue;
        fail_at(*entry.file, entry.key_begin,
                "key '" + full(candidate) + "' = " + entry.written() + " is unknown: did you mean '" +
                    std::string(key) + "', " + expectation + "?");
    }
    fail_at(*node_->file, node_->begin, "key '" + full(key) + "' is missing: expected " + expectation);
}

void TableReader::note(std::string_view key, std::string_view meaning, std::string_view where) const {
    if (record_) record_->note(key, meaning, where);
}

bool TableReader::has(std::string_view key) const {
    if (record_) return record_->has(key), true;
    return find(key) != nullptr;
}

double TableReader::checked(const Node& value, std::string_view key, const std::string& path,
                            const Range& range) const {
    const double* number = std::get_if<double>(&value.value);
    if (!number) reject(value, path, describe(range, key));
    if (!std::isfinite(*number)) reject(value, path, with_unit("a finite " + std::string(range.words), key));
    const bool enough = range.min_included ? *number >= range.min : *number > range.min;
    const bool fits = !range.is_whole || *number == std::floor(*number);
    if (!enough || *number > range.max || !fits) reject(value, path, describe(range, key));
    return *number * unit_of_key(key).to_si;
}

double TableReader::number(std::string_view key, const Range& range) const {
    if (record_) return record_->number(key, range, {}), no_number;
    return checked(require(key, describe(range, key)), key, full(key), range);
}

double TableReader::number(std::string_view key, const Range& range, double fallback) const {
    if (record_) return record_->number(key, range, fallback), fallback;
    return has(key) ? number(key, range) : fallback;
}

std::optional<double> TableReader::number_or(std::string_view word, std::string_view key, const Range& range) const {
    if (record_) return record_->number_or(word, key, range), no_number;
    const std::string expectation = describe(range, key) + " or '" + std::string(word) + "'";
    const Node& node = require(key, expectation);
    const auto* text = std::get_if<std::string>(&node.value);
    if (!text) return checked(node, key, full(key), range);
    if (*text != word) reject(node, full(key), expectation);
    return {};
}

bool TableReader::boolean(std::string_view key, bool fallback) const {
    if (record_) return record_->flag(key, fallback), fallback;
    const Node* node = find(key);
    if (!node) return fallback;
    if (!std::holds_alternative<bool>(node->value)) reject(*node, full(key), "true or false");
    return std::get<bool>(node->value);
}

std::string TableReader::text(std::string_view key) const {
    if (record_) return record_->text(key), std::string(any_name);
    const Node& node = require(key, "a text in quotes");
    const auto* value = std::get_if<std::string>(&node.value);
    if (!value || value->empty()) reject(node, full(key), "a text in quotes");
    return *value;
}

std::vector<std::string> TableReader::texts(std::string_view key) const {
    std::vector<std::string> result;
    if (record_) return record_->texts(key), result;
    if (!has(key)) return result;
    for (const Node& item : list(key, "a list of texts in quotes").items) {
        const auto* value = std::get_if<std::string>(&item.value);
        if (!value || value->empty()) reject(item, at_index(full(key), result.size()), "a text in quotes");
        result.push_back(*value);
    }
    return result;
}

std::string TableReader::path_to_file(std::string_view key) const {
    const std::filesystem::path written = text(key);
    if (record_) return written;
    return (std::filesystem::path(find(key)->file->path).parent_path() / written).lexically_normal().string();
}

ListValue& TableReader::list(std::string_view key, const std::string& expectation) const {
    Node& node = require(key, expectation);
    auto* value = std::get_if<ListValue>(&node.value);
    if (!value) reject(node, full(key), expectation);
    return *value;
}

void TableReader::fill(std::string_view key, std::span<double> values) const {
    if (record_) {
        std::ranges::fill(values, no_number);
        return record_->numbers(key, any_number, values.size(), {});
    }
    const std::string expectation = with_unit(std::to_string(values.size()) + " numbers", key);
    const auto& items = list(key, expectation).items;
    if (items.size() != values.size()) reject(*find(key), full(key), expectation);
    for (std::size_t i = 0; i < items.size(); ++i) {
        values[i] = checked(items[i], key, at_index(full(key), i), any_number);
    }
}

void TableReader::fill_if_there(std::string_view key, std::span<double> values) const {
    if (record_) return record_->numbers(key, any_number, values.size(), values);
    if (has(key)) fill(key, values);
}

std::array<double, 3> TableReader::direction(std::string_view key) const {
    std::array<double, 3> v = array<3>(key);
    const double length = std::hypot(v[0], v[1], v[2]);
    expect(length > 0, key, "a direction: at least one component that is not zero");
    for (double& component : v) component /= length;
    return v;
}

std::array<double, 3> TableReader::direction(std::string_view key, const std::array<double, 3>& fallback) const {
    if (record_) return array<3>(key, fallback);
    return has(key) ? direction(key) : fallback;
}

std::array<double, 3> TableReader::unit_direction(std::string_view key) const {
    constexpr double off = 0.01;  // what typing with two digits leaves
    const std::array<double, 3> v = direction(key);
    if (record_) return v;
    const std::array<double, 3> written = array<3>(key);
    const double length = std::hypot(written[0], written[1], written[2]);
    expect(std::abs(length - 1) <= off, key,
           "a unit vector, since it is a direction and no ratio (here its length is " + number_text(length) + ")");
    return v;
}

std::array<double, 3> TableReader::unit_direction(std::string_view key, const std::array<double, 3>& fallback) const {
    if (record_) return array<3>(key, fallback);
    return has(key) ? unit_direction(key) : fallback;
}

std::vector<double> TableReader::numbers(std::string_view key, const Range& range) const {
    std::vector<double> result;
    if (record_) return record_->numbers(key, range, 0, {}), std::vector{no_number, no_number};
    for (const Node& item : list(key, with_unit("a list of numbers", key)).items) {
        result.push_back(checked(item, key, at_index(full(key), result.size()), range));
    }
    expect(!result.empty(), key, "a list of at least one number");
    return result;
}

Samples TableReader::samples(std::string_view argument, std::string_view value, const Range& range) const {
    const std::vector<double> x = numbers(argument, any_number), y = numbers(value, range);
    if (record_) return {x, y};
    const auto& items = std::get<ListValue>(find(argument)->value).items;
    for (std::size_t i = 1; i < x.size(); ++i) {
        if (x[i] > x[i - 1]) continue;
        const std::string expectation = "a number above the one before, " + items[i - 1].written();
        reject(items[i], at_index(full(argument), i), with_unit(expectation, argument));
    }
    const std::string count = std::to_string(x.size());
    expect(y.size() == x.size(), value, count + " numbers, one for each of '" + std::string(argument) + "'");
    return {x, y};
}

TableReader TableReader::table(std::string_view key) const {
    if (record_) return TableReader(record_->table(key, Shape::table), full(key));
    Node& node = require(key, "a table");
    if (!std::holds_alternative<TableValue>(node.value)) reject(node, full(key), "a table");
    return {node, full(key)};
}

std::optional<TableReader> TableReader::optional_table(std::string_view key) const {
    return has(key) ? std::optional(table(key)) : std::nullopt;
}

std::vector<TableReader> TableReader::tables(std::string_view key) const {
    const std::string expectation = "at least one [[" + full(key) + "]]";
    std::vector<TableReader> result;
    if (record_) {  // two, so that a second one may name the first
        const TableReader each(record_->table(key, Shape::tables), full(key));
        return {each, each};
    }
    for (Node& item : list(key, expectation).items) {
        const std::string path = item_path(full(key), item, result.size());
        if (!std::holds_alternative<TableValue>(item.value)) reject(item, path, "a table");
        result.emplace_back(item, path);
    }
    expect(!result.empty(), key, expectation);
    return result;
}

std::vector<std::pair<std::string, TableReader>> TableReader::named_tables(std::string_view key) const {
    const TableReader parent = table(key);
    std::vector<std::pair<std::string, TableReader>> result;
    if (record_) return {{std::string(any_name), parent.table(any_name)}};
    for (const Node& entry : as_table(*parent.node_).entries) result.emplace_back(entry.key, parent.table(entry.key));
    return result;
}

NamedValues TableReader::named_values() const {
    if (record_) return record_->value(any_name), NamedValues{{std::string(any_name), no_number}};
    NamedValues result;
    for (const Node& entry : as_table(*node_).entries) {
        const Node& known = require(entry.key, "");
        if (const auto* flag = std::get_if<bool>(&known.value)) {
            result.emplace(entry.key, *flag ? "yes" : "no");
        } else if (const auto* word = std::get_if<std::string>(&known.value)) {
            result.emplace(entry.key, *word);
        } else {
            number(entry.key, any_number);  // checks it
            result.emplace(entry.key, std::get<double>(known.value));
        }
    }
    return result;
}

std::string TableReader::text_if_there(std::string_view key) const {
    const Node* node = record_ ? nullptr : node_->find(key);
    const auto* value = node ? std::get_if<std::string>(&node->value) : nullptr;
    return value ? *value : "";
}

std::optional<TableReader> TableReader::laid_over(std::string_view key, std::span<const std::string_view> fixed) const {
    if (record_ || !has(key)) return {};
    const TableReader above = table(key);
    for (const std::string_view one : fixed) {
        if (const Node* node = above.node_->find(one))
            reject(*node, above.full(one), "no such key: it is one for both sides, in " + path_);
    }
    const auto own = std::make_shared<Node>(io::laid_over(*node_, key));
    TableReader out(*own, full(key));
    out.own_ = own;
    return out;
}

void TableReader::note_laid_over(std::string_view key, std::span<const std::string_view> fixed,
                                 const std::optional<TableReader>& read) const {
    if (record_) return record_->note_overlay(key, fixed);
    if (read) take_known(*read->node_, *find(key));
}

void TableReader::expect(bool condition, std::string_view key, const std::string& expectation) const {
    if (condition || record_) return;
    reject(require(key, expectation), full(key), with_unit(expectation, key));
}

void TableReader::finish_below(Node& entry, const std::string& path) {
    if (auto* list = std::get_if<ListValue>(&entry.value)) {
        std::size_t index = 0;
        for (Node& item : list->items) finish_below(item, item_path(path, item, index++));
    } else if (auto* table = std::get_if<TableValue>(&entry.value); table && !table->known.empty()) {
        TableReader(entry, path).finish();  // a table that was not read is an alternative that was overridden
    }
}

void TableReader::finish() const {
    if (record_) return;
    const TableValue& table = as_table(*node_);
    const std::vector<std::string_view> known(table.known.begin(), table.known.end());
    for (Node& entry : as_table(*node_).entries) {
        const std::string path = full(entry.key);
        if (!is_known(*node_, entry.key)) {
            const std::string hint = did_you_mean(entry.key, known);
            fail_at(*entry.file, entry.key_begin,
                    "key '" + path + "' = " + entry.written() +
                        " is unknown: " + (hint.empty() ? "expected " + quoted_list(known) : hint));
        }
        finish_below(entry, path);
    }
}

}  // namespace hamilcar::io
