#include "hamilcar/io/crg_text.hpp"

#include <charconv>

namespace hamilcar::io::crg {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const auto first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string plain(std::string_view text) {
    std::string out;
    for (const char c : trimmed(text)) {
        const bool blank = c == ' ' || c == '\t';
        if (blank && !out.empty() && out.back() == ' ') continue;
        const bool upper = c >= 'A' && c <= 'Z', shown = c >= ' ' && c <= '~';
        out += blank ? ' ' : upper ? static_cast<char>(c - 'A' + 'a') : shown ? c : '?';
    }
    return out;
}

std::optional<double> number_in(std::string_view text) {
    std::string digits(trimmed(text));
    for (char& c : digits)
        if (c == 'd' || c == 'D' || c == 'E') c = 'e';  // Fortran's exponent
    const char* begin = digits.data() + (digits.size() > 1 && digits[0] == '+' && digits[1] != '-' ? 1 : 0);
    const char* end = digits.data() + digits.size();
    double number = 0;
    const auto [stop, error] = std::from_chars(begin, end, number);
    const bool small = error == std::errc::result_out_of_range && digits.find("e-") != std::string::npos;
    if (small && stop == end) return 0.0;
    if (error != std::errc() || stop != end || begin == end) return std::nullopt;
    return number;
}

std::string_view Text::next_line() {
    const auto end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

}  // namespace hamilcar::io::crg
