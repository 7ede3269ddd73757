// What the header says of the road, checked against its rows. Format: the ASAM OpenCRG 1.2 specification; where it is
// silent, the reference implementation (crgLoader.c; crg_read.m, ipl_read.m of its MATLAB part).
#include "hamilcar/io/crg_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/crg_parts.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"
#include "hamilcar/road/crg_road.hpp"

namespace hamilcar::io {

namespace crg {

namespace {

// Start and spacing of the reference line. The virtual channel repeats them, rounded; it counts where no key tells
// them.
void place_line(const Header& header, CrgDescription& road) {
    const auto coordinate = [&](const char* key) {
        return header.number(road_section, key, 0, -max_distance, max_distance);
    };
    double start = 0, step = 0.01;
    const auto has = [&](const char* key) { return header.has(road_section, key); };
    if (header.u_channel().value.starts_with("reference line u")) {
        std::array<std::string_view, 4> fields;
        std::string_view text = header.u_channel().value;
        for (std::string_view& field : fields) {
            field = text.substr(0, text.find(','));
            text.remove_prefix(std::min(text.size(), field.size() + 1));
        }
        start = number_in(fields[2]).value_or(0);
        step = number_in(fields[3]).value_or(step);
        const bool needed = !has("reference_line_start_u") || !has("reference_line_increment");
        if (needed && !(std::abs(start) <= max_distance && step >= min_step && step <= max_step))
            header.fail(header.u_channel().line, "u:reference line u", "m, a start and an increment");
    }
    road.u_start = header.number(road_section, "reference_line_start_u", start, -max_distance, max_distance);
    road.u_increment = header.number(road_section, "reference_line_increment", step, min_step, max_step);

    road.x = coordinate("reference_line_start_x");
    road.y = coordinate("reference_line_start_y");
    road.z = header.number(road_section, "reference_line_start_z", 0, -max_height, max_height);
    road.phi = header.number(road_section, "reference_line_start_phi", 0, -max_heading, max_heading);
    road.slope = header.number(road_section, "reference_line_start_s", 0, -max_slope, max_slope);
    road.banking = header.number(road_section, "reference_line_start_b", 0, -max_slope, max_slope);
    road.end_x = header.maybe(road_section, "reference_line_end_x", max_distance);
    road.end_y = header.maybe(road_section, "reference_line_end_y", max_distance);
    road.end_z = header.maybe(road_section, "reference_line_end_z", max_height);
    if (road.end_x.has_value() != road.end_y.has_value()) {
        const std::string key = road.end_x ? "reference_line_end_x" : "reference_line_end_y";
        road.remarks.push_back(header.remark(header.line_of(road_section, key), key, "is not used without its fellow"));
        road.end_x = road.end_y = std::nullopt;
    }
}

void read_options(const Header& header, const Header& modifiers, CrgDescription& road) {
    const std::string& of = options_section;
    road.border_u = static_cast<CrgBorder>(header.choice(of, "border_mode_u", 2, 4));
    road.border_v = static_cast<CrgBorder>(header.choice(of, "border_mode_v", 2, 4));
    road.border_offset_u = header.number(of, "border_offset_u", 0, -max_height, max_height);
    road.border_offset_v = header.number(of, "border_offset_v", 0, -max_height, max_height);
    road.smooth_start = header.number(of, "border_smooth_ubeg", 0, 0, max_distance);
    road.smooth_end = header.number(of, "border_smooth_uend", 0, 0, max_distance);

    // Without the section missing heights are those of their neighbors; with it, only what it says is done.
    const std::string& by = modifiers_section;
    const bool offset = modifiers.has(by, "grid_nan_offset");
    const int fallback = modifiers.has_section(by) && !offset ? 0 : 2;
    road.missing = static_cast<CrgMissing>(modifiers.choice(by, "grid_nan_mode", fallback, 2));
    road.missing_offset = modifiers.number(by, "grid_nan_offset", 0, -max_height, max_height);
    if (offset && road.missing == CrgMissing::none) road.missing_offset = 0;
}

// Whether the line ends where its steps lead, near enough; if not, it is told, and the steps give way to the end.
void check_ends(const Header& header, const Channels& channels, CrgDescription& road) {
    const auto segments = static_cast<double>(road.rows() - 1);
    // Spread over the line a miss within this bends no segment noticeably.
    const double limit = 0.1 * road.u_increment * std::sqrt(segments) + 1e-6 * segments * road.u_increment;
    double x = road.x, y = road.y, z = road.z;
    for (std::size_t i = 0; i + 1 < road.rows(); ++i) {
        const double phi = channels.phi ? road.headings[i] : road.phi;
        x += road.u_increment * std::cos(phi);
        y += road.u_increment * std::sin(phi);
        z += road.u_increment * (channels.slope ? road.slopes[i] : road.slope);
    }
    const auto tell = [&](const char* key, const std::string& text) {
        road.remarks.push_back(header.remark(header.line_of(road_section, key), key, text));
    };
    const bool sloped = channels.slope || road.slope != 0;
    if (road.end_x && std::hypot(*road.end_x - x, *road.end_y - y) > limit)
        tell("reference_line_end_x",
             fmt::format("is far from ({:g}, {:g}) m, where the headings lead: {}", x, y,
                         channels.phi ? "the line is drawn there" : "the line goes straight on"));
    if (road.end_z && std::abs(*road.end_z - z) > limit)
        tell("reference_line_end_z", fmt::format("is far from {:g} m, where the slopes lead: {}", z,
                                                 sloped ? "the line is drawn there" : "it is not used"));
    if (channels.phi) road.phi = road.headings.front();
    if (channels.slope) road.slope = road.slopes.front();
    if (channels.banking) road.banking = road.bankings.front();
    if (!channels.phi) road.end_x = road.end_y = std::nullopt;
    if (!sloped) road.end_z = std::nullopt;
}

// Headings turn little between rows (read_rows), but on the way to an end far from where they lead the line may turn more.
void check_line(const Header& header, const CrgDescription& road) {
    const std::size_t fold = first_fold(reference_line(road));
    if (fold == 0) return;
    header.fail(
        header.line_of(road_section, "reference_line_end_x"), "reference_line_end_x",
        fmt::format("an end to which the line does not turn by a right angle between rows, as it does at u = {:g} m",
                    road.u_start + static_cast<double>(fold - 1) * road.u_increment));
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
void close_line(const Header& header, const Header& options, CrgDescription& road) {
    const bool wanted = options.choice(options_section, "refline_continuation", 0, 1) == 1 ||
                        options.choice(options_section, "reference_line_continuation", 0, 1) == 1 ||
                        header.choice(road_section, "reference_line_continuation", 0, 1) == 1;
    if (wanted && ends_at_start(road)) road.border_u = CrgBorder::repeat;
}

// The file that $ROAD_CRG_FILE names: beside the file that names it, its $NAME replaced from the environment.
std::string referenced_path(const Header& header, const std::string& name) {
    std::string written = header.reference().value;
    if (const auto at = written.find('$'); at != std::string::npos) {
        const std::string variable = written.substr(at + 1, written.find('/', at) - at - 1);
        const char* value = std::getenv(variable.c_str());
        if (value == nullptr)
            header.fail(header.reference().line, "$road_crg_file", "the environment to have " + quoted_text(variable));
        written.replace(at, variable.size() + 1, value);
    }
    return (std::filesystem::path(name).parent_path() / written).string();
}

// A file that only refers to another one has options and modifiers of its own, or leaves them to the other.
CrgDescription parse(std::string_view bytes, const std::string& name, const Header* options, const Header* modifiers,
                     int depth) {
    constexpr int max_depth = 8;
    Text text(bytes);
    const Header header(text, name);
    if (options == nullptr && header.has_section(options_section)) options = &header;
    if (modifiers == nullptr && header.has_section(modifiers_section)) modifiers = &header;
    if (const Entry& reference = header.reference(); !reference.value.empty()) {
        if (depth >= max_depth) header.fail(reference.line, "$road_crg_file", "files that do not refer to each other");
        const std::string path = referenced_path(header, name);
        const std::string other = read_whole_file(path, FileLimit::road, name + ": $road_crg_file: ");
        CrgDescription road = parse(other, path, options, modifiers, depth + 1);
        road.remarks.insert(road.remarks.begin(), header.remarks().begin(), header.remarks().end());
        return road;
    }
    if (options == nullptr) options = &header;
    if (modifiers == nullptr) modifiers = &header;
    CrgDescription road;
    road.remarks = header.remarks();
    place_line(header, road);
    const Channels channels = find_channels(header, road);
    read_options(*options, *modifiers, road);
    read_rows(text, header, channels, road);
    check_ends(header, channels, road);
    check_line(header, road);
    modify(*modifiers, header, road);
    check_line(header, road);
    close_line(header, *options, road);
    return road;
}

}  // namespace

}  // namespace crg

CrgDescription parse_crg(std::string_view bytes, const std::string& name) {
    return crg::parse(bytes, name, nullptr, nullptr, 0);
}

CrgDescription read_crg(const std::string& path) {
    return parse_crg(read_whole_file(path, FileLimit::road), path);
}

}  // namespace hamilcar::io
