#include "hamilcar/io/crg_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "hamilcar/base/text.hpp"

namespace hamilcar::io::crg {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

class RowReader {
public:
    RowReader(Text& text, const Header& header, const Channels& channels, CrgDescription& road)
        : text_(text), header_(header), channels_(channels), road_(road) {}
    void read();

private:
    // What the letters of the format say.
    struct Form {
        bool long_rows;       // each row begins on a new line, or a new record of binary data
        bool double_numbers;  // 20 instead of 10 characters, or 8 instead of 4 bytes
        bool ascii;
    };
    Form form() const;
    double ascii_number(std::string_view field, std::size_t channel) const;
    void read_ascii_rows(std::size_t width);
    void read_ascii_fields(std::size_t width);
    template <class Bits, class Float>
    void read_binary_rows(bool long_rows);
    void place_by_u();
    std::optional<std::size_t> told_rows() const;
    void add_row(const std::vector<double>& row);
    void drop_padding();

    Text& text_;
    const Header& header_;
    const Channels& channels_;
    CrgDescription& road_;
    std::vector<double> u_;  // of each row, if there is a channel of it
};

double RowReader::ascii_number(std::string_view field, std::size_t channel) const {
    const std::string_view text = trimmed(field);
    if (same_word(text, "**unused**")) return 0;
    if (text.starts_with('*') || same_word(text, "nan")) return missing;
    const std::optional<double> read = number_in(text);
    if (!read)
        header_.fail(text_.line(), "d:" + header_.channels()[channel].name,
                     fmt::format("a number or *missing*, not '{}'", plain(text)));
    return *read;
}

// Each row begins on a new line and goes on in as many as it takes.
void RowReader::read_ascii_rows(std::size_t width) {
    std::vector<double> row(header_.channels().size());
    const std::size_t per_line = record / width;
    while (!text_.rest().empty()) {
        std::string_view line = text_.next_line();
        if (trimmed(line).empty()) continue;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::size_t at = i % per_line * width;
            if (i > 0 && at == 0) line = text_.next_line();
            row[i] = ascii_number(at < line.size() ? line.substr(at, width) : std::string_view(), i);
        }
        add_row(row);
    }
}

// Numbers follow each other without regard to lines.
void RowReader::read_ascii_fields(std::size_t width) {
    std::vector<double> row;
    while (!text_.rest().empty()) {
        for (std::string_view line = text_.next_line(); !trimmed(line).empty();
             line.remove_prefix(std::min(width, line.size()))) {
            row.push_back(ascii_number(line.substr(0, width), row.size()));
            if (row.size() < header_.channels().size()) continue;
            add_row(row);
            row.clear();
        }
    }
}

// Rows follow each other without regard to records, unless they are long; what is left of the last record is NaN. What is
// behind the end that the header tells does not count.
template <class Bits, class Float>
void RowReader::read_binary_rows(bool long_rows) {
    std::vector<double> row(header_.channels().size());
    const std::size_t bytes = row.size() * sizeof(Bits);
    const std::size_t padding = long_rows ? (record - bytes % record) % record : 0;
    const std::optional<std::size_t> told = told_rows();
    while (text_.rest().size() >= bytes && !(told && road_.rows() >= *told)) {
        bool any = false;
        for (std::size_t i = 0; i < row.size(); ++i) {
            Bits bits = 0;
            for (std::size_t k = 0; k < sizeof(Bits); ++k)
                bits = static_cast<Bits>(bits << 8 | static_cast<unsigned char>(text_.rest()[i * sizeof(Bits) + k]));
            row[i] = std::bit_cast<Float>(bits);
            any = any || !std::isnan(row[i]);
        }
        if (!any && text_.rest().size() < record) break;
        text_.skip(std::min(bytes + padding, text_.rest().size()));
        add_row(row);
    }
    if (told && road_.rows() < *told)
        header_.fail(header_.line_of(road_section, "reference_line_end_u"), "reference_line_end_u",
                     fmt::format("{:g}, where {} rows of data lead", road_.u_end(), road_.rows()));
}

// How many rows lead to the end that the header tells.
std::optional<std::size_t> RowReader::told_rows() const {
    const char* key = "reference_line_end_u";
    if (!header_.has(road_section, key) || channels_.u) return std::nullopt;
    const double end = header_.number(road_section, key, 0, -max_distance, max_distance);
    const double rows = std::floor((end - road_.u_start) / road_.u_increment + 0.5) + 1;
    return rows >= 1 && rows < 1e15 ? std::optional(static_cast<std::size_t>(rows)) : std::nullopt;
}

// Headings and slopes lead to their row from the one before, so the first row's say nothing.
void RowReader::add_row(const std::vector<double>& row) {
    const auto fail_at = [&](std::size_t channel, const std::string& expected) {
        header_.fail(text_.line(), "d:" + header_.channels()[channel].name,
                     fmt::format("{} in row {}", expected, road_.rows() + 1));
    };
    const auto take = [&](std::optional<std::size_t> channel, std::vector<double>& into, double max, bool from_first) {
        if (!channel || (road_.heights.empty() && !from_first)) return;
        if (!(std::abs(row[*channel]) <= max)) fail_at(*channel, fmt::format("a number from {:g} to {:g}", -max, max));
        into.push_back(row[*channel]);
    };
    take(channels_.phi, road_.headings, max_heading, false);
    take(channels_.slope, road_.slopes, max_slope, false);
    take(channels_.banking, road_.bankings, max_slope, true);
    const std::size_t turns = road_.headings.size();
    if (turns > 1 && std::cos(road_.headings[turns - 1] - road_.headings[turns - 2]) < std::cos(max_turn))
        fail_at(*channels_.phi, fmt::format("a turn of {:g} rad at most", max_turn));
    for (const std::size_t channel : channels_.sections)
        if (std::abs(row[channel]) > max_height)
            fail_at(channel, fmt::format("a height of {:g} m at most", max_height));
    for (const std::size_t channel : channels_.sections) road_.heights.push_back(row[channel]);
    if (channels_.u) u_.push_back(row[*channels_.u]);
}

// A channel of u counts before what the header says; its steps are as even as OpenCRG's library asks for.
void RowReader::place_by_u() {
    if (!channels_.u || u_.size() < 2) return;
    const auto fail = [&](const std::string& expected) {
        header_.fail(header_.channels()[*channels_.u].line, "d:reference line u", expected);
    };
    constexpr double tolerance = 0.03;
    double smallest = u_[1] - u_[0], largest = smallest;
    for (std::size_t i = 1; i < u_.size(); ++i) {
        const double step = u_[i] - u_[i - 1];
        if (!(std::abs(u_[i]) <= max_distance && step >= min_step && step <= max_step))
            fail(fmt::format("steps of {:g} to {:g} m, not {:g} m to row {}", min_step, max_step, step, i + 1));
        smallest = std::min(smallest, step), largest = std::max(largest, step);
    }
    if (largest - smallest > tolerance * smallest)
        fail(fmt::format("even steps, not {:g} to {:g} m", smallest, largest));
    road_.u_start = u_.front();
    road_.u_increment = (u_.back() - u_.front()) / static_cast<double>(u_.size() - 1);
}

RowReader::Form RowReader::form() const {
    const std::string& format = header_.format().value;
    const auto one_of = [&](std::size_t i, std::string_view letters) {
        return i < format.size() && letters.find(format[i]) != std::string_view::npos;
    };
    const std::size_t end = format.find_first_of("fb");  // some leave out the letter of the kind
    const bool known = one_of(0, "lk") && one_of(1, "rd") && (end == 2 && (format.size() == 3 || format[3] == 'i'));
    if (!known || format.size() > 4)
        header_.fail(std::max(header_.format().line, header_.definition_line()),
                     "#:", "LRFI, LDFI, KRBI or KDBI, not '" + format + "'");
    return {format[0] == 'l', format[1] == 'd', format[2] == 'f'};
}

void RowReader::read() {
    if (header_.channels().empty()) header_.fail(header_.definition_line(), "d:", "channels of data");
    const auto [long_rows, double_numbers, ascii] = form();
    const std::size_t width = double_numbers ? 20 : 10;
    if (ascii && long_rows)
        read_ascii_rows(width);
    else if (ascii)
        read_ascii_fields(width);
    else if (double_numbers)
        read_binary_rows<std::uint64_t, double>(long_rows);
    else
        read_binary_rows<std::uint32_t, float>(long_rows);
    drop_padding();
    place_by_u();
    if (!(std::abs(road_.u_end()) <= max_distance))
        header_.fail(text_.line(), "$$$$",
                     fmt::format("a road within {:g} m of u = 0, not up to {:g} m", max_distance, road_.u_end()));
}

// A row of nothing at the end is padding, written by programs that count records instead of rows.
void RowReader::drop_padding() {
    const auto nothing = [&] {
        const auto last = road_.heights.end() - static_cast<std::ptrdiff_t>(road_.columns());
        return std::all_of(last, road_.heights.end(), [](double z) { return std::isnan(z); });
    };
    const std::optional<std::size_t> told = told_rows();
    while (road_.rows() > 1 && nothing() && (!told || road_.rows() > *told)) {
        road_.heights.resize(road_.heights.size() - road_.columns());
        for (std::vector<double>* numbers : {&road_.headings, &road_.slopes, &road_.bankings, &u_})
            if (!numbers->empty()) numbers->pop_back();
    }
    if (road_.rows() < 2) header_.fail(text_.line(), "$$$$", "two rows of data at least after this line");
    if (told && road_.rows() != *told)
        road_.remarks.push_back(
            header_.remark(header_.line_of(road_section, "reference_line_end_u"), "reference_line_end_u",
                           fmt::format("is not used: {} rows of data lead to {:g}", road_.rows(), road_.u_end())));
}

}  // namespace

void read_rows(Text& text, const Header& header, const Channels& channels, CrgDescription& road) {
    RowReader reader(text, header, channels, road);
    reader.read();
}

}  // namespace hamilcar::io::crg
