// Stands in for a file that is not there: one run of a reader against it notes every key that the reader asks for.
// Where the reader's way depends on the file (is the key there? which word is it?) the recorder takes the decision that
// it was told to take, and notes that there was one.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/io/key_table.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// A fork in a reader's way.
struct Decision {
    enum class About { presence, list, flag, word, group };

    About about = About::presence;
    TablePath table;
    std::string key;
    std::vector<std::vector<std::string>> options;  // of a word: the word; of a group of keys: the keys
    std::optional<std::size_t> otherwise;           // the option that a flag or a word takes where it is left out
    std::size_t taken = 0;                          // presence: 0 it is there, list: 1 it is one, flag: 1 it is true

    std::string id() const;
};

using Answers = std::map<std::string, std::size_t>;  // to decisions, by their ids; the first option if not among them

class KeyRecorder {
public:
    explicit KeyRecorder(Answers answers) : answers_(std::move(answers)) {}

    // What a TableReader asks for, in the table at `place`. A number that nobody gave is a NaN.
    bool has(const std::string& place, std::string_view key);
    bool has_list(const std::string& place, std::string_view key);
    std::size_t chosen(const std::string& place, Alternatives groups);
    void number(const std::string& place, std::string_view key, const Range& range, std::optional<double> otherwise);
    // `count` 0: as many as one likes; a default of no numbers: none.
    void numbers(const std::string& place, std::string_view key, const Range& range, std::size_t count,
                 std::span<const double> otherwise);
    bool flag(const std::string& place, std::string_view key, bool otherwise);
    void text(const std::string& place, std::string_view key);
    void texts(const std::string& place, std::string_view key);
    std::size_t one_of(const std::string& place, std::string_view key, std::span<const std::string_view> words,
                       std::optional<std::size_t> otherwise);
    // Places of tables; of a list there are always two, so that a second one may name the first.
    std::string table(const std::string& place, std::string_view key);
    std::vector<std::string> tables(const std::string& place, std::string_view key);

    // What a key means, if it was asked for.
    void note(const std::string& place, std::string_view key, std::string_view meaning, std::string_view where);

    const std::vector<Decision>& decisions() const { return decisions_; }
    // All that was asked for; the tables of a list joined to one.
    TableRecord record() const { return record_at(""); }

private:
    struct Instance {
        TablePath path;
        TableRecord record;
        std::set<std::string, std::less<>> may_miss;  // keys whose presence was asked
        std::map<std::string, std::vector<std::string>> below;
    };

    KeyRecord& ask(const std::string& place, std::string_view key, bool required, const ValueRule& value,
                   const std::string& expectation);
    std::size_t decide(const std::string& place, Decision decision, std::size_t usual);
    void add_below(const std::string& place, std::string_view key, const std::string& below);
    TableRecord record_at(const std::string& place) const;

    Answers answers_;
    std::map<std::string, Instance> instances_{{"", {}}};
    std::vector<Decision> decisions_;
    std::set<std::string> met_;
};

}  // namespace hamilcar::io
