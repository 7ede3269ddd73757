#include "hamilcar/base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hamilcar {

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace

std::string_view trimmed(std::string_view text, std::string_view blanks) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), lower);
    return out;
}

std::string upper_case(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), upper);
    return out;
}

bool same_word(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, lower, lower);
}

std::optional<double> number_in(std::string_view text) {
    text = trimmed(text);
    std::string plain(text.starts_with('+') ? text.substr(1) : text);
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    if (plain.find_first_of(".0123456789", sign) != sign) return std::nullopt;  // as "inf" and "+-1"
    std::ranges::replace_if(
        plain, [](char c) { return c == 'd' || c == 'D' || c == 'E'; }, 'e');
    double number = 0;
    const auto [end, problem] = std::from_chars(plain.data(), plain.data() + plain.size(), number);
    if (end != plain.data() + plain.size()) return std::nullopt;
    if (problem == std::errc()) return number;
    const bool small = problem == std::errc::result_out_of_range && plain.find("e-") != std::string::npos;
    return small ? std::optional(0.0) : std::nullopt;
}

void append_number(std::string& text, double number) {
    char digits[32];  // the longest double takes 24
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

std::string number_text(double number) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6).ptr};
}

std::string fixed_text(double number, int digits) {
    const bool is_zero = std::abs(number) < 0.5 * std::pow(10, -digits);
    return fmt::format("{:.{}f}", is_zero ? 0 : number, digits);
}

double without_round_off(double number, double size) {
    return std::abs(number) < round_off * std::max(size, 1.0) ? 0 : number;
}

std::string quoted_text(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string out(text.substr(0, longest));
    std::ranges::replace_if(
        out, [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + out + (text.size() > longest ? "...'" : "'");
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return text.substr(text.starts_with(mark) ? mark.size() : 0);
}

}  // namespace hamilcar
