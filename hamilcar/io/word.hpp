// Keys with two words to choose from.
#pragma once

#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

template <class Value>
struct Word {
    std::string_view word;
    Value meaning;
};

// What the word at a key means; the first one if the key is absent.
template <class Value>
Value word(const TableReader& table, std::string_view key, const Word<Value>& usual, const Word<Value>& other) {
    return table.one_of(key, std::array{usual.word, other.word}, 0) == 0 ? usual.meaning : other.meaning;
}

}  // namespace hamilcar::io
