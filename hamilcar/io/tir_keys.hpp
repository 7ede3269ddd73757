// The keys of `.tir` files: which a file of some age should have, and which are known but not used here.
#pragma once

#include <optional>
#include <string_view>

namespace hamilcar::io {

// Whether a complete file has this coefficient: one of MF 5.2 (`old`), or of MF 6.
bool expected(std::string_view coefficient, bool old);

// Keys of the standard that say nothing about the forces modeled here: masses, belts, turn slip, bottoming.
bool is_known_but_unused(std::string_view key);

// The known key that a misspelled one is near to.
std::optional<std::string_view> nearest_key(std::string_view key);

}  // namespace hamilcar::io
