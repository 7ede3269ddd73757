// Numbers in the driver's messages.
#pragma once

#include <charconv>
#include <string>

namespace hamilcar {

// At most four significant digits.
inline std::string short_number(double number) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 4).ptr};
}

}  // namespace hamilcar
