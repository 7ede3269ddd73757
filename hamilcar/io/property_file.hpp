// A property file (TeimOrbit, the layout of Adams and MF-Tyre files such as `.tir`): `[SECTIONS]` of `KEY = value`
// pairs and of tables, each entry with the line it was written at.
//
// A `(SUB-BLOCK)` is a section of its own, named "BLOCK/SUB-BLOCK". A section opened again goes on where it stopped. What
// such a file may not have but other programs pass over (a line that is neither, a second table) is left out with a note; of a key
// given twice all entries are kept, and the first is found.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hamilcar::io {

struct PropertyEntry {
    std::string key;               // upper case; empty for a line that is only a quoted text, as in "(COMMENTS)"
    std::string text;              // without quotes and outer blanks, in the bytes of the file; empty for "KEY ="
    std::optional<double> number;  // if the whole text is one finite number
    bool quoted = false;
    std::size_t line = 0;
};

struct PropertySection {
    std::string name;      // upper case
    std::size_t line = 0;  // of its first header
    std::vector<PropertyEntry> entries;
    std::vector<std::string> columns;  // of its table, as written; empty if the table has no `{header}`
    std::vector<std::vector<double>> rows;
    std::size_t table_line = 0;  // 0: no table
};

struct PropertyNote {
    std::size_t line;
    std::string text;
};

struct PropertyFile {
    std::string path;
    std::vector<PropertyNote> notes;        // of what was left out, or read otherwise than it is written
    std::vector<PropertySection> sections;  // in the order of the file

    // Names and keys in upper case. Null if absent.
    const PropertySection* find(std::string_view section) const;
    const PropertyEntry* find(std::string_view section, std::string_view key) const;
};

// Throws Error: input_output if the file cannot be read, else as `parse_property_file`.
PropertyFile read_property_file(const std::string& path);

// Throws Error(bad_file, "path:line: ..."). Time and memory grow no faster than the text, up to 4 MB of it.
PropertyFile parse_property_file(std::string_view text, const std::string& path);

// Throws Error(bad_file, "path:line: message").
[[noreturn]] void fail_in_property_file(const std::string& path, std::size_t line, const std::string& message);

}  // namespace hamilcar::io
