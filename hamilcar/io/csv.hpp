// Comma-separated tables as text, and their fields again; results that grow while a run goes on: results.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hamilcar::io {

// A field with a comma or a quotation mark in it is quoted (RFC 4180).
void append_csv_field(std::string& text, std::string_view field);

// The fields of a line; those in quotation marks may contain the separator.
std::vector<std::string_view> csv_fields(std::string_view line, char separator);

// A table written cell by cell.
class CsvText {
public:
    explicit CsvText(const std::vector<std::string>& headings);
    CsvText& cell(std::string_view text);
    // `digits` 0: as many as it takes to read back the same number. What is no finite number is empty.
    CsvText& cell(double number, int digits = 0);
    void end_row() { text_ += '\n', first_ = true; }
    const std::string& text() const { return text_; }

private:
    void separate();

    std::string text_;
    bool first_ = true;
};

}  // namespace hamilcar::io
