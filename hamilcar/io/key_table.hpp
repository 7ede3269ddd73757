// What a file may hold: every table with its keys, as the readers ask for them, and what depends on a choice in the
// file.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace hamilcar::io {

using Json = nlohmann::ordered_json;  // keys in the order in which they are read

// Stands for a word that a person invents, the name of a tire or of a part. As a key: any key that is not known.
inline constexpr std::string_view any_name = "NAME";

// What kind of value; a key may allow several: a number or a list of numbers.
struct Shape {
    enum : unsigned { number = 1, numbers = 2, flag = 4, text = 8, texts = 16, table = 32, tables = 64 };
};

// What a value may be.
struct ValueRule {
    unsigned shapes = 0;  // none: its presence alone was asked for
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool least_included = true;
    bool is_whole = false;           // no fraction
    std::size_t count = 0;           // of numbers in a list; 0: any but none
    std::vector<std::string> words;  // one of these; none: any text
    std::variant<std::monostate, bool, double, std::string, std::vector<double>> otherwise;  // in the key's unit

    bool operator==(const ValueRule&) const = default;
};

// What a key means in a suspension or, without one, everywhere.
struct Meaning {
    std::string text, where;
    bool operator==(const Meaning&) const = default;
};

struct TableRecord;

struct KeyRecord {
    std::string key;
    ValueRule value;
    std::vector<std::string> expectations;  // the value in words: "a positive number [kg]"
    std::vector<Meaning> meanings;
    bool required = false;
    std::vector<TableRecord> below;  // one: the table, or each table of a list
};

struct TableRecord {
    std::vector<KeyRecord> keys;
    std::vector<Json> choices;  // schemas that hold beside the keys: "if this word stands here, then ..."

    KeyRecord* find(std::string_view key);
    const KeyRecord* find(std::string_view key) const;
};

// Either of two records is allowed: the union of the keys and values; required, and chosen by, is what both want.
void join(TableRecord& to, const TableRecord& other);
void join(KeyRecord& to, const KeyRecord& other);

using TablePath = std::vector<std::string>;  // keys that lead to a table from the root; all tables of a list are one

TableRecord& table_at(TableRecord& root, const TablePath& path);

// Paths of the tables whose keys or choices differ, other than in `ignored` of the table at `owner`.
std::vector<TablePath> differing_tables(const TableRecord& a, const TableRecord& b, const TablePath& owner,
                                        std::string_view ignored);

}  // namespace hamilcar::io
