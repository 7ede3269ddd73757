// Text as files and people write it. No locale has a say: letters are those of ASCII, numbers have a decimal point.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hamilcar {

std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r");
std::string lower_case(std::string_view text);
std::string upper_case(std::string_view text);
// Upper or lower case alike.
bool same_word(std::string_view a, std::string_view b);

// If the text is, but for blanks around it, one decimal number: a sign, digits, an exponent by e or Fortran's d. What is too small to be told from
// zero is zero; "inf", "nan" and what is too large are no numbers.
std::optional<double> number_in(std::string_view text);

// No digit more than it takes to read back the same number.
void append_number(std::string& text, double number);
// Six digits at most.
std::string number_text(double number);
// So many digits behind the point, and "0.0" for what rounds to zero from below.
std::string fixed_text(double number, int digits);

// What is this much less than its like, or than one of its unit, is nothing but the round-off of a calculation: people are shown 0.
inline constexpr double round_off = 1e-12;
double without_round_off(double number, double size = 1);

// 'text' for a message: short, and with nothing in it that a terminal could trip over.
std::string quoted_text(std::string_view text);

// The text behind the mark that some programs put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace hamilcar
