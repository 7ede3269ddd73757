// The text of an OpenCRG file: its lines one after the other, and what stands in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hamilcar::io::crg {

constexpr std::size_t record = 80;  // bytes or characters

std::string_view trimmed(std::string_view text);

// In lower case, with single blanks, without what a message could not show.
std::string plain(std::string_view text);

// If the whole text is one, Fortran's exponent allowed. What is too small to be told from zero is zero; it may be NaN or
// infinite if the text says so.
std::optional<double> number_in(std::string_view text);

// What is left to be read.
class Text {
public:
    explicit Text(std::string_view bytes) : rest_(bytes) {}
    std::string_view rest() const { return rest_; }
    int line() const { return line_; }  // of the line last read
    std::string_view next_line();
    void skip(std::size_t bytes) { rest_.remove_prefix(bytes); }

private:
    std::string_view rest_;
    int line_ = 0;
};

}  // namespace hamilcar::io::crg
