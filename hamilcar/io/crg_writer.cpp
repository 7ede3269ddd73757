// Numbers are written with all the digits that their form has room for; keys and the order of sections are those that
// OpenCRG's own tools write.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/crg_file.hpp"
#include "hamilcar/io/crg_parts.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// The best of a number that a field has room for.
void append_field(std::string& text, double number, std::size_t width) {
    std::string field = "*missing*";
    for (int digits = 17; !std::isnan(number) && digits > 0; --digits) {
        field = fmt::format("{:.{}g}", number, digits);
        if (field.size() <= width) break;
    }
    text += fmt::format("{:>{}}", field, width);
}

template <class Bits, class Float>
void append_bits(std::string& text, double number) {
    const auto bits = std::bit_cast<Bits>(static_cast<Float>(number));
    for (int shift = 8 * (sizeof(Bits) - 1); shift >= 0; shift -= 8) text += static_cast<char>(bits >> shift & 0xff);
}

bool evenly_spaced(const std::vector<double>& v) {
    const auto last = static_cast<double>(v.size() - 1);
    const double step = (v.back() - v.front()) / last;
    for (std::size_t j = 0; j < v.size(); ++j)
        if (std::abs(v.front() + static_cast<double>(j) * step - v[j]) > 1e-9 * step) return false;
    return true;
}

void append_key(std::string& text, const char* key, double value) {
    text += fmt::format("{:<24} = ", key);
    append_number(text, value);
    text += '\n';
}

void append_road(std::string& text, const CrgDescription& d, bool even) {
    text += "$ROAD_CRG\n";
    append_key(text, "REFERENCE_LINE_START_U", d.u_start);
    append_key(text, "REFERENCE_LINE_END_U", d.u_end());
    append_key(text, "REFERENCE_LINE_INCREMENT", d.u_increment);
    append_key(text, "REFERENCE_LINE_START_X", d.x);
    append_key(text, "REFERENCE_LINE_START_Y", d.y);
    append_key(text, "REFERENCE_LINE_START_Z", d.z);
    append_key(text, "REFERENCE_LINE_START_PHI", d.headings.empty() ? d.phi : d.headings.front());
    append_key(text, "REFERENCE_LINE_START_S", d.slopes.empty() ? d.slope : d.slopes.front());
    append_key(text, "REFERENCE_LINE_START_B", d.bankings.empty() ? d.banking : d.bankings.front());
    if (d.end_x) append_key(text, "REFERENCE_LINE_END_X", *d.end_x);
    if (d.end_y) append_key(text, "REFERENCE_LINE_END_Y", *d.end_y);
    if (d.end_z) append_key(text, "REFERENCE_LINE_END_Z", *d.end_z);
    // OpenCRG's library takes missing ones as zero: for the heading beyond the end, and for where banking ends.
    append_key(text, "REFERENCE_LINE_END_PHI", d.headings.empty() ? d.phi : d.headings.back());
    append_key(text, "LONG_SECTION_V_RIGHT", d.v.front());
    append_key(text, "LONG_SECTION_V_LEFT", d.v.back());
    if (even)
        append_key(text, "LONG_SECTION_V_INCREMENT", (d.v.back() - d.v.front()) / static_cast<double>(d.v.size() - 1));
    text += "$\n";
}

void append_options(std::string& text, const CrgDescription& d) {
    text += "$ROAD_CRG_OPTS\n";
    append_key(text, "BORDER_MODE_U", static_cast<int>(d.border_u));
    append_key(text, "BORDER_MODE_V", static_cast<int>(d.border_v));
    append_key(text, "BORDER_OFFSET_U", d.border_offset_u);
    append_key(text, "BORDER_OFFSET_V", d.border_offset_v);
    if (d.smooth_start > 0) append_key(text, "BORDER_SMOOTH_UBEG", d.smooth_start);
    if (d.smooth_end > 0) append_key(text, "BORDER_SMOOTH_UEND", d.smooth_end);
    text += "$\n";
    if (d.missing == CrgMissing::keep && d.missing_offset == 0) return;
    text += "$ROAD_CRG_MODS\n";
    append_key(text, "GRID_NAN_MODE", static_cast<int>(d.missing));
    if (d.missing != CrgMissing::none) append_key(text, "GRID_NAN_OFFSET", d.missing_offset);
    text += "$\n";
}

void append_definition(std::string& text, const CrgDescription& d, const char* format, bool even) {
    text += fmt::format("$KD_DEFINITION\n#:{}\nU:reference line u,m,{:.3f},{}\n", format, d.u_start, d.u_increment);
    if (!d.headings.empty()) text += "D:reference line phi,rad\n";
    if (!d.slopes.empty()) text += "D:reference line slope,m/m\n";
    if (!d.bankings.empty()) text += "D:reference line banking,m/m\n";
    for (std::size_t j = 0; j < d.v.size(); ++j)
        text +=
            even ? fmt::format("D:long section {},m\n", j + 1) : fmt::format("D:long section at v = {},m\n", d.v[j]);
    text += "$\n$$$$\n";
}

std::vector<double> row_of(const CrgDescription& d, std::size_t i) {
    std::vector<double> row;
    if (!d.headings.empty()) row.push_back(i > 0 ? d.headings[i - 1] : missing);
    if (!d.slopes.empty()) row.push_back(i > 0 ? d.slopes[i - 1] : missing);
    if (!d.bankings.empty()) row.push_back(d.bankings[i]);
    const auto first = d.heights.begin() + static_cast<std::ptrdiff_t>(i * d.columns());
    row.insert(row.end(), first, first + static_cast<std::ptrdiff_t>(d.columns()));
    return row;
}

void append_rows(std::string& text, const CrgDescription& d, CrgFormat format) {
    const bool ascii = format == CrgFormat::long_ascii_single || format == CrgFormat::long_ascii_double;
    const std::size_t width = format == CrgFormat::long_ascii_single ? 10 : 20;
    const auto append = [&](double number) {
        if (format == CrgFormat::binary_single) return append_bits<std::uint32_t, float>(text, number);
        if (format == CrgFormat::binary_double) return append_bits<std::uint64_t, double>(text, number);
        append_field(text, number, width);
    };
    const std::size_t begin = text.size();
    for (std::size_t i = 0; i < d.rows(); ++i) {
        const std::vector<double> row = row_of(d, i);
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (ascii && k > 0 && k * width % crg::record == 0) text += '\n';
            append(row[k]);
        }
        if (ascii) text += '\n';
    }
    while (!ascii && (text.size() - begin) % crg::record != 0) append(missing);
}
}  // namespace

void write_crg(const CrgDescription& d, const std::string& path, CrgFormat format) {
    const std::size_t rows = d.rows(), columns = d.columns();
    if (rows < 2 || columns < 2 || rows * columns != d.heights.size() ||
        (!d.headings.empty() && d.headings.size() != rows - 1) || (!d.slopes.empty() && d.slopes.size() != rows - 1) ||
        (!d.bankings.empty() && d.bankings.size() != rows))
        throw std::invalid_argument("an OpenCRG file needs a grid, and headings, slopes and bankings that fit it");
    constexpr std::array<const char*, 4> names{"LRFI", "LDFI", "KRBI", "KDBI"};
    const bool even = evenly_spaced(d.v);
    std::string text = "$CT\nWritten by Hamilcar\n$\n";
    append_road(text, d, even);
    append_options(text, d);
    append_definition(text, d, names[static_cast<std::size_t>(format)], even);
    append_rows(text, d, format);
    write_whole_file(path, {text});
}

}  // namespace hamilcar::io
