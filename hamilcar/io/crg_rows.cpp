#include "hamilcar/io/crg_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hamilcar::io::crg {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

class RowReader {
public:
    RowReader(Text& text, const Header& header, const Channels& channels, CrgDescription& road)
        : text_(text), header_(header), channels_(channels), road_(road) {}
    void read();
    void drop_padding();

private:
    double ascii_number(std::string_view field, std::size_t channel) const;
    void read_ascii_rows(std::size_t width);
    template <class Bits, class Float>
    void read_binary_rows();
    void add_row(const std::vector<double>& row);

    Text& text_;
    const Header& header_;
    const Channels& channels_;
    CrgDescription& road_;
};

double RowReader::ascii_number(std::string_view field, std::size_t channel) const {
    const std::string_view text = trimmed(field);
    if (text.starts_with('*')) return missing;
    const std::optional<double> read = number_in(text);
    if (!read || std::isinf(*read))
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

// Rows follow each other without regard to records; what is left of the last record is NaN.
template <class Bits, class Float>
void RowReader::read_binary_rows() {
    std::vector<double> row(header_.channels().size());
    const std::size_t bytes = row.size() * sizeof(Bits);
    while (text_.rest().size() >= bytes) {
        bool any = false;
        for (std::size_t i = 0; i < row.size(); ++i) {
            Bits bits = 0;
            for (std::size_t k = 0; k < sizeof(Bits); ++k)
                bits = static_cast<Bits>(bits << 8 | static_cast<unsigned char>(text_.rest()[i * sizeof(Bits) + k]));
            row[i] = std::bit_cast<Float>(bits);
            any = any || !std::isnan(row[i]);
        }
        if (!any && text_.rest().size() < record) break;
        text_.skip(bytes);
        add_row(row);
    }
}

// Headings and slopes lead to their row from the one before, so the first row's say nothing.
void RowReader::add_row(const std::vector<double>& row) {
    const auto fail_at = [&](std::size_t channel, const std::string& expected) {
        header_.fail(text_.line(), "d:" + header_.channels()[channel].name,
                     fmt::format("{} in row {}", expected, road_.rows() + 1));
    };
    const auto take = [&](std::optional<std::size_t> channel, std::vector<double>& into, double most, bool from_first) {
        if (!channel || (road_.heights.empty() && !from_first)) return;
        if (!(std::abs(row[*channel]) <= most))
            fail_at(*channel, fmt::format("a number from {:g} to {:g}", -most, most));
        into.push_back(row[*channel]);
    };
    take(channels_.phi, road_.headings, most_turned, false);
    take(channels_.slope, road_.slopes, steepest, false);
    take(channels_.banking, road_.bankings, steepest, true);
    const std::size_t turns = road_.headings.size();
    if (turns > 1 && std::cos(road_.headings[turns - 1] - road_.headings[turns - 2]) < std::cos(sharpest_turn))
        fail_at(*channels_.phi, fmt::format("a turn of {:g} rad at most", sharpest_turn));
    for (const std::size_t channel : channels_.sections)
        if (std::abs(row[channel]) > highest) fail_at(channel, fmt::format("a height of {:g} m at most", highest));
    for (const std::size_t channel : channels_.sections) road_.heights.push_back(row[channel]);
}

void RowReader::read() {
    const std::string& format = header_.format().value;
    if (header_.channels().empty()) header_.fail(header_.definition_line(), "d:", "channels of data");
    if (format == "lrfi")
        read_ascii_rows(10);
    else if (format == "ldfi")
        read_ascii_rows(20);
    else if (format == "krbi")
        read_binary_rows<std::uint32_t, float>();
    else if (format == "kdbi")
        read_binary_rows<std::uint64_t, double>();
    else
        header_.fail(std::max(header_.format().line, header_.definition_line()),
                     "#:", "LRFI, LDFI, KRBI or KDBI, not '" + format + "'");
}

// A row of nothing at the end is padding, written by whoever counts records instead of rows.
void RowReader::drop_padding() {
    const auto nothing = [&] {
        const auto last = road_.heights.end() - static_cast<std::ptrdiff_t>(road_.columns());
        return std::all_of(last, road_.heights.end(), [](double z) { return std::isnan(z); });
    };
    const auto last =
        (header_.number(road_section, "reference_line_end_u", road_.u_end(), -farthest, farthest) - road_.u_start) /
        road_.u_increment;
    const bool told = header_.has(road_section, "reference_line_end_u");
    while (road_.rows() > 1 && nothing() && (!told || static_cast<double>(road_.rows()) > std::round(last) + 1)) {
        road_.heights.resize(road_.heights.size() - road_.columns());
        for (std::vector<double>* numbers : {&road_.headings, &road_.slopes, &road_.bankings})
            if (!numbers->empty()) numbers->pop_back();
    }
    if (road_.rows() < 2) header_.fail(text_.line(), "$$$$", "two rows of data at least after this line");
    if (told && static_cast<double>(road_.rows()) != std::round(last) + 1)
        header_.fail(header_.line_of(road_section, "reference_line_end_u"), "reference_line_end_u",
                     fmt::format("{:g}, where {} rows of data lead", road_.u_end(), road_.rows()));
    if (!(std::abs(road_.u_end()) <= farthest)) header_.fail(text_.line(), "$$$$", "a road less long");
}

}  // namespace

void read_rows(Text& text, const Header& header, const Channels& channels, CrgDescription& road) {
    RowReader reader(text, header, channels, road);
    reader.read();
    reader.drop_padding();
}

}  // namespace hamilcar::io::crg
