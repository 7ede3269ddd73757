// Help with a misspelled word: the nearest known one, and the list of all of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hamilcar::io {

// The candidate within two edits (one for words of up to four letters), or none. Case does not count, and a key with a
// forgotten or different unit is near: "mass" finds "mass_kg".
std::optional<std::string_view> nearest_word(std::string_view word, std::span<const std::string_view> candidates);

// "did you mean 'b'?"; empty if none is near.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

// 'a', 'b' or 'c'
std::string quoted_list(std::span<const std::string_view> words);

}  // namespace hamilcar::io
