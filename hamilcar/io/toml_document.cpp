// The only file that knows toml++: text to tree, and a tree merged with its base.
#include "hamilcar/io/toml_document.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <unordered_map>

#ifndef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 0
#endif
#include <toml++/toml.h>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/toml_depth.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t max_quote_length = 60;  // of a value in a message [characters]
constexpr std::size_t max_bases = 16;         // files, each the base of the one before

std::string at(const SourceFile& file, TextPosition position) {
    if (position.line == 0) return file.path + ": ";
    return file.path + ":" + std::to_string(position.line) + ":" + std::to_string(position.column) + ": ";
}

struct Reference {
    std::string path;
    std::string place;  // "file:line:column: key 'base' = ...: " of the file that asks for it; empty for the first
};

std::string read_text(const Reference& from) {
    return std::string(without_byte_order_mark(read_whole_file(from.path, FileLimit::toml, from.place)));
}

TextPosition position_of(const toml::source_position& at) {
    return {at.line, at.column};
}

Node convert(toml::node& from, const std::shared_ptr<const SourceFile>& file) {
    Node node{.value = {},
              .key = {},
              .file = file,
              .key_begin = {},
              .begin = position_of(from.source().begin),
              .end = position_of(from.source().end)};
    if (toml::table* table = from.as_table()) {
        TableValue& value = node.value.emplace<TableValue>();
        for (auto&& [key, entry] : *table) {
            value.entries.push_back(convert(entry, file));
            value.entries.back().key = key.str();
            value.entries.back().key_begin = position_of(key.source().begin);
        }
        const auto order = [](const Node& n) { return std::pair(n.key_begin.line, n.key_begin.column); };
        std::ranges::sort(value.entries, {}, order);
    } else if (toml::array* array = from.as_array()) {
        ListValue& value = node.value.emplace<ListValue>();
        for (toml::node& item : *array) value.items.push_back(convert(item, file));
    } else if (const auto number = from.value<double>(); number && from.is_number()) {
        node.value = *number;
    } else if (const auto* boolean = from.as_boolean()) {
        node.value = boolean->get();
    } else if (auto* text = from.as_string()) {
        node.value = std::move(text->get());
    }
    return node;
}

Node parse(const std::shared_ptr<const SourceFile>& file) {
    if (const auto place = too_deep(file->text)) {
        fail_at(*file, *place,
                "nested too deep: expected keys of at most " + std::to_string(max_key_parts) + " parts and at most " +
                    std::to_string(max_brackets) + " brackets inside each other");
    }
    try {
        toml::table root = toml::parse(std::string_view(file->text));
        return convert(root, file);
    } catch (const toml::parse_error& error) {
        fail_at(*file, position_of(error.source().begin), "not valid TOML: " + std::string(error.description()));
    }
}

Node parse(const Reference& from, int generation) {
    return parse(std::make_shared<const SourceFile>(SourceFile{from.path, read_text(from), generation}));
}

// With all that is below it.
void place_outside_files(Node& node) {
    node.key_begin.line = node.begin.line = node.end.line = 0;
    if (auto* table = std::get_if<TableValue>(&node.value)) std::ranges::for_each(table->entries, place_outside_files);
    if (auto* list = std::get_if<ListValue>(&node.value)) std::ranges::for_each(list->items, place_outside_files);
}

// The `name` of an entry in a list of tables; null if it has none.
const std::string* name_of(const Node& item) {
    const Node* name = item.find("name");
    return name ? std::get_if<std::string>(&name->value) : nullptr;
}

bool is_list_of_named_tables(ListValue& list) {
    return std::ranges::all_of(list.items, name_of);
}

void merge(Node& base, Node top);

// Entries of one name are merged, others are added. A map, since a file may have thousands.
template <class Name>
void merge(std::vector<Node>& base, std::vector<Node>& top, const Name& name) {
    std::unordered_map<std::string, std::size_t> places;
    for (std::size_t i = 0; i < base.size(); ++i) places.try_emplace(name(base[i]), i);
    for (Node& one : top) {
        const auto [same, is_new] = places.try_emplace(name(one), base.size());
        if (is_new) {
            base.push_back(std::move(one));
        } else {
            merge(base[same->second], std::move(one));
        }
    }
}

// `top` overrides.
void merge(Node& base, Node top) {
    if (std::holds_alternative<TableValue>(base.value) && std::holds_alternative<TableValue>(top.value)) {
        merge(std::get<TableValue>(base.value).entries, std::get<TableValue>(top.value).entries,
              [](const Node& entry) { return entry.key; });
        std::swap(base.value, top.value);
    } else if (auto* old_list = std::get_if<ListValue>(&base.value), *new_list = std::get_if<ListValue>(&top.value);
               old_list && new_list && is_list_of_named_tables(*old_list) && is_list_of_named_tables(*new_list)) {
        merge(old_list->items, new_list->items, [](Node& item) { return *name_of(item); });
        std::swap(base.value, top.value);
    }
    base = std::move(top);  // with the place of the file on top: there a missing key has to be added
}

// Its own way to say something counts, against one in whatever file.
constexpr int nearest = 2 * static_cast<int>(max_bases);  // generations
void bring_nearer(Node& node, std::unordered_map<const SourceFile*, std::shared_ptr<const SourceFile>>& files) {
    std::shared_ptr<const SourceFile>& nearer = files[node.file.get()];
    if (!nearer)
        nearer =
            std::make_shared<SourceFile>(SourceFile{node.file->path, node.file->text, node.file->generation - nearest});
    node.file = nearer;
    const auto below = [&](std::vector<Node>& nodes) {
        for (Node& one : nodes) bring_nearer(one, files);
    };
    if (auto* table = std::get_if<TableValue>(&node.value)) below(table->entries);
    if (auto* list = std::get_if<ListValue>(&node.value)) below(list->items);
}

// Takes the key `base` out of a file's table; an empty path if there is none.
Reference take_base(Node& top) {
    TableValue& table = std::get<TableValue>(top.value);
    const auto base = std::ranges::find(table.entries, "base", &Node::key);
    if (base == table.entries.end()) return {};
    const std::string quoted = "key 'base' = " + base->written() + ": ";
    const auto* name = std::get_if<std::string>(&base->value);
    if (!name || name->empty()) fail_at(*base->file, base->begin, quoted + "expected the path of a file to start from");
    const auto folder = std::filesystem::path(top.file->path).parent_path();
    Reference reference{(folder / *name).lexically_normal().string(), at(*base->file, base->begin) + quoted};
    table.entries.erase(base);
    return reference;
}

void add_places(const Node& node, const std::string& path, Places& to) {
    if (!path.empty()) {
        to.keys.try_emplace(path, Place{{node.file, &node.file->path}, node.begin.line, node.begin.column});
    }
    if (const auto* table = std::get_if<TableValue>(&node.value)) {
        for (const Node& entry : table->entries)
            add_places(entry, path.empty() ? entry.key : path + "." + entry.key, to);
    } else if (const auto* list = std::get_if<ListValue>(&node.value)) {
        for (std::size_t i = 0; i < list->items.size(); ++i) {
            if (!std::holds_alternative<TableValue>(list->items[i].value)) return;  // the list's own place will do
            add_places(list->items[i], item_path(path, list->items[i], i), to);
        }
    }
}

// In UTF-8.
bool begins_character(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}
std::size_t character_count(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
}

// Where a position is in the text [byte].
std::size_t offset_of(std::string_view text, TextPosition position) {
    std::size_t at = 0;
    for (std::size_t line = 1; line < position.line; ++line) at = text.find('\n', at) + 1;
    for (std::size_t column = 1; column < position.column && at < text.size(); ++column) {
        do ++at;
        while (at < text.size() && !begins_character(text[at]));
    }
    return at;
}

}  // namespace

const Node* Node::find(std::string_view entry) const {
    const auto* table = std::get_if<TableValue>(&value);
    if (!table) return nullptr;
    const auto found = std::ranges::find(table->entries, entry, &Node::key);
    return found == table->entries.end() ? nullptr : &*found;
}

Node* Node::find(std::string_view entry) {
    return const_cast<Node*>(std::as_const(*this).find(entry));
}

std::string Node::written() const {
    if (std::holds_alternative<TableValue>(value)) return "a table";
    const std::size_t from = offset_of(file->text, begin), to = offset_of(file->text, end);
    std::string quote;
    for (const char c : std::string_view(file->text).substr(from, to - from)) {
        const bool blank = std::isspace(static_cast<unsigned char>(c));
        if (!blank) {
            quote += c;
        } else if (!quote.ends_with(' ')) {
            quote += ' ';
        }
        if (quote.size() > max_quote_length && begins_character(c)) return quote.substr(0, quote.size() - 1) + "...";
    }
    return quote;
}

Node parse_toml(const std::string& name, const std::string& text) {
    return parse(std::make_shared<const SourceFile>(SourceFile{name, text}));
}

Node read_toml(const std::string& path) {
    std::vector<Node> chain;  // the file, its base, the base's base
    chain.push_back(parse({path, ""}, 0));
    for (Reference base = take_base(chain[0]); !base.path.empty(); base = take_base(chain.back())) {
        const auto same_file = [&](const Node& n) {
            return std::filesystem::path(n.file->path).lexically_normal() == base.path;
        };
        if (std::ranges::any_of(chain, same_file)) {
            throw Error(ExitCode::bad_file, base.place + "expected a file that does not lead back to this one");
        }
        if (chain.size() == max_bases) {
            throw Error(ExitCode::bad_file, base.place + "expected at most " + std::to_string(max_bases) +
                                                " files that stand on each other");
        }
        chain.push_back(parse(base, static_cast<int>(chain.size())));
    }
    Node merged = std::move(chain.back());
    for (chain.pop_back(); !chain.empty(); chain.pop_back()) merge(merged, std::move(chain.back()));
    return merged;
}

Node typed_value(const std::string& where, const std::string& text) {
    // On one line, so that what is quoted in messages is found by its column alone.
    const bool is_line = text.find_first_of("\r\n") == std::string::npos && !too_deep("value = " + text);
    const auto file = std::make_shared<SourceFile>(SourceFile{where, "value = " + text, -1});
    toml::table root;
    try {
        if (is_line) root = toml::parse(std::string_view(file->text));
    } catch (const toml::parse_error&) {
        root.clear();
    }
    if (!root.contains("value") || root.size() != 1) {
        file->text = text;
        const std::size_t end = 1 + character_count(text);
        return {.value = text, .key = {}, .file = file, .key_begin = {0, 1}, .begin = {0, 1}, .end = {0, end}};
    }
    Node node = convert(*root.get("value"), file);
    place_outside_files(node);
    return node;
}

Node laid_over(const Node& table, std::string_view key) {
    Node below = table, above = *table.find(key);
    std::erase_if(std::get<TableValue>(below.value).entries, [&](const Node& entry) { return entry.key == key; });
    std::unordered_map<const SourceFile*, std::shared_ptr<const SourceFile>> nearer;
    bring_nearer(above, nearer);
    merge(below, std::move(above));
    return below;
}

std::string item_path(const std::string& list, const Node& item, std::size_t number) {
    const std::string* name = name_of(item);
    return list + "[" + (name ? *name : std::to_string(number)) + "]";
}

std::shared_ptr<const Places> places_of(const Node& document) {
    const auto places = std::make_shared<Places>();
    places->file = document.file->path;
    add_places(document, "", *places);
    return places;
}

void fail_at(const SourceFile& file, TextPosition position, const std::string& message) {
    throw Error(ExitCode::bad_file, at(file, position) + message);
}

}  // namespace hamilcar::io
