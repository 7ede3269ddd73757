// What any bytes at all must come through: a file is either refused by a message that a person can read, or accepted,
// and then what it describes can be computed with. Anything else leaves as an exception, or is found by the sanitizers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "hamilcar/io/column_file.hpp"
#include "hamilcar/io/crg_file.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/grid_file.hpp"
#include "hamilcar/io/property_file.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/road/crg_road.hpp"
#include "hamilcar/road/height_grid.hpp"
#include "hamilcar/tire/list.hpp"

namespace hamilcar::fuzz {

inline void demand(bool good, const std::string& what) {
    if (!good) throw std::logic_error(what);
}

// Reads a file and goes on with it; a mistake in it is well if it is told as such, and so is another file that it names and that
// cannot be read, whose name is told as it is.
template <class Read, class Use>
void read_and_use(Read&& read, Use&& use) {
    try {
        use(read());
    } catch (const io::Error& error) {
        const std::string_view message = error.what();
        if (error.code() == io::ExitCode::input_output) return;
        demand(error.code() == io::ExitCode::bad_file, "a mistake that is none of the file's");
        demand(message.starts_with("file:") && message.find('\n') == message.npos,  // cli/main.cpp sees to other bytes
               "a message that is not one line about the file");
    }
}

// A column of numbers over one that increases, both within their limits.
inline void run_columns(std::string_view bytes) {
    const io::ColumnRequest request{"time", "steer", "time_s", "angle_deg", {"number from -90 to 90", -90, 90}};
    const auto use = [](const io::Samples& samples) {
        demand(!samples.argument.empty() && samples.argument.size() == samples.value.size(), "columns of two lengths");
        for (std::size_t i = 0; i < samples.argument.size(); ++i) {
            demand(std::isfinite(samples.argument[i]) && std::abs(samples.value[i]) < 1.58,
                   "a number beyond its limits");
            demand(i == 0 || samples.argument[i] > samples.argument[i - 1], "an argument that does not increase");
        }
    };
    read_and_use([&] { return io::parse_columns(bytes, "file", request); }, use);
}

inline void run_crg(std::string_view bytes) {
    const auto use = [](const CrgDescription& description) {
        const CrgRoad road(description);
        for (const double u : {-3.0, 0.0, 0.3, 2.5, 1e3}) {
            for (const double v : {-20.0, -0.4, 0.0, 1.0}) {
                const CrgPoint point = road.xy_of(description.u_start + u, v);
                demand(std::isfinite(road.height(point.x, point.y)), "a road without a height");
                road.covers(point.x, point.y);
            }
        }
    };
    read_and_use([&] { return io::parse_crg(bytes, "file"); }, use);
}

inline void run_grid(std::string_view bytes) {
    const auto use = [](const HeightGridDescription& d) {
        const HeightGrid grid(d);
        for (const double x : {-1.0, 0.0, 0.7, 1.5, 1e6})
            for (const double y : {-1e6, 0.0, 0.4, 2.1})
                demand(std::isfinite(grid.height(d.x + x * d.spacing_x, d.y + y * d.spacing_y)),
                       "a grid without a height");
    };
    read_and_use([&] { return io::parse_grid(bytes, "file"); }, use);
}

// Presses the tire by its nominal load and otherwise, standing, rolling, braking and cornering.
inline void run_tire(const MagicFormulaDescription& description) {
    const Tire<double> tire = make_tire<double>(description);
    const double nominal = description.nominal_load / description.casing.vertical_stiffness;
    for (const double depth : {-0.01, 0.3 * nominal, nominal, 2 * nominal})
        for (const auto& [v_x, v_sx, v_sy] : {std::array{0.0, 0.0, 0.0}, std::array{20.0, 0.0, 0.0},
                                              std::array{20.0, -3.0, 2.0}, std::array{-5.0, 5.0, -0.5}})
            for (const double camber : {0.0, 0.05}) {
                const TireContact<double> contact{.depth = depth,
                                                  .depth_rate = 0.01,
                                                  .v_sx = v_sx,
                                                  .v_sy = v_sy,
                                                  .v_x = v_x,
                                                  .camber = camber,
                                                  .omega = 3 * v_x,
                                                  .friction = 0.9,
                                                  .u = -0.01 * v_sx,
                                                  .v = -0.01 * v_sy};
                const auto f = std::visit([&](const auto& model) { return model.force(contact); }, tire);
                const std::array all{f.Fx, f.Fy, f.Fz, f.elastic, f.rolling_moment, f.Mx, f.Mz, f.u_rate, f.v_rate};
                demand(std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); }),
                       "a tire whose forces are no numbers");
            }
}

inline void run_tir(std::string_view bytes) {
    read_and_use([&] { return io::tir_from(io::parse_property_file(bytes, "file")); },
                 [](const io::TirFile& file) { run_tire(file.tire); });
}

}  // namespace hamilcar::fuzz
