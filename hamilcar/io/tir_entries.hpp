// The entries of a tire property file, by key in whatever section they stand, and what is to be said about them: each is used,
// or listed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamilcar/io/property_file.hpp"

namespace hamilcar::io {

class TirEntries {
public:
    explicit TirEntries(const PropertyFile& file) : file_(file) {}

    const std::vector<std::string>& notes() const { return notes_; }
    // `line` 0: of the file as a whole.
    void note(std::size_t line, const std::string& text);
    [[noreturn]] void fail(std::size_t line, const std::string& text) const;

    // Except where the same name means another thing: [UNITS], [MDI_HEADER].
    const PropertyEntry* find(std::string_view key);
    // 0 if it is not there: what is wrong then follows from others.
    std::size_t line_of(std::string_view key);
    // `unit`: what one of the file's is in SI. Numbers beyond any tire are mistakes.
    std::optional<double> optional(std::string_view key, double unit = 1);
    std::optional<double> either(std::string_view key, std::string_view older, double unit = 1);
    double positive(std::string_view key, double unit);
    // What it is taken as without is noted.
    double number(std::string_view key, double fallback, double unit = 1);

    // A table is used like an entry.
    void use_table(const PropertySection* section) { used_tables_.push_back(section); }

    // Notes what was not asked for.
    void list_the_rest();

protected:
    const PropertyFile& file_;

private:
    bool is_used(const PropertyEntry* entry) const;
    const PropertyEntry* find_in_file(std::string_view key) const;

    std::vector<std::string> notes_;
    std::vector<const PropertyEntry*> used_;
    std::vector<const PropertySection*> used_tables_;
};

}  // namespace hamilcar::io
