#include "hamilcar/io/crg_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hamilcar/road/crg_road.hpp"

namespace hamilcar::io::crg {

namespace {

void scale(std::vector<double>& numbers, double factor) {
    for (double& number : numbers) number *= factor;
}

// Turns the road about a point, then shifts it [rad], [m].
struct Move {
    double center_x, center_y, turn, x, y, z;

    void apply(CrgDescription& road) const {
        const double s = std::sin(turn), c = std::cos(turn);
        const auto move = [&](double& px, double& py) {
            const double dx = px - center_x, dy = py - center_y;
            px = center_x + (dx * c - dy * s) + x;
            py = center_y + (dx * s + dy * c) + y;
        };
        move(road.x, road.y);
        if (road.end_x) move(*road.end_x, *road.end_y);
        road.phi += turn;
        for (double& phi : road.headings) phi += turn;
        road.z += z;
        if (road.end_z) *road.end_z += z;
    }
};

class Mover {
public:
    Mover(const Header& header, const Header& data, CrgDescription& road) : header_(header), data_(data), road_(road) {}

    // A reference point, wherever one of its keys is, puts the offsets of the line out of force.
    Move move() const {
        for (const char* key : {"refpoint_u", "refpoint_u_fraction", "refpoint_v", "refpoint_v_fraction", "refpoint_x",
                                "refpoint_y", "refpoint_z", "refpoint_phi"}) {
            if (header_.has(modifiers_section, key)) return by_reference_point();
        }
        return {length("refline_rotcenter_x", road_.x),
                length("refline_rotcenter_y", road_.y),
                header_.number(modifiers_section, "refline_offset_phi", 0, -max_heading, max_heading),
                length("refline_offset_x", 0),
                length("refline_offset_y", 0),
                height("refline_offset_z")};
    }

private:
    double length(const char* key, double fallback) const {
        return header_.number(modifiers_section, key, fallback, -max_distance, max_distance);
    }
    double height(const char* key) const { return header_.number(modifiers_section, key, 0, -max_height, max_height); }
    // A fraction of the grid and an offset go before a place.
    double place(const std::string& axis, double start, double low, double high) const {
        const std::string key = "refpoint_" + axis;
        if (!header_.has(modifiers_section, key + "_fraction")) return length(key.c_str(), start);
        const double part = header_.number(modifiers_section, key + "_fraction", 0, -max_fraction, max_fraction);
        return low + part * (high - low) + length((key + "_offset").c_str(), 0);
    }
    Move by_reference_point() const {
        const double u = place("u", road_.u_start, road_.u_start, road_.u_end());
        const double v = place("v", 0, road_.v.front(), road_.v.back());
        try {
            const CrgRoad road(road_);
            const CrgPoint from = road.xy_of(u, v);
            const double phi = header_.number(modifiers_section, "refpoint_phi", 0, -max_heading, max_heading);
            return {from.x,
                    from.y,
                    phi - heading_at(u),
                    length("refpoint_x", 0) - from.x,
                    length("refpoint_y", 0) - from.y,
                    height("refpoint_z") - road.height_uv(u, v)};
        } catch (const std::invalid_argument& problem) {
            header_.fail(header_.line_of(modifiers_section, "refpoint_x"), "refpoint_x", problem.what());
        }
    }
    // That of the segment; near the ends of the line that of the header, as OpenCRG's library has it.
    double heading_at(double u) const {
        if (road_.headings.empty()) return road_.phi;
        constexpr double near = 0.5;  // [m]
        const double rows = (u - road_.u_start) / road_.u_increment;
        const double margin = std::max(1.0, std::floor(near / road_.u_increment));
        const double row = std::clamp(std::floor(rows), 0.0, static_cast<double>(road_.rows() - 2));
        const auto of_header = [&](const char* key, double fallback) {
            return data_.number(road_section, key, fallback, -max_heading, max_heading);
        };
        if (margin > row) return of_header("reference_line_start_phi", road_.headings.front());
        if (row + margin >= static_cast<double>(road_.rows()))
            return header_.has(modifiers_section, "scale_curvature")
                       ? road_.headings.back()
                       : of_header("reference_line_end_phi", road_.headings.back());
        return road_.headings[static_cast<std::size_t>(row)];
    }

    static constexpr double max_fraction = 1e3;
    const Header &header_, &data_;
    const CrgDescription& road_;
};

void scale_curvature(const Header& header, const Header& data, double factor, CrgDescription& road) {
    double before = data.number(road_section, "reference_line_start_phi", 0, -max_heading, max_heading);
    double heading = before;
    bool first = true;  // whose change counts from the header's heading, however much that is
    for (double& phi : road.headings) {
        const double turn = first ? phi - before : std::remainder(phi - before, 2 * std::acos(-1.0));
        if (!first && !(std::abs(factor * turn) <= max_turn))
            header.fail(header.line_of(modifiers_section, "scale_curvature"), "scale_curvature",
                        fmt::format("a factor with which no turn is beyond {:g} rad", max_turn));
        first = false;
        before = phi;
        phi = heading += factor * turn;
    }
}

}  // namespace

void modify(const Header& header, const Header& data, CrgDescription& road) {
    const auto has = [&](const char* key) { return header.has(modifiers_section, key); };
    const auto factor = [&](const char* key, double low, double high) {
        return header.number(modifiers_section, key, 1, low, high);
    };
    constexpr double max = 1e3;
    scale(road.heights, factor("scale_z_grid", -max, max));
    const double slope = factor("scale_slope", -max, max), banking = factor("scale_banking", -max, max);
    scale(road.slopes, slope);
    scale(road.bankings, banking);
    road.slope *= slope;
    road.banking *= banking;

    const double length = factor("scale_length", 1 / max, max);
    road.u_increment *= length;
    if (!(road.u_increment >= min_step))
        header.fail(header.line_of(modifiers_section, "scale_length"), "scale_length",
                    fmt::format("a factor that leaves steps of {:g} m at least", min_step));
    // The header's end is that of the line as it was, even where a factor is one.
    if (has("scale_slope") || has("scale_length")) road.end_z = std::nullopt;
    if (has("scale_curvature") || has("scale_length")) road.end_x = road.end_y = std::nullopt;
    scale(road.v, factor("scale_width", 1 / max, max));

    if (has("scale_curvature")) scale_curvature(header, data, factor("scale_curvature", -max, max), road);
    Mover(header, data, road).move().apply(road);
}

}  // namespace hamilcar::io::crg
