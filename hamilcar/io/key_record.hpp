// What a file may hold: every table with its keys, as the readers ask for them, and what depends on a choice in the file.
// One run of a reader without a file makes the record: each key that the reader asks for is noted, and where its way
// depends on the file (which word is it? is the key there?) it goes all ways, one after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Stands for a word that a person invents, the name of a tire or of a part. As a key: any key that is not known.
inline constexpr std::string_view any_name = "NAME";

// What kind of value; a key may allow several: a number or a list of numbers.
struct Shape {
    enum : unsigned { number = 1, numbers = 2, flag = 4, text = 8, texts = 16, table = 32, tables = 64 };
};

// What a value may be.
struct ValueRule {
    unsigned shapes = 0;  // none: its presence alone was asked for
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool min_included = true;
    bool is_whole = false;             // no fraction
    std::size_t count = 0;             // of numbers in a list; 0: any but none
    std::vector<std::string> words{};  // one of these; none: any text
    std::variant<std::monostate, bool, double, std::string, std::vector<double>> fallback{};  // in the key's unit

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
    ValueRule value{};
    std::vector<std::string> expectations{};  // the value in words: "a positive number [kg]"
    std::string each{};                       // of a list of numbers, in words
    std::vector<Meaning> meanings{};
    bool wanted = false, may_miss = false;  // it was read as a required one; its presence was asked
    std::vector<TableRecord> below;         // one: the table, or each table of a list

    bool required() const { return wanted && !may_miss; }
    bool operator==(const KeyRecord&) const = default;
};

// A fork in a reader's way, and what is read in the table on each branch beside what is read on all of them.
struct Choice {
    enum class About { word, flag, list, group };

    About about = About::group;
    std::string key{};  // of a word, a flag or what may be a list
    std::vector<std::vector<std::string>>
        options{};                          // the word; the keys of the group, none of them in one without any
    std::optional<std::size_t> fallback{};  // the branch where the key is left out
    std::string table{};                    // that the key stands in, if it is one below
    std::vector<TableRecord> branches;      // of a flag the second where it is true, of a list where it is one

    bool operator==(const Choice&) const = default;
};

// The functions are what a TableReader asks for. A number that was not given is a NaN.
struct TableRecord {
    std::vector<KeyRecord> keys{};
    std::vector<Choice> choices{};
    TableRecord* branch = nullptr;  // on which the reader is just now

    void has(std::string_view key);
    void number(std::string_view key, const Range& range, std::optional<double> fallback);
    void number_or(std::string_view word, std::string_view key, const Range& range);
    // `count` 0: as many as one likes; a default of no numbers: none.
    void numbers(std::string_view key, const Range& range, std::size_t count, std::span<const double> fallback);
    void flag(std::string_view key, bool fallback);
    void text(std::string_view key);
    void value(std::string_view key);  // a number, a text or a flag
    void texts(std::string_view key);
    void one_of(std::string_view key, std::span<const std::string_view> words, std::optional<std::size_t> fallback);
    TableRecord& table(std::string_view key, unsigned shape);  // a table, or each table of a list
    // Goes all ways.
    void choose(Choice choice, std::size_t count, const std::function<void(std::size_t)>& read);
    // A table at `key` may hold what this one may, but for `fixed`.
    void note_overlay(std::string_view key, std::span<const std::string_view> fixed);
    // What a key means, if it was asked for.
    void note(std::string_view key, std::string_view meaning, std::string_view where);

    KeyRecord* find(std::string_view key);
    const KeyRecord* find(std::string_view key) const;
    bool operator==(const TableRecord&) const = default;

private:
    TableRecord& here() { return branch ? branch->here() : *this; }
    void ask(std::string_view key, bool wanted, const ValueRule& value, const std::string& expectation);
};

// Adds all that may stand in another record of the same table, whatever is chosen.
void join(TableRecord& to, const TableRecord& other);
// Adds what stands in another record of the same table, with its choices.
void merge(TableRecord& to, const TableRecord& other);

// What may be in a table once it is known what cannot be told from the file: with a wrong word any branch may be meant.
void loosen(TableRecord& table);

TableRecord record_keys(const std::function<void(const TableReader&)>& read);

}  // namespace hamilcar::io
