#include "hamilcar/io/key_list.hpp"

#include <algorithm>

#include "hamilcar/base/key_unit.hpp"

namespace hamilcar::io {

namespace {

// Dots alone; a name with a dot in it needs brackets.
std::string joined(const std::string& path, const std::string& part) {
    if (part.find_first_of(".[]") != std::string::npos) return path + "[" + part + "]";
    return path.empty() ? part : path + "." + part;
}

class NumberList {
public:
    void add_table(const Node& node, const std::string& path, const TableRecord& format) {
        const TableRecord table = chosen_keys(node, format).table;
        const KeyRecord* any = table.find(any_name);
        for (const Node& entry : std::get<TableValue>(node.value).entries) {
            const KeyRecord* key = table.find(entry.key);
            if (!key) key = any;
            if (key) add(entry, joined(path, entry.key), entry.key, *key);
        }
        for (const KeyRecord& key : table.keys) {
            const double* fallback = std::get_if<double>(&key.value.fallback);
            if (fallback && !node.find(key.key)) add_number(*fallback, joined(path, key.key), key.key, key, true);
        }
    }

    std::vector<NamedNumber> out;

private:
    void add(const Node& value, const std::string& path, const std::string& name, const KeyRecord& key) {
        if (const auto* number = std::get_if<double>(&value.value)) {
            add_number(*number, path, name, key, false);
        } else if (std::holds_alternative<TableValue>(value.value)) {
            if (!key.below.empty()) add_table(value, path, key.below[0]);
        } else if (const auto* list = std::get_if<ListValue>(&value.value)) {
            for (std::size_t i = 0; i < list->items.size(); ++i) {
                const Node& item = list->items[i];
                const Node* label = item.find("name");
                const auto* text = label ? std::get_if<std::string>(&label->value) : nullptr;
                add(item, joined(path, text ? *text : std::to_string(i)), name, key);
            }
        }
    }
    void add_number(double value, const std::string& path, const std::string& name, const KeyRecord& key,
                    bool is_default) {
        const ValueRule& rule = key.value;
        out.push_back({path, value, unit_of_key(name).symbol, rule.min, rule.max, rule.min_included, rule.is_whole,
                       key.meanings.empty() ? "" : key.meanings.front().text, is_default});
    }
};

}  // namespace

std::vector<NamedNumber> numbers_in(const Node& document, const TableRecord& format) {
    NumberList list;
    list.add_table(document, "", format);
    return std::move(list.out);
}

namespace {

void drop_overridden(Node& node, const TableRecord& format) {
    const ChosenKeys chosen = chosen_keys(node, format);
    std::vector<std::string> overridden;
    for (const Node* entry : chosen.unread) {
        if (!chosen.table.find(entry->key)) overridden.push_back(entry->key);
    }
    auto& entries = std::get<TableValue>(node.value).entries;
    std::erase_if(entries, [&](const Node& entry) { return std::ranges::count(overridden, entry.key) > 0; });
    const KeyRecord* any = chosen.table.find(any_name);
    for (Node& entry : entries) {
        const KeyRecord* key = chosen.table.find(entry.key);
        if (!key) key = any;
        if (!key || key->below.empty()) continue;
        if (std::holds_alternative<TableValue>(entry.value)) drop_overridden(entry, key->below[0]);
        if (auto* list = std::get_if<ListValue>(&entry.value)) {
            for (Node& item : list->items) {
                if (std::holds_alternative<TableValue>(item.value)) drop_overridden(item, key->below[0]);
            }
        }
    }
}

}  // namespace

Node without_overridden(const Node& document, const TableRecord& format) {
    Node out = document;
    drop_overridden(out, format);
    return out;
}

}  // namespace hamilcar::io
