#include "hamilcar/io/chosen_keys.hpp"

#include <map>
#include <mutex>

namespace hamilcar::io {

namespace {

// As TableReader::chosen: a file's own choice overrides the one that it inherits, whose keys are not read.
std::optional<std::size_t> group_of(const Node& node, const Choice& choice, ChosenKeys& to) {
    std::size_t group = 0;
    const Node* best = nullptr;
    for (std::size_t i = 0; i < choice.options.size(); ++i) {
        for (const std::string& key : choice.options[i]) {
            const Node* entry = node.find(key);
            if (!entry) continue;
            to.unread.push_back(entry);
            if (best && group != i && best->file == entry->file) {
                to.contradictions.emplace_back(entry, best);
                return std::nullopt;
            }
            if (!best || entry->file->generation < best->file->generation) best = entry, group = i;
        }
    }
    return group;
}

// Nothing where the file has neither.
std::optional<std::size_t> branch_of(const Node& node, const Choice& choice, ChosenKeys& to) {
    if (choice.about == Choice::About::group) return group_of(node, choice, to);
    const Node* owner = choice.table.empty() ? &node : node.find(choice.table);
    const Node* value = owner ? owner->find(choice.key) : nullptr;
    if (choice.about == Choice::About::list) return value && std::holds_alternative<ListValue>(value->value) ? 1 : 0;
    if (!value) return choice.fallback;
    if (choice.about == Choice::About::flag) {
        const bool* flag = std::get_if<bool>(&value->value);
        return flag ? std::optional<std::size_t>(*flag ? 1 : 0) : std::nullopt;
    }
    const auto* word = std::get_if<std::string>(&value->value);
    for (std::size_t i = 0; word && i < choice.options.size(); ++i) {
        if (choice.options[i][0] == *word) return i;
    }
    return std::nullopt;
}

void take(const Node& node, const TableRecord& format, ChosenKeys& to) {
    merge(to.table, TableRecord{.keys = format.keys, .choices = {}});
    for (const Choice& choice : format.choices) {
        if (const auto branch = branch_of(node, choice, to)) {
            take(node, choice.branches[*branch], to);
            continue;
        }
        for (TableRecord branch : choice.branches) loosen(branch), merge(to.table, branch);
    }
}

}  // namespace

ChosenKeys chosen_keys(const Node& table, const TableRecord& format) {
    ChosenKeys out;
    take(table, format, out);
    return out;
}

const TableRecord& format_of(DescribeFormat describe) {
    static std::mutex mutex;
    static std::map<DescribeFormat, TableRecord> formats;
    const std::scoped_lock lock(mutex);
    const auto known = formats.find(describe);
    return known != formats.end() ? known->second : formats.emplace(describe, record_keys(describe)).first->second;
}

}  // namespace hamilcar::io
