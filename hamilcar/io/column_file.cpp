#include "hamilcar/io/column_file.hpp"

#include <algorithm>

#include "hamilcar/base/key_unit.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/crg_parts.hpp"
#include "hamilcar/io/csv.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

struct Heading {
    std::string_view name, unit;
};

Heading heading_of(std::string_view field) {
    const std::size_t open = field.rfind('[');
    if (open == std::string_view::npos || !field.ends_with(']')) return {field, {}};
    return {trimmed(field.substr(0, open)), trimmed(field.substr(open + 1, field.size() - open - 2))};
}

// Where a column stands, and what its numbers are multiplied by to be SI.
struct Column {
    std::string name;
    std::size_t place;
    double to_si;
};

class ColumnReader {
public:
    ColumnReader(std::string_view text, const std::string& path, const ColumnRequest& request)
        : text_(without_byte_order_mark(text)), path_(path), request_(request) {}

    Samples read() {
        std::string_view line = next();
        if (line.empty()) fail("no line with headings: expected one with '" + request_.value + "' in it");
        const std::size_t at = line.find_first_of(",;\t");
        separator_ = at == std::string_view::npos ? ',' : line[at];
        const std::vector<std::string_view> headings = csv_fields(line, separator_);
        const Column x = column(headings, request_.argument, request_.argument_key);
        const Column y = column(headings, request_.value, request_.value_key);
        const double unit = unit_of_key(request_.value_key).to_si;
        Samples samples;
        while (!(line = next()).empty()) {
            const std::vector<std::string_view> fields = csv_fields(line, separator_);
            if (fields.size() != headings.size()) {
                fail(std::to_string(fields.size()) + " fields: expected " + std::to_string(headings.size()) +
                     ", one for each heading");
            }
            const double argument = number(fields, x);
            if (!samples.argument.empty() && !(argument > samples.argument.back())) {
                fail("'" + x.name + "' = " + std::string(fields[x.place]) + ": expected a number above the one before");
            }
            const double value = number(fields, y);
            check(value / unit, fields[y.place], y);
            samples.argument.push_back(argument), samples.value.push_back(value);
        }
        if (samples.argument.empty()) fail("no line of numbers below the headings");
        return samples;
    }

private:
    // The next line that says something; empty at the end.
    std::string_view next() {
        while (!text_.rest().empty()) {
            const std::string_view line = text_.next_line();
            if (const auto said = trimmed(line); !said.empty() && said.front() != '#') return line;
        }
        return {};
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ExitCode::bad_file, path_ + ":" + std::to_string(std::max(1, text_.line())) + ": " + what);
    }

    Column column(const std::vector<std::string_view>& headings, const std::string& name, std::string_view key) const {
        std::vector<std::string_view> names;
        for (const std::string_view heading : headings) names.push_back(heading_of(heading).name);
        const auto count = std::ranges::count(names, name);
        if (count > 1) fail("heading '" + name + "' stands here " + std::to_string(count) + " times: expected once");
        if (count == 0) {
            const std::string guess = did_you_mean(name, names);
            fail("no heading '" + name + "': " + (guess.empty() ? "expected " + quoted_list(names) : guess));
        }
        const auto place = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
        const KeyUnit wanted = unit_of_key(key);
        const std::string_view unit = heading_of(headings[place]).unit;
        if (unit.empty()) return {name, place, wanted.to_si};
        const auto given = units::product(unit), own = units::product(wanted.symbol);
        if (!given || !own || given->si != own->si) {
            fail("'" + name + "' is in [" + std::string(unit) + "]: expected [" + wanted.symbol +
                 "] or a unit that stands for the same");
        }
        return {name, place, given->to_si};
    }

    double number(const std::vector<std::string_view>& fields, const Column& of) const {
        const auto value = number_in(fields[of.place]);
        if (!value) {
            fail("'" + of.name + "' = '" + std::string(fields[of.place]) + "': expected a finite number");
        }
        return *value * of.to_si;
    }

    void check(double value, std::string_view written, const Column& of) const {
        const Range& range = request_.range;
        const bool enough = range.min_included ? value >= range.min : value > range.min;
        if (enough && value <= range.max) return;
        fail("'" + of.name + "' = " + std::string(written) + ": expected a " +
             with_unit(std::string(range.words), request_.value_key));
    }

    crg::Text text_;
    const std::string& path_;
    const ColumnRequest& request_;
    char separator_ = ',';
};

}  // namespace

Samples parse_columns(std::string_view text, const std::string& path, const ColumnRequest& request) {
    return ColumnReader(text, path, request).read();
}

std::string read_named_file(const TableReader& table, std::string_view key) {
    const std::string path = table.path_to_file(key);
    try {
        return std::string(without_byte_order_mark(read_whole_file(path, FileLimit::columns)));
    } catch (const Error& unreadable) {
        try {
            table.expect(false, key, std::string("a file that can be read, but ") + unreadable.what());
        } catch (const Error& at_key) {
            throw Error(unreadable.code(), at_key.what());
        }
        throw;
    }
}

}  // namespace hamilcar::io
