// Every line says by its first character what it is: '[' a section, '(' a sub-block, '{' a table's header, a quotation
// mark a text, a number without '=' behind it a row, anything else a pair. Only a value that begins with a quotation
// mark can hold '$' or '!': elsewhere these begin a comment, whatever quotation marks come before them.
#include "hamilcar/io/property_file.hpp"

#include <algorithm>
#include <charconv>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::string_view blanks = " \t\v\f\x1a";  // also the end-of-file mark of old DOS editors
constexpr std::string_view quotes = "'\"";
constexpr std::string_view separators = " \t\v\f\x1a,";

std::string_view trimmed(std::string_view text, std::string_view unwanted = blanks) {
    const auto first = text.find_first_not_of(unwanted);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(unwanted) - first + 1);
}

std::string upper(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');  // no locale may have a say
    }
    return result;
}

std::optional<double> number_in(std::string_view text) {
    const auto digits = text.substr(text.starts_with('-') || text.starts_with('+') ? 1 : 0);
    if (digits.find_first_of(".0123456789") != 0) return {};  // "inf", "nan" and "+-1" are no numbers of a file
    std::string plain(text.starts_with('+') ? digits : text);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');  // Fortran's 1.5D-3
    double number = 0;
    const auto [end, problem] = std::from_chars(plain.data(), plain.data() + plain.size(), number);
    const bool whole = problem == std::errc() && end == plain.data() + plain.size();
    return whole ? std::optional(number) : std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (!(text = trimmed(text, separators)).empty()) {
        const std::string_view word = text.substr(0, text.find_first_of(separators));
        words.push_back(word);
        text.remove_prefix(word.size());
    }
    return words;
}

class Parser {
public:
    explicit Parser(const std::string& path) { file_.path = path; }

    PropertyFile parse(std::string_view text) {
        if (text.size() > LargestFile::tire) fail("more than 4 MB: expected a property file of up to 4 MB");
        if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
        if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) fail("UTF-16: expected UTF-8 or Latin-1");
        while (!text.empty()) {
            const auto end = std::min(text.find_first_of("\r\n"), text.size());
            read_line(trimmed(text.substr(0, end)));
            text.remove_prefix(std::min(end + (text.substr(end).starts_with("\r\n") ? 2 : 1), text.size()));
            ++line_;
        }
        for (const PropertySection& section : file_.sections) refuse_repeated_keys(section);
        return std::move(file_);
    }

private:
    [[noreturn]] void fail(const std::string& message) const { fail_in_property_file(file_.path, line_, message); }

    void read_line(std::string_view line) {
        if (line.empty() || line.front() == '$' || line.front() == '!') return;
        if (line.front() == '[') {
            return open_section(block_ = upper(between(line, ']', "a section")));
        }
        if (line.front() == '(') {
            if (block_.empty()) fail(fmt::format("sub-block {}: expected a [section] first", shown_in_message(line)));
            return open_section(block_ + "/" + upper(between(line, ')', "a sub-block")));
        }
        if (block_.empty()) fail(fmt::format("{}: expected a [section] first", shown_in_message(line)));
        if (line.front() == '{') return read_columns(between(line, '}', "a table's header"));
        if (line.find_first_of(quotes) == 0) return add_entry({}, line);
        const std::string_view uncommented = line.substr(0, line.find_first_of("$!"));
        if (const auto equals = uncommented.find('='); equals != std::string_view::npos) {
            return read_pair(trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
        }
        read_row(trimmed(uncommented));
    }

    // What stands between the line's first character and the closing one; behind it only a comment may follow.
    std::string_view between(std::string_view line, char closing, const char* what) const {
        const auto end = line.find(closing);
        if (end == line.npos)
            fail(fmt::format("{}: expected {} to end with '{}'", shown_in_message(line), what, closing));
        expect_nothing(line.substr(end + 1), what);
        const std::string_view name = trimmed(line.substr(1, end - 1));
        if (name.empty() && closing != '}')
            fail(fmt::format("{}: expected {} with a name", shown_in_message(line), what));
        return name;
    }

    void expect_nothing(std::string_view rest, const char* what) const {
        rest = trimmed(rest, separators);
        if (!rest.empty() && rest.front() != '$' && rest.front() != '!') {
            fail(fmt::format("{}: expected nothing behind {} but a comment", shown_in_message(rest), what));
        }
    }

    void open_section(const std::string& name) {
        const auto [known, is_new] = places_.try_emplace(name, file_.sections.size());
        if (is_new) {
            PropertySection& opened = file_.sections.emplace_back();
            opened.name = name;
            opened.line = line_;
        }
        current_ = known->second;
    }
    PropertySection& section() { return file_.sections[current_]; }

    void read_columns(std::string_view header) {
        PropertySection& table = section();
        if (table.table_line != 0) {
            fail(fmt::format("a second table: expected one in section {}, it is at line {}",
                             shown_in_message(table.name), table.table_line));
        }
        table.table_line = line_;
        for (const std::string_view column : words_of(header)) table.columns.emplace_back(column);
    }

    void read_pair(std::string_view key, std::string_view value) {
        if (key.empty() || key.find_first_of(" \t\v\f\x1a,'\"[]{}()") != key.npos) {
            fail(fmt::format("{}: expected a key of one word before '='", shown_in_message(key)));
        }
        add_entry(upper(key), value);
    }

    void add_entry(std::string key, std::string_view value) {
        PropertyEntry entry{.key = std::move(key), .text = {}, .number = {}, .quoted = false, .line = line_};
        if (value.find_first_of(quotes) == 0) {
            const auto end = value.find(value.front(), 1);
            if (end == value.npos)
                fail(fmt::format("{}: expected a closing {}", shown_in_message(value), value.front()));
            expect_nothing(value.substr(end + 1), "the closing quotation mark");
            entry.quoted = true;
            entry.text = trimmed(value.substr(1, end - 1));
        } else {
            const std::string_view uncommented = trimmed(value.substr(0, value.find_first_of("$!")), separators);
            entry.text = uncommented;
            entry.number = number_in(uncommented);
        }
        section().entries.push_back(std::move(entry));
    }

    void read_row(std::string_view line) {
        const std::vector<std::string_view> words = words_of(line);
        if (words.empty() || !number_in(words.front())) {
            fail(fmt::format("{}: expected 'KEY = value' or a row of numbers", shown_in_message(line)));
        }
        PropertySection& table = section();
        if (table.table_line == 0) table.table_line = line_;
        const std::size_t width = table.rows.empty() ? table.columns.size() : table.rows.front().size();
        if (width != 0 && words.size() != width) {
            fail(fmt::format("{} numbers: expected {} as in the table's {}, line {}", words.size(), width,
                             table.columns.empty() ? "first row" : "header", table.table_line));
        }
        std::vector<double>& row = table.rows.emplace_back();
        for (const std::string_view word : words) {
            const auto number = number_in(word);
            if (!number) fail(fmt::format("{}: expected a number", shown_in_message(word)));
            row.push_back(*number);
        }
    }

    void refuse_repeated_keys(const PropertySection& section) {
        std::vector<std::pair<std::string_view, std::size_t>> keys;  // with their lines
        for (const PropertyEntry& entry : section.entries) {
            if (!entry.key.empty()) keys.emplace_back(entry.key, entry.line);
        }
        std::sort(keys.begin(), keys.end());
        const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
        const auto first = std::adjacent_find(keys.begin(), keys.end(), same);
        if (first == keys.end()) return;
        line_ = first[1].second;
        fail(fmt::format("{} in section {}: expected it once, it is already at line {}", shown_in_message(first->first),
                         shown_in_message(section.name), first->second));
    }

    PropertyFile file_;
    std::size_t line_ = 1, current_ = 0;
    std::string block_;                                    // the section a sub-block belongs to; empty before the first
    std::unordered_map<std::string, std::size_t> places_;  // of the sections, by name
};

}  // namespace

const PropertySection* PropertyFile::find(std::string_view section) const {
    const auto found = std::find_if(sections.begin(), sections.end(), [&](const auto& s) { return s.name == section; });
    return found == sections.end() ? nullptr : &*found;
}

const PropertyEntry* PropertyFile::find(std::string_view section, std::string_view key) const {
    if (const PropertySection* in = find(section)) {
        for (const PropertyEntry& entry : in->entries) {
            if (entry.key == key) return &entry;
        }
    }
    return nullptr;
}

PropertyFile read_property_file(const std::string& path) {
    return parse_property_file(read_whole_file(path, LargestFile::tire), path);
}

PropertyFile parse_property_file(std::string_view text, const std::string& path) {
    return Parser(path).parse(text);
}

std::string shown_in_message(std::string_view text) {
    std::string result(text.substr(0, 40));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + result + (text.size() > 40 ? "...'" : "'");
}

void fail_in_property_file(const std::string& path, std::size_t line, const std::string& message) {
    throw Error(ExitCode::bad_file, fmt::format("{}:{}: {}", path, line, message));
}

}  // namespace hamilcar::io
