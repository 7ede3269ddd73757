// How deep a TOML text nests, before a parser looks at it: parser and tree recurse, and the deepest stack ends somewhere.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "hamilcar/io/toml_document.hpp"

namespace hamilcar::io {

inline constexpr std::size_t max_key_parts = 16;  // a.b.c has three; a vehicle file needs four
inline constexpr std::size_t max_brackets = 32;   // lists and tables inside each other

// Where the text first goes deeper than that.
std::optional<TextPosition> too_deep(std::string_view text);

}  // namespace hamilcar::io
