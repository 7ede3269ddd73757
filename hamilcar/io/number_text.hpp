// Numbers as text, always with a decimal point: for files that read back to the same bits, and for people.
#pragma once

#include <charconv>
#include <string>

namespace hamilcar::io {

// No digit more than it takes to read back the same number.
inline void append_number(std::string& text, double number) {
    char digits[32];  // the longest double takes 24
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

// Six digits at most.
inline std::string number_text(double number) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6).ptr};
}

}  // namespace hamilcar::io
