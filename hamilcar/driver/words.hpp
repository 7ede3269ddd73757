// Numbers in a driver's sentences.
#pragma once

#include <charconv>
#include <string>

namespace hamilcar {

// Four digits at most.
inline std::string spoken(double number) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 4).ptr};
}

}  // namespace hamilcar
