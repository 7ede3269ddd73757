#include "hamilcar/io/set_key.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/io/toml_depth.hpp"

namespace hamilcar::io {

namespace {

// "axle[front].spring" -> axle, front, spring; a name in brackets may contain dots. Nothing for what is no key.
std::vector<std::string> parts_of(const std::string& key) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < key.size();) {
        const bool bracket = key[at] == '[';
        const std::size_t from = bracket || (key[at] == '.' && at > 0) ? at + 1 : at;
        const std::size_t end = std::min(key.find_first_of(bracket ? "]" : ".[", from), key.size());
        if (end == from || (bracket && end == key.size())) return {};
        parts.push_back(key.substr(from, end - from));
        at = end + (bracket ? 1 : 0);
    }
    return key.ends_with('.') ? std::vector<std::string>{} : parts;
}

std::vector<std::string> labels_of(const ListValue& list) {
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
        const Node* name = list.items[i].find("name");
        const auto* text = name ? std::get_if<std::string>(&name->value) : nullptr;
        labels.push_back(text ? *text : std::to_string(i));
    }
    return labels;
}

bool whole_number(const std::string& text, std::size_t& number) {
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
    return wrong == std::errc() && end == text.data() + text.size();
}

Node& item_of(ListValue& list, const std::string& label, const std::string& path, const std::string& before) {
    const std::vector<std::string> labels = labels_of(list);
    if (const auto found = std::ranges::find(labels, label); found != labels.end()) {
        return list.items[static_cast<std::size_t>(found - labels.begin())];
    }
    std::size_t number = 0;
    if (whole_number(label, number) && number < list.items.size()) return list.items[number];
    const std::vector<std::string_view> words(labels.begin(), labels.end());
    throw Error(ExitCode::usage, before + "'" + path + "' has no '" + label + "': expected one of " +
                                     quoted_list(std::span(words).first(std::min<std::size_t>(words.size(), 12))));
}

// The entry of a table, added where it is not there; `place` has file and positions for a new one.
Node& entry_of(Node& node, const std::string& name, const Node& place) {
    if (!std::holds_alternative<TableValue>(node.value)) {
        node.value = TableValue{};  // a number, say, in a table's place
        node.file = place.file, node.begin = place.begin, node.end = place.end;
    }
    if (Node* there = node.find(name)) return *there;
    auto& entries = std::get<TableValue>(node.value).entries;
    entries.push_back({.value = TableValue{},
                       .key = name,
                       .file = place.file,
                       .key_begin = place.key_begin,
                       .begin = place.begin,
                       .end = place.end});
    return entries.back();
}

}  // namespace

void set_key(Node& document, const std::string& key, Node value, const std::string& before) {
    const std::vector<std::string> parts = parts_of(key);
    if (parts.empty()) {
        throw Error(ExitCode::usage,
                    before + "expected a key such as 'chassis.mass_kg' or 'axle[front].spring.rate_N_per_m'");
    }
    if (parts.size() > max_key_parts) {
        throw Error(ExitCode::usage, before + "expected at most " + std::to_string(max_key_parts) + " parts of a key");
    }
    Node* node = &document;
    std::string path;
    for (const std::string& part : parts) {
        auto* list = std::get_if<ListValue>(&node->value);
        node = list ? &item_of(*list, part, path, before) : &entry_of(*node, part, value);
        path += list ? "[" + part + "]" : (path.empty() ? "" : ".") + part;
    }
    node->value = std::move(value.value);
    node->file = value.file, node->key_begin = value.key_begin, node->begin = value.begin, node->end = value.end;
}

void set_key(Node& document, const std::string& assignment, const std::string& option) {
    const std::string before = option + " '" + assignment + "': ";
    const std::size_t equals = assignment.find('=');
    const bool is_assignment = equals != std::string::npos && equals + 1 < assignment.size();
    if (!is_assignment || parts_of(assignment.substr(0, equals)).empty()) {
        throw Error(
            ExitCode::usage,
            before + "expected KEY=VALUE with a key such as 'chassis.mass_kg' or 'axle[front].spring.rate_N_per_m'");
    }
    set_key(document, assignment.substr(0, equals), typed_value(option, assignment.substr(equals + 1)), before);
}

const Node* value_at(const Node& document, const std::string& key) {
    const std::vector<std::string> parts = parts_of(key);
    if (parts.empty()) return nullptr;
    const Node* node = &document;
    for (const std::string& part : parts) {
        if (const auto* list = std::get_if<ListValue>(&node->value)) {
            const std::vector<std::string> labels = labels_of(*list);
            std::size_t at = static_cast<std::size_t>(std::ranges::find(labels, part) - labels.begin());
            if (at == labels.size() && !whole_number(part, at)) return nullptr;
            node = at < list->items.size() ? &list->items[at] : nullptr;
        } else {
            node = node->find(part);
        }
        if (!node) return nullptr;
    }
    return node;
}

}  // namespace hamilcar::io
