// What the header says of the road, checked against its rows. Format: the ASAM OpenCRG 1.2 specification; where it is
// silent, the reference implementation (crgLoader.c; crg_read.m, ipl_read.m of its MATLAB part).
#include "hamilcar/io/crg_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hamilcar/io/crg_modifiers.hpp"
#include "hamilcar/io/crg_rows.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace crg {

namespace {

// Start and spacing of the reference line. The virtual channel repeats them, rounded; it counts where no key tells
// them.
void place_line(const Header& header, CrgDescription& road) {
    const auto coordinate = [&](const char* key) { return header.number(road_section, key, 0, -farthest, farthest); };
    double start = 0, step = 0.01;
    if (header.u_channel().value.starts_with("reference line u")) {
        std::array<std::string_view, 4> fields;
        std::string_view text = header.u_channel().value;
        for (std::string_view& field : fields) {
            field = text.substr(0, text.find(','));
            text.remove_prefix(std::min(text.size(), field.size() + 1));
        }
        start = number_in(fields[2]).value_or(coordinate("reference_line_start_u"));
        step = number_in(fields[3]).value_or(
            header.number(road_section, "reference_line_increment", step, least_step, most_step));
        if (!(std::abs(start) <= farthest && step >= least_step && step <= most_step))
            header.fail(header.u_channel().line, "u:reference line u", "m, a start and an increment");
    }
    road.u_start = header.number(road_section, "reference_line_start_u", start, -farthest, farthest);
    road.u_increment = header.number(road_section, "reference_line_increment", step, least_step, most_step);
    const double rounding = 1e-3 + 1e-6 * std::abs(start);  // [m]
    if (header.u_channel().line > 0 &&
        (std::abs(road.u_start - start) > rounding || std::abs(road.u_increment - step) > 1e-3))
        header.fail(header.u_channel().line, "u:reference line u", "the start and increment of $road_crg");

    road.x = coordinate("reference_line_start_x");
    road.y = coordinate("reference_line_start_y");
    road.z = header.number(road_section, "reference_line_start_z", 0, -highest, highest);
    road.phi = header.number(road_section, "reference_line_start_phi", 0, -most_turned, most_turned);
    road.slope = header.number(road_section, "reference_line_start_s", 0, -steepest, steepest);
    road.banking = header.number(road_section, "reference_line_start_b", 0, -steepest, steepest);
    road.end_x = header.maybe(road_section, "reference_line_end_x", farthest);
    road.end_y = header.maybe(road_section, "reference_line_end_y", farthest);
    road.end_z = header.maybe(road_section, "reference_line_end_z", highest);
    if (road.end_x.has_value() != road.end_y.has_value()) {
        const std::string key = road.end_x ? "reference_line_end_x" : "reference_line_end_y";
        header.fail(header.line_of(road_section, key), key, "both reference_line_end_x and reference_line_end_y");
    }
}

void read_options(const Header& header, CrgDescription& road) {
    const std::string& of = options_section;
    road.border_u = static_cast<CrgBorder>(header.choice(of, "border_mode_u", 2, 4));
    road.border_v = static_cast<CrgBorder>(header.choice(of, "border_mode_v", 2, 4));
    road.border_offset_u = header.number(of, "border_offset_u", 0, -highest, highest);
    road.border_offset_v = header.number(of, "border_offset_v", 0, -highest, highest);
    road.smooth_start = header.number(of, "border_smooth_ubeg", 0, 0, farthest);
    road.smooth_end = header.number(of, "border_smooth_uend", 0, 0, farthest);

    // Without the section missing heights are those of their neighbors; with it, only what it says is done.
    const std::string& by = modifiers_section;
    const bool offset = header.has(by, "grid_nan_offset");
    const int fallback = header.has_section(by) && !offset ? 0 : 2;
    road.missing = static_cast<CrgMissing>(header.choice(by, "grid_nan_mode", fallback, 2));
    road.missing_offset = header.number(by, "grid_nan_offset", 0, -highest, highest);
    if (offset && road.missing == CrgMissing::none)
        header.fail(header.line_of(by, "grid_nan_offset"), "grid_nan_offset", "a grid_nan_mode that fills in heights");
}

// The end of the line must be where its steps lead, near enough; what is constant must end as it begins.
void check_ends(const Header& header, const Channels& channels, CrgDescription& road) {
    const double turn = 2 * std::acos(-1.0);
    const auto same = [&](const char* key, double start, bool varies, double limit) {
        if (varies || !header.has(road_section, key)) return;
        const double change = header.number(road_section, key, 0, -most_turned, most_turned) - start;
        if (std::abs(std::remainder(change, turn)) > limit)
            header.fail(header.line_of(road_section, key), key,
                        "the start's value, since no channel says how it changes");
    };
    same("reference_line_end_phi", road.phi, channels.phi.has_value(), 1e-5);
    same("reference_line_end_s", road.slope, channels.slope.has_value(), 1e-6);
    same("reference_line_end_b", road.banking, channels.banking.has_value(), 1e-6);

    // Spread over the line a miss within this bends no segment noticeably.
    const auto segments = static_cast<double>(road.rows() - 1);
    const double limit = 0.1 * road.u_increment * std::sqrt(segments) + 1e-6 * segments * road.u_increment;
    double x = road.x, y = road.y, z = road.z;
    for (std::size_t i = 0; i + 1 < road.rows(); ++i) {
        const double phi = channels.phi ? road.headings[i] : road.phi;
        x += road.u_increment * std::cos(phi);
        y += road.u_increment * std::sin(phi);
        z += road.u_increment * (channels.slope ? road.slopes[i] : road.slope);
    }
    if (road.end_x && std::hypot(*road.end_x - x, *road.end_y - y) > limit)
        header.fail(header.line_of(road_section, "reference_line_end_x"), "reference_line_end_x",
                    fmt::format("an end near ({:g}, {:g}) m, where the headings lead", x, y));
    if (road.end_z && std::abs(*road.end_z - z) > limit)
        header.fail(header.line_of(road_section, "reference_line_end_z"), "reference_line_end_z",
                    fmt::format("an end near {:g} m, where the slopes lead", z));
    if (channels.phi) road.phi = road.headings.front();
    if (channels.slope) road.slope = road.slopes.front();
    if (channels.banking) road.banking = road.bankings.front();
    if (!channels.phi) road.end_x = road.end_y = std::nullopt;
    if (!channels.slope) road.end_z = std::nullopt;
}

// Whether the line comes back to where it began, to within a step: the first row may be there again as the last, or not.
bool ends_at_start(const CrgDescription& road) {
    double x = 0, y = 0;
    for (const double phi : road.headings) {
        x += road.u_increment * std::cos(phi);
        y += road.u_increment * std::sin(phi);
    }
    if (road.end_x) x = *road.end_x - road.x, y = *road.end_y - road.y;
    return road.headings.size() > 1 && std::hypot(x, y) <= road.u_increment * (1 + 1e-6);
}

// A line that goes on from its end to its start is a grid that begins again. Many a file says so of an open road, where
// it can mean nothing.
void close_line(const Header& header, CrgDescription& road) {
    const std::array<std::pair<std::string, const char*>, 3> spellings{
        {{options_section, "refline_continuation"},
         {options_section, "reference_line_continuation"},
         {road_section, "reference_line_continuation"}}};
    bool wanted = false;
    for (const auto& [section, key] : spellings) wanted = header.choice(section, key, 0, 1) == 1 || wanted;
    if (wanted && ends_at_start(road)) road.border_u = CrgBorder::repeat;
}

}  // namespace

}  // namespace crg

CrgDescription parse_crg(std::string_view bytes, const std::string& name) {
    crg::Text text(bytes);
    const crg::Header header(text, name);
    CrgDescription road;
    crg::place_line(header, road);
    const crg::Channels channels = crg::find_channels(header);
    road.v = channels.v;
    crg::read_options(header, road);
    crg::read_rows(text, header, channels, road);
    crg::check_ends(header, channels, road);
    crg::modify(header, road);
    crg::close_line(header, road);
    return road;
}

CrgDescription read_crg(const std::string& path) {
    return parse_crg(read_whole_file(path, LargestFile::road), path);
}

}  // namespace hamilcar::io
