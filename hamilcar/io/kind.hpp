// Things that come in kinds, each with a keyword and a function that reads it.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

template <class Description>
struct Kind {
    std::string_view keyword;
    Description (*read)(const TableReader&);
};

// The description read by the function whose keyword the text at `key` names; its keys are those of `table`.
template <class Description, std::size_t N>
Description read_kind(const std::array<Kind<Description>, N>& kinds, const TableReader& owner, std::string_view key,
                      const TableReader& table) {
    std::array<std::string_view, N> keywords;
    std::ranges::transform(kinds, keywords.begin(), &Kind<Description>::keyword);
    return kinds[owner.one_of(key, keywords)].read(table);
}

}  // namespace hamilcar::io
