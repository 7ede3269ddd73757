// Every line says by its first character what it is: '[' a section, '(' a sub-block, '{' a table's header, a quotation
// mark a text, a number without '=' behind it a row, anything else a pair. Only a value that begins with a quotation
// mark can hold '$' or '!': elsewhere these begin a comment, whatever quotation marks come before them.
#include "hamilcar/io/property_file.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::string_view blanks = " \t\v\f\x1a";  // also the end-of-file mark of old DOS editors
constexpr std::string_view quotes = "'\"";
constexpr std::string_view separators = " \t\v\f\x1a,";

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
        if (text.size() > FileLimit::tire) fail("more than 4 MB: expected a property file of up to 4 MB");
        text = without_byte_order_mark(text);
        const std::string narrow = narrowed(text);
        if (!narrow.empty()) text = narrow;
        while (!text.empty()) {
            const auto end = std::min(text.find_first_of("\r\n"), text.size());
            read_line(trimmed(text.substr(0, end), blanks));
            text.remove_prefix(std::min(end + (text.substr(end).starts_with("\r\n") ? 2 : 1), text.size()));
            ++line_;
        }
        return std::move(file_);
    }

private:
    [[noreturn]] void fail(const std::string& message) const { fail_in_property_file(file_.path, line_, message); }
    void note(std::string text) {
        constexpr std::size_t max_notes = 1000;  // of a file that is none, the rest is no news
        if (file_.notes.size() < max_notes) file_.notes.push_back({line_, std::move(text)});
    }

    // Of UTF-16, told by its mark: what is beyond Latin-1 stands only in comments. Empty for anything else.
    static std::string narrowed(std::string_view text) {
        const bool little = text.starts_with("\xFF\xFE");
        if (!little && !text.starts_with("\xFE\xFF")) return {};
        std::string out;
        for (std::size_t i = 2; i + 1 < text.size(); i += 2)
            out += text[little ? i + 1 : i] == '\0' ? text[little ? i : i + 1] : '?';
        return out + "\n";
    }

    void read_line(std::string_view line) {
        if (line.empty() || line.front() == '$' || line.front() == '!') return;
        if (line.front() == '[') {
            return open_section(block_ = upper_case(between(line, ']', "a section")));
        }
        if (line.front() == '(') {
            if (block_.empty()) fail(fmt::format("sub-block {}: expected a [section] first", quoted_text(line)));
            return open_section(block_ + "/" + upper_case(between(line, ')', "a sub-block")));
        }
        if (block_.empty()) return note(fmt::format("{} before the first [section] is not used", quoted_text(line)));
        if (line.front() == '{') return read_columns(between(line, '}', "a table's header"));
        if (line.find_first_of(quotes) == 0) return add_entry({}, line);
        const std::string_view uncommented = line.substr(0, line.find_first_of("$!"));
        if (const auto equals = uncommented.find('='); equals != std::string_view::npos) {
            return read_pair(trimmed(line.substr(0, equals), blanks), trimmed(line.substr(equals + 1), blanks));
        }
        read_row(trimmed(uncommented, blanks));
    }

    // What stands between the line's first character and the closing one; behind it only a comment may follow.
    std::string_view between(std::string_view line, char closing, const char* what) {
        const auto end = line.find(closing);
        if (end == line.npos) fail(fmt::format("{}: expected {} to end with '{}'", quoted_text(line), what, closing));
        expect_nothing(line.substr(end + 1), what);
        const std::string_view name = trimmed(line.substr(1, end - 1), blanks);
        if (name.empty() && closing != '}') fail(fmt::format("{}: expected {} with a name", quoted_text(line), what));
        return name;
    }

    void expect_nothing(std::string_view rest, const char* what) {
        rest = trimmed(rest, separators);
        if (!rest.empty() && rest.front() != '$' && rest.front() != '!') {
            note(fmt::format("{} behind {} is not used", quoted_text(rest), what));
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
        in_second_table_ = false;
    }
    PropertySection& section() { return file_.sections[current_]; }

    void read_columns(std::string_view header) {
        PropertySection& table = section();
        in_second_table_ = table.table_line != 0;
        if (in_second_table_)
            return note(
                fmt::format("a second table of [{}] is not used, only that at line {}", table.name, table.table_line));
        table.table_line = line_;
        for (const std::string_view column : words_of(header)) table.columns.emplace_back(column);
    }

    void read_pair(std::string_view key, std::string_view value) {
        if (key.empty() || key.find_first_of(" \t\v\f\x1a,'\"[]{}()") != key.npos) {
            return note(fmt::format("{} before '=' is not used: it is no key of one word", quoted_text(key)));
        }
        add_entry(upper_case(key), value);
    }

    void add_entry(std::string key, std::string_view value) {
        PropertyEntry entry{.key = std::move(key), .text = {}, .number = {}, .quoted = false, .line = line_};
        if (value.find_first_of(quotes) == 0) {
            auto end = value.find(value.front(), 1);
            if (end == value.npos) {
                end = std::min(value.find_first_of("$!"), value.size());
                note(fmt::format("{} has no closing {}", quoted_text(value), value.front()));
            } else {
                expect_nothing(value.substr(end + 1), "the closing quotation mark");
            }
            entry.quoted = true;
            entry.text = trimmed(value.substr(1, end - 1), blanks);
            entry.number = number_in(entry.text);
        } else {
            const std::string_view uncommented = trimmed(value.substr(0, value.find_first_of("$!")), separators);
            entry.text = uncommented;
            entry.number = number_in(uncommented);
            if (!entry.number) read_decimal_comma(entry);
        }
        section().entries.push_back(std::move(entry));
    }

    // Programs in languages that write 0,3 for 0.3.
    void read_decimal_comma(PropertyEntry& entry) {
        const auto comma = entry.text.find(',');
        if (comma == std::string::npos || entry.text.find('.') != std::string::npos) return;
        std::string pointed = entry.text;
        pointed[comma] = '.';
        entry.number = number_in(pointed);
        if (entry.number) note(fmt::format("{} = {} is read as {}", entry.key, quoted_text(entry.text), pointed));
    }

    void read_row(std::string_view line) {
        if (in_second_table_) return;
        const std::vector<std::string_view> words = words_of(line);
        if (words.empty() || !number_in(words.front()))
            return note(
                fmt::format("{} is not used: it is neither KEY = value nor a row of numbers", quoted_text(line)));
        PropertySection& table = section();
        const std::size_t width = table.rows.empty() ? table.columns.size() : table.rows.front().size();
        if (width != 0 && words.size() != width)
            return note(fmt::format("a row of {} is not used: the table's {}, line {}, has {}", words.size(),
                                    table.columns.empty() ? "first row" : "header", table.table_line, width));
        std::vector<double> row;
        for (const std::string_view word : words) {
            const auto number = number_in(word);
            if (!number) return note(fmt::format("the row with {} is not used: that is no number", quoted_text(word)));
            row.push_back(*number);
        }
        if (table.table_line == 0) table.table_line = line_;
        table.rows.push_back(std::move(row));
    }

    PropertyFile file_;
    std::size_t line_ = 1, current_ = 0;
    bool in_second_table_ = false;                         // of a section, up to the next one
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
    return parse_property_file(read_whole_file(path, FileLimit::tire), path);
}

PropertyFile parse_property_file(std::string_view text, const std::string& path) {
    return Parser(path).parse(text);
}

void fail_in_property_file(const std::string& path, std::size_t line, const std::string& message) {
    throw Error(ExitCode::bad_file, fmt::format("{}:{}: {}", path, line, message));
}

}  // namespace hamilcar::io
