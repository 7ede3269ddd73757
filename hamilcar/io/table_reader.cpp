// Lookups with checks. The message about a value is made in `reject`, the one about a key in `require` and `finish`.
#include "hamilcar/io/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "hamilcar/io/key_recorder.hpp"
#include "hamilcar/io/key_unit.hpp"
#include "hamilcar/io/number_text.hpp"
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

// An entry of a list of tables goes by its name, if it has one.
std::string item_path(const std::string& list, Node& item, std::size_t index) {
    const Node* name = item.find("name");
    const auto* label = name ? std::get_if<std::string>(&name->value) : nullptr;
    return label ? list + "[" + *label + "]" : at_index(list, index);
}

constexpr double nobodys = std::numeric_limits<double>::quiet_NaN();  // a number, where there is no file

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
    // A key that nobody has asked for yet and that looks like this one is the one that was meant.
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
    if (recorder_) recorder_->note(path_, key, meaning, where);
}

bool TableReader::has(std::string_view key) const {
    return recorder_ ? recorder_->has(path_, key) : find(key) != nullptr;
}

bool TableReader::has_list(std::string_view key) const {
    if (recorder_) return recorder_->has_list(path_, key);
    const Node* node = find(key);
    return node && std::holds_alternative<ListValue>(node->value);
}

std::size_t TableReader::chosen(Alternatives groups) const {
    if (recorder_) return recorder_->chosen(path_, groups);
    std::size_t choice = 0;
    const Node* best = nullptr;
    for (std::size_t index = 0; index < groups.size(); ++index) {
        for (const std::string_view key : groups.begin()[index]) {
            const Node* node = find(key);
            if (!node) continue;
            if (best && choice != index && best->file == node->file) {
                reject(*node, full(key), "either this or '" + best->key + "', not both");
            }
            if (!best || node->file->generation < best->file->generation) best = node, choice = index;
        }
    }
    return choice;
}

double TableReader::checked(const Node& value, std::string_view key, const std::string& path,
                            const Range& range) const {
    const double* number = std::get_if<double>(&value.value);
    if (!number) reject(value, path, describe(range, key));
    if (!std::isfinite(*number)) reject(value, path, with_unit("a finite " + std::string(range.words), key));
    const bool enough = range.least_included ? *number >= range.least : *number > range.least;
    const bool fits = !range.is_whole || *number == std::floor(*number);
    if (!enough || *number > range.most || !fits) reject(value, path, describe(range, key));
    return *number * unit_of_key(key).to_si;
}

double TableReader::number(std::string_view key, const Range& range) const {
    if (recorder_) return recorder_->number(path_, key, range, {}), nobodys;
    return checked(require(key, describe(range, key)), key, full(key), range);
}

double TableReader::number(std::string_view key, const Range& range, double otherwise) const {
    if (recorder_) return recorder_->number(path_, key, range, otherwise), otherwise;
    return has(key) ? number(key, range) : otherwise;
}

bool TableReader::boolean(std::string_view key, bool otherwise) const {
    if (recorder_) return recorder_->flag(path_, key, otherwise);
    const Node* node = find(key);
    if (!node) return otherwise;
    if (!std::holds_alternative<bool>(node->value)) reject(*node, full(key), "true or false");
    return std::get<bool>(node->value);
}

std::string TableReader::text(std::string_view key) const {
    if (recorder_) return recorder_->text(path_, key), std::string(any_name);
    const Node& node = require(key, "a text in quotes");
    const auto* value = std::get_if<std::string>(&node.value);
    if (!value || value->empty()) reject(node, full(key), "a text in quotes");
    return *value;
}

std::vector<std::string> TableReader::texts(std::string_view key) const {
    std::vector<std::string> result;
    if (recorder_) return recorder_->texts(path_, key), result;
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
    if (recorder_) return written;
    return (std::filesystem::path(find(key)->file->path).parent_path() / written).lexically_normal().string();
}

ListValue& TableReader::list(std::string_view key, const std::string& expectation) const {
    Node& node = require(key, expectation);
    auto* value = std::get_if<ListValue>(&node.value);
    if (!value) reject(node, full(key), expectation);
    return *value;
}

void TableReader::fill(std::string_view key, std::span<double> values) const {
    if (recorder_) {
        std::ranges::fill(values, nobodys);
        return recorder_->numbers(path_, key, any_number, values.size(), {});
    }
    const std::string expectation = with_unit(std::to_string(values.size()) + " numbers", key);
    const auto& items = list(key, expectation).items;
    if (items.size() != values.size()) reject(*find(key), full(key), expectation);
    for (std::size_t i = 0; i < items.size(); ++i) {
        values[i] = checked(items[i], key, at_index(full(key), i), any_number);
    }
}

void TableReader::fill_if_there(std::string_view key, std::span<double> values) const {
    if (recorder_) return recorder_->numbers(path_, key, any_number, values.size(), values);
    if (has(key)) fill(key, values);
}

std::array<double, 3> TableReader::direction(std::string_view key) const {
    std::array<double, 3> v = array<3>(key);
    const double length = std::hypot(v[0], v[1], v[2]);
    expect(length > 0, key, "a direction: at least one component that is not zero");
    for (double& component : v) component /= length;
    return v;
}

std::array<double, 3> TableReader::direction(std::string_view key, const std::array<double, 3>& otherwise) const {
    if (recorder_) return array<3>(key, otherwise);
    return has(key) ? direction(key) : otherwise;
}

std::array<double, 3> TableReader::unit_direction(std::string_view key) const {
    constexpr double off = 0.01;  // what typing with two digits leaves
    const std::array<double, 3> v = direction(key);
    if (recorder_) return v;
    const std::array<double, 3> written = array<3>(key);
    const double length = std::hypot(written[0], written[1], written[2]);
    expect(std::abs(length - 1) <= off, key,
           "a unit vector, since it is a direction and no ratio (here its length is " + number_text(length) + ")");
    return v;
}

std::array<double, 3> TableReader::unit_direction(std::string_view key, const std::array<double, 3>& otherwise) const {
    if (recorder_) return array<3>(key, otherwise);
    return has(key) ? unit_direction(key) : otherwise;
}

std::vector<double> TableReader::numbers(std::string_view key, const Range& range) const {
    std::vector<double> result;
    if (recorder_) return recorder_->numbers(path_, key, range, 0, {}), std::vector{nobodys, nobodys};
    for (const Node& item : list(key, with_unit("a list of numbers", key)).items) {
        result.push_back(checked(item, key, at_index(full(key), result.size()), range));
    }
    expect(!result.empty(), key, "a list of at least one number");
    return result;
}

Samples TableReader::samples(std::string_view argument, std::string_view value, const Range& range) const {
    const std::vector<double> x = numbers(argument, any_number), y = numbers(value, range);
    if (recorder_) return {x, y};
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

std::size_t TableReader::one_of(std::string_view key, std::span<const std::string_view> words,
                                std::optional<std::size_t> otherwise) const {
    if (recorder_) return recorder_->one_of(path_, key, words, otherwise);
    if (otherwise && !has(key)) return *otherwise;
    const std::string expectation = (words.size() > 1 ? "one of " : "") + quoted_list(words);
    const Node& node = require(key, expectation);
    const auto* value = std::get_if<std::string>(&node.value);
    if (!value) reject(node, full(key), expectation);
    const auto found = std::ranges::find(words, *value);
    if (found == words.end()) {
        const std::string hint = words.size() > 1 ? did_you_mean(*value, words) : "";
        reject(node, full(key), expectation + (hint.empty() ? "" : "; " + hint));
    }
    return static_cast<std::size_t>(found - words.begin());
}

TableReader TableReader::table(std::string_view key) const {
    if (recorder_) return TableReader(*recorder_, recorder_->table(path_, key));
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
    if (recorder_) {
        for (const std::string& place : recorder_->tables(path_, key)) result.emplace_back(*recorder_, place);
        return result;
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
    if (recorder_) return {{std::string(any_name), parent.table(any_name)}};
    for (const Node& entry : as_table(*parent.node_).entries) result.emplace_back(entry.key, parent.table(entry.key));
    return result;
}

std::vector<std::pair<std::string, double>> TableReader::named_numbers() const {
    if (recorder_) return {{std::string(any_name), number(any_name, any_number)}};
    std::vector<std::pair<std::string, double>> result;
    for (const Node& entry : as_table(*node_).entries) {
        number(entry.key, any_number);  // checks and knows it
        result.emplace_back(entry.key, std::get<double>(entry.value));
    }
    return result;
}

void TableReader::expect(bool condition, std::string_view key, const std::string& expectation) const {
    if (condition || recorder_) return;
    reject(require(key, expectation), full(key), with_unit(expectation, key));
}

void TableReader::finish_below(Node& entry, const std::string& path) {
    if (auto* list = std::get_if<ListValue>(&entry.value)) {
        std::size_t index = 0;
        for (Node& item : list->items) finish_below(item, item_path(path, item, index++));
    } else if (auto* table = std::get_if<TableValue>(&entry.value); table && !table->known.empty()) {
        TableReader(entry, path).finish();  // a table nobody read is an alternative that was overridden
    }
}

void TableReader::finish() const {
    if (recorder_) return;
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
