#include "hamilcar/io/crg_modifiers.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hamilcar::io::crg {

namespace {

void scale(std::vector<double>& numbers, double factor) {
    for (double& number : numbers) number *= factor;
}

void rotate_and_shift(const Header& header, CrgDescription& road) {
    const std::string& by = modifiers_section;
    const auto length = [&](const char* key, double fallback) {
        return header.number(by, key, fallback, -farthest, farthest);
    };
    const double turn = header.number(by, "refline_offset_phi", 0, -most_turned, most_turned);
    const double s = std::sin(turn), c = std::cos(turn);
    const double center_x = length("refline_rotcenter_x", road.x), center_y = length("refline_rotcenter_y", road.y);
    const double shift_x = length("refline_offset_x", 0), shift_y = length("refline_offset_y", 0);
    const auto move = [&](double& x, double& y) {
        const double dx = x - center_x, dy = y - center_y;
        x = center_x + (dx * c - dy * s) + shift_x;
        y = center_y + (dx * s + dy * c) + shift_y;
    };
    move(road.x, road.y);
    if (road.end_x) move(*road.end_x, *road.end_y);
    road.phi += turn;
    for (double& phi : road.headings) phi += turn;
    const double up = header.number(by, "refline_offset_z", 0, -highest, highest);
    road.z += up;
    if (road.end_z) *road.end_z += up;
}

}  // namespace

void modify(const Header& header, CrgDescription& road) {
    const auto factor = [&](const char* key, double low, double high) {
        return header.number(modifiers_section, key, 1, low, high);
    };
    constexpr double most = 1e3;
    scale(road.heights, factor("scale_z_grid", -most, most));
    const double slope = factor("scale_slope", -most, most), banking = factor("scale_banking", -most, most);
    scale(road.slopes, slope);
    scale(road.bankings, banking);
    road.slope *= slope;
    road.banking *= banking;
    if (road.end_z) road.end_z = road.z + slope * (*road.end_z - road.z);

    const double length = factor("scale_length", 1 / most, most);
    road.u_increment *= length;
    if (!(road.u_increment >= least_step))
        header.fail(header.line_of(modifiers_section, "scale_length"), "scale_length",
                    fmt::format("a factor that leaves steps of {:g} m at least", least_step));
    if (road.end_x) road.end_x = road.x + length * (*road.end_x - road.x);
    if (road.end_y) road.end_y = road.y + length * (*road.end_y - road.y);
    if (road.end_z) road.end_z = road.z + length * (*road.end_z - road.z);
    scale(road.v, factor("scale_width", 1 / most, most));

    if (header.has(modifiers_section, "scale_curvature") && !road.headings.empty()) {
        const double curvature = factor("scale_curvature", -most, most);
        double before = road.headings.front(), heading = before;
        for (double& phi : road.headings) {
            const double turn = std::remainder(phi - before, 2 * std::acos(-1.0));  // written within half a turn
            if (!(std::abs(curvature * turn) <= sharpest_turn))
                header.fail(header.line_of(modifiers_section, "scale_curvature"), "scale_curvature",
                            fmt::format("a factor with which no turn is beyond {:g} rad", sharpest_turn));
            before = phi;
            phi = heading += curvature * turn;
        }
        road.end_x = road.end_y = std::nullopt;
    }
    rotate_and_shift(header, road);
}

}  // namespace hamilcar::io::crg
