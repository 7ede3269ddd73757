// Typed access to the keys of one table. Reading a key is one line that states all there is to know about it:
//
//     .mass = chassis.number("mass_kg", positive),            required, in the key's unit, checked
//     .gravity = root.number("gravity_m_per_s2", positive, 9.80665),          optional
//
// The unit is part of the key (key_unit.hpp); numbers come back in SI, angles in radians. Every key asked for is noted,
// so `finish` can tell a misspelled key from a known one. A mistake ends the reading with one Error that says
// "file:line:column: key 'chassis.mass_kg' = -3: expected a positive number [kg]".
//
// The same calls describe the format: a reader of a TableRecord has no file, it notes what is asked for, and nothing that
// is read means anything or is a mistake. The schemas for editors are made of these notes (schema.hpp). So that they
// know what depends on what, a reader says its choices with `choose`: keys that only one word has are read in there.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hamilcar/io/toml_document.hpp"

namespace hamilcar::io {

// What a number may be, as written in the file; `words` follow "expected a".
struct Range {
    std::string_view words;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool min_included = true;
    bool is_whole = false;  // no fraction
};
inline constexpr Range any_number{"number"};
inline constexpr Range positive{"positive number", 0, std::numeric_limits<double>::infinity(), false};
inline constexpr Range not_negative{"number not below zero", 0};
inline constexpr Range fraction{"number from 0 to 1", 0, 1};
inline constexpr Range time_step{"number from 1e-6 to 0.1", 1e-6, 0.1};  // of an integration [s]

struct Samples {
    std::vector<double> argument, value;
};
using NamedValues = std::map<std::string, std::variant<double, std::string>>;
using Alternatives = std::initializer_list<std::initializer_list<std::string_view>>;

struct TableRecord;

class TableReader {
public:
    // `path` is the table's name in messages, "axle[front].spring"; empty for a whole file.
    TableReader(Node& table, std::string path) : node_(&table), path_(std::move(path)) {}
    explicit TableReader(TableRecord& record, std::string path = "") : record_(&record), path_(std::move(path)) {}

    // There is no file: checks of what several values mean together have to be left out.
    bool is_recording() const { return record_ != nullptr; }
    // What a key means, for the schema; `where` is the suspension, if it means that only there.
    void note(std::string_view key, std::string_view meaning, std::string_view where = {}) const;

    bool has(std::string_view key) const;

    // What is read depends on the file: on the position of a text among `words`, a flag, whether a key is there or is a
    // list. `read` is called with the one that it is, and with each where there is no file.
    using Branches = std::function<void(std::size_t)>;
    using FlagBranches = std::function<void(bool)>;
    void choose(std::string_view key, std::span<const std::string_view> words, std::optional<std::size_t> fallback,
                const Branches& read) const;
    // `owner` is the table whose keys depend on it, this one or the one that this one stands in.
    void choose_flag(std::string_view key, bool fallback, const TableReader& owner, const FlagBranches& read) const;
    void choose_list(std::string_view key, const FlagBranches& read) const;
    void choose_presence(std::string_view key, const FlagBranches& read) const;
    // Which of several groups of keys that state the same thing differently is present; the first if none is. Two in
    // one file are a mistake; a file's own choice overrides the one it inherits.
    void choose(Alternatives groups, const Branches& read) const;

    double number(std::string_view key, const Range& range) const;
    double number(std::string_view key, const Range& range, double fallback) const;
    // Where the key is left out, what follows from others: no constant that a schema could tell.
    double number_or_else(std::string_view key, const Range& range, double otherwise) const {
        return has(key) ? number(key, range) : otherwise;
    }
    // Nothing where the word stands in the number's place.
    std::optional<double> number_or(std::string_view word, std::string_view key, const Range& range) const;
    bool boolean(std::string_view key, bool fallback) const;
    std::string text(std::string_view key) const;
    // What stands there as a text, for a look ahead; empty otherwise.
    std::string text_if_there(std::string_view key) const;
    std::vector<std::string> texts(std::string_view key) const;  // empty if absent
    // The text as a path, resolved against the folder of the file that it stands in.
    std::string path_to_file(std::string_view key) const;

    template <std::size_t N>
    std::array<double, N> array(std::string_view key) const {  // a list of exactly N numbers
        std::array<double, N> values{};
        fill(key, values);
        return values;
    }
    template <std::size_t N>
    std::array<double, N> array(std::string_view key, const std::array<double, N>& fallback) const {
        std::array<double, N> values = fallback;
        fill_if_there(key, values);
        return values;
    }
    std::array<double, 3> direction(std::string_view key) const;  // of any length; made a unit vector
    std::array<double, 3> direction(std::string_view key, const std::array<double, 3>& fallback) const;
    // Where somebody might take the length for a ratio, as of a rack: expected to be one, within 1 percent.
    std::array<double, 3> unit_direction(std::string_view key) const;
    std::array<double, 3> unit_direction(std::string_view key, const std::array<double, 3>& fallback) const;
    std::vector<double> numbers(std::string_view key, const Range& range) const;
    // Two lists of equal length, the first strictly increasing.
    Samples samples(std::string_view argument, std::string_view value, const Range& range) const;

    // Position of the text among `words`. Without `fallback` the key is required.
    std::size_t one_of(std::string_view key, std::span<const std::string_view> words,
                       std::optional<std::size_t> fallback = {}) const;

    TableReader table(std::string_view key) const;
    std::optional<TableReader> optional_table(std::string_view key) const;
    std::vector<TableReader> tables(std::string_view key) const;  // of a list with at least one
    // The tables of a table of tables, whatever their keys are: [tire.summer], [tire.winter].
    std::vector<std::pair<std::string, TableReader>> named_tables(std::string_view key) const;
    // All keys of this table, whatever they are, with their numbers or words as written; who takes them knows their units.
    // True and false are the words "yes" and "no".
    NamedValues named_values() const;

    // This table with the keys of the one at `key` laid over it, among which none of `fixed` may be; nothing where there is none. What
    // was read from it is then to be told to `note_laid_over`, which knows the keys of the one at `key` by it. Without a file the latter
    // notes that the one at `key` may hold what this one may.
    std::optional<TableReader> laid_over(std::string_view key, std::span<const std::string_view> fixed) const;
    void note_laid_over(std::string_view key, std::span<const std::string_view> fixed,
                        const std::optional<TableReader>& read) const;

    // A mistake unless `condition`; `expectation` is a phrase, the unit is added.
    void expect(bool condition, std::string_view key, const std::string& expectation) const;
    // After everything was read: keys that were not asked for, here and in all tables below, are mistakes.
    void finish() const;

private:
    std::size_t chosen(Alternatives groups) const;
    Node* find(std::string_view key) const;  // and note the key as known
    Node& require(std::string_view key, const std::string& expectation) const;
    ListValue& list(std::string_view key, const std::string& expectation) const;
    void fill(std::string_view key, std::span<double> values) const;
    void fill_if_there(std::string_view key, std::span<double> values) const;
    double checked(const Node& value, std::string_view key, const std::string& path, const Range& range) const;
    std::string full(std::string_view key) const;
    static void finish_below(Node& entry, const std::string& path);
    [[noreturn]] void reject(const Node& value, const std::string& path, const std::string& expectation) const;

    Node* node_ = nullptr;
    std::shared_ptr<Node> own_{};    // where it stands in no document
    TableRecord* record_ = nullptr;  // instead of a file
    std::string path_;
};

}  // namespace hamilcar::io
