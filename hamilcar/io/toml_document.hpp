// A TOML file as a plain tree in which every node knows the file, line and column it was written at.
//
// A file may start from another one: `base = "other.toml"`. Then this file's keys override the base's, table by table;
// entries of a list of tables that carry a `name` are matched by it, every other list is replaced as a whole. Because a
// node keeps its own place, a mistake is reported in the file that holds it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hamilcar/description/places.hpp"

namespace hamilcar::io {

struct SourceFile {
    std::string path;
    std::string text;
    int generation = 0;  // -1: typed over the file, 0: the file asked for, 1: its base, 2: the base's base
};

struct TextPosition {
    std::size_t line = 1, column = 1;  // columns count characters, not bytes; line 0: typed, in no file
};

struct Node;

struct TableValue {
    std::vector<Node> entries;       // in the order of the file
    std::vector<std::string> known;  // keys a reader asked for: whatever else is there is a mistake
};
struct ListValue {
    std::vector<Node> items;
};
struct UnsupportedValue {};  // dates and times

struct Node {
    std::variant<UnsupportedValue, double, bool, std::string, ListValue, TableValue> value;
    std::string key;  // in its table; empty in a list
    std::shared_ptr<const SourceFile> file;
    TextPosition key_begin, begin, end;

    Node* find(std::string_view entry);  // of a table; null if absent
    const Node* find(std::string_view entry) const;
    // The value as the person wrote it, on one line and shortened.
    std::string written() const;
};

// Throws Error: input_output if a file cannot be read, bad_file if it is no valid TOML or its bases form a circle.
Node read_toml(const std::string& path);
// Of a text that is in no file yet and has no base; `name` stands in messages.
Node parse_toml(const std::string& name, const std::string& text);

// What a person typed in a value's place, as TOML has it; what is no TOML is a text. `where` names the place in messages.
Node typed_value(const std::string& where, const std::string& text);

// A table without the table at `key`, whose keys are laid over it as a file's over those of its base.
Node laid_over(const Node& table, std::string_view key);

// Of all keys of a file and of what it starts from.
std::shared_ptr<const Places> places_of(const Node& document);

// "list[name]" of an entry that has a name, else "list[number]".
std::string item_path(const std::string& list, const Node& item, std::size_t number);

// Throws Error(bad_file, "file:line:column: message").
[[noreturn]] void fail_at(const SourceFile& file, TextPosition position, const std::string& message);

}  // namespace hamilcar::io
