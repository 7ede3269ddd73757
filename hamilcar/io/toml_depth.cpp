// Knows of TOML only what separates structure from text: comments and the four kinds of strings. A dotted key is a
// sequence of names and strings with dots between them; anything else ends it.
#include "hamilcar/io/toml_depth.hpp"

#include <string>

namespace hamilcar::io {

namespace {

class DepthScanner {
public:
    explicit DepthScanner(std::string_view text) : text_(text) {}

    std::optional<TextPosition> run() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                skip_string(c);
                continue;
            }
            if (c == '#') {
                while (at_ < text_.size() && text_[at_] != '\n') step();
                continue;
            }
            if (c == '.') {
                ++dots_;
            } else if (!belongs_to_key(c)) {
                dots_ = 0;
            }
            if (c == '[' || c == '{') ++brackets_;
            if ((c == ']' || c == '}') && brackets_ > 0) --brackets_;
            if (dots_ >= max_key_parts || brackets_ > max_brackets) return position_;
            step();
        }
        return {};
    }

private:
    static bool belongs_to_key(char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
               c == ' ' || c == '\t';
    }

    void step() {
        if ((static_cast<unsigned char>(text_[at_]) & 0xC0) != 0x80) ++position_.column;  // not within a character
        if (text_[at_] == '\n') ++position_.line, position_.column = 1;
        ++at_;
    }

    // In `"` strings a backslash escapes; three quotation marks begin a string of several lines, one ends with its line.
    void skip_string(char quote) {
        const std::size_t marks = text_.substr(at_).starts_with(std::string(3, quote)) ? 3 : 1;
        const std::string closing(marks, quote);
        for (std::size_t i = 0; i < marks; ++i) step();
        while (at_ < text_.size()) {
            if (text_.substr(at_).starts_with(closing)) {
                for (std::size_t i = 0; i < marks; ++i) step();
                // Of several lines a text may end with one or two quotation marks of its own.
                for (int own = 0; marks == 3 && own < 2 && at_ < text_.size() && text_[at_] == quote; ++own) step();
                return;
            }
            if (marks == 1 && text_[at_] == '\n') return;
            if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size()) step();
            step();
        }
    }

    std::string_view text_;
    std::size_t at_ = 0, dots_ = 0, brackets_ = 0;
    TextPosition position_{1, 1};
};

}  // namespace

std::optional<TextPosition> too_deep(std::string_view text) {
    return DepthScanner(text).run();
}

}  // namespace hamilcar::io
