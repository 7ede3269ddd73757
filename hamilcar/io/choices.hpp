// What several readers do alike: names of things that come several times, words with a meaning, things that come in kinds.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Checks the name of a table and adds it to those taken by `others`. Names become parts of channel and file names.
inline void check_name(const TableReader& table, std::vector<std::string>& taken, const std::string& others) {
    const std::string name = table.text("name");
    const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    table.expect(std::ranges::all_of(name, allowed), "name", "letters, digits and '_' only");
    table.expect(std::ranges::find(taken, name) == taken.end(), "name", "a name that no other " + others + " has");
    taken.push_back(name);
}

template <class Value>
struct Word {
    std::string_view word;
    Value meaning;
};

// What the word at a key means; the first one if the key is absent.
template <class Value>
Value word(const TableReader& table, std::string_view key, std::initializer_list<Word<Value>> all) {
    std::vector<std::string_view> words;
    for (const Word<Value>& one : all) words.push_back(one.word);
    return all.begin()[table.one_of(key, words, 0)].meaning;
}

template <class Description>
struct Kind {
    std::string_view keyword;
    Description (*read)(const TableReader&);
};

// The description read by the function whose keyword the text at `key` names.
template <class Description, std::size_t N>
Description read_kind(const std::array<Kind<Description>, N>& kinds, const TableReader& table, std::string_view key) {
    std::array<std::string_view, N> keywords;
    std::ranges::transform(kinds, keywords.begin(), &Kind<Description>::keyword);
    Description out;
    table.choose(key, keywords, {}, [&](std::size_t kind) { out = kinds[kind].read(table); });
    return out;
}

}  // namespace hamilcar::io
