// Where a reader's way depends on the file: which word is it, which of these keys are there? A recorder goes all ways.
#include <algorithm>

#include "hamilcar/io/key_record.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

std::size_t TableReader::one_of(std::string_view key, std::span<const std::string_view> words,
                                std::optional<std::size_t> fallback) const {
    if (record_) return record_->one_of(key, words, fallback), fallback.value_or(0);
    if (fallback && !has(key)) return *fallback;
    const std::string expectation = (words.size() > 1 ? "one of " : "") + quoted_list(words);
    const Node& node = require(key, expectation);
    const auto* value = std::get_if<std::string>(&node.value);
    if (!value) reject(node, full(key), expectation);
    const auto found = std::ranges::find(words, *value);
    if (found == words.end()) {
        const std::string hint = words.size() > 1 ? did_you_mean(*value, words) : "";
        reject(node, full(key), expectation + (hint.empty() ? "" : "; " + hint));
    }
    return static_cast<std::size_t>(found - words.begin());
}

void TableReader::choose(std::string_view key, std::span<const std::string_view> words,
                         std::optional<std::size_t> fallback, const Branches& read) const {
    const std::size_t word = one_of(key, words, fallback);
    if (!record_ || words.size() < 2 || std::ranges::find(words, any_name) != words.end()) return read(word);
    Choice choice{.about = Choice::About::word, .key = std::string(key), .fallback = fallback};
    for (const std::string_view one : words) choice.options.push_back({std::string(one)});
    record_->choose(choice, words.size(), read);
}

void TableReader::choose_flag(std::string_view key, bool fallback, const TableReader& owner,
                              const FlagBranches& read) const {
    const bool flag = boolean(key, fallback);
    if (!record_) return read(flag);
    const std::string table = owner.record_ == record_ ? "" : path_.substr(path_.rfind('.') + 1);
    const std::size_t branch = fallback ? 1 : 0;
    owner.record_->choose({.about = Choice::About::flag, .key = std::string(key), .fallback = branch, .table = table},
                          2, read);
}

void TableReader::choose_list(std::string_view key, const FlagBranches& read) const {
    if (record_) return record_->choose({.about = Choice::About::list, .key = std::string(key)}, 2, read);
    const Node* node = find(key);
    read(node && std::holds_alternative<ListValue>(node->value));
}

void TableReader::choose_presence(std::string_view key, const FlagBranches& read) const {
    choose({{}, {key}}, read);
}

void TableReader::choose(Alternatives groups, const Branches& read) const {
    if (!record_) return read(chosen(groups));
    Choice choice;
    for (const auto& group : groups) choice.options.emplace_back(group.begin(), group.end());
    record_->choose(choice, groups.size(), read);
}

std::size_t TableReader::chosen(Alternatives groups) const {
    std::size_t choice = 0;
    const Node* best = nullptr;
    for (std::size_t index = 0; index < groups.size(); ++index) {
        for (const std::string_view key : groups.begin()[index]) {
            const Node* node = find(key);
            if (!node) continue;
            if (best && choice != index && best->file == node->file) {
                reject(*node, full(key), "either this or '" + best->key + "', not both");
            }
            if (!best || node->file->generation < best->file->generation) best = node, choice = index;
        }
    }
    return choice;
}

}  // namespace hamilcar::io
