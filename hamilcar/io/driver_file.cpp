// One function per table, in the order of docs/driver.md.
#include "hamilcar/io/driver_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "hamilcar/base/text.hpp"
#include "hamilcar/description/powertrain.hpp"
#include "hamilcar/driver/path.hpp"
#include "hamilcar/io/column_file.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/road_file.hpp"

namespace hamilcar::io {

namespace {

constexpr Range whole_gear{.words = "whole number from -1 to 20", .min = -1, .max = max_gears, .is_whole = true};
constexpr Range whole_forward_gear{.words = "whole number from 1 to 20", .min = 1, .max = max_gears, .is_whole = true};
constexpr Range preview{"number from 0.2 to 5", 0.2, 5};           // below, arms and tires leave nothing to decide [s]
constexpr Range interval{"number from 0.001 to 0.1", 0.001, 0.1};  // [s]

// What a line says; headings have no number at all.
enum class Line { point, headings, neither };

Line read_line(std::string_view line, std::array<double, 2>& point) {
    const std::size_t comma = std::min(line.find(','), line.size());
    const auto x = number_in(line.substr(0, comma));
    const auto y = number_in(line.substr(std::min(comma + 1, line.size())));
    if (x && y) point = {*x, *y};
    return x && y ? Line::point : x || y ? Line::neither : Line::headings;
}

std::vector<std::array<double, 2>> read_points(const TableReader& table) {
    std::vector<std::array<double, 2>> points;
    table.choose({{"point"}, {"x_m", "y_m"}, {"file"}}, [&](std::size_t group) {
        if (group == 0) {
            for (const TableReader& point : table.tables("point")) points.push_back(point.array<2>("at_m"));
        } else if (group == 1) {
            const std::vector<double> x = table.numbers("x_m", any_number), y = table.numbers("y_m", any_number);
            table.expect(y.size() == x.size(), "y_m", std::to_string(x.size()) + " numbers, one for each of 'x_m'");
            for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i]});
        } else {
            const std::string path = table.path_to_file("file");
            if (!table.is_recording()) points = parse_path_points(read_named_file(table, "file"), path);
        }
    });
    return points;
}

PathFollowerDescription read_path(const TableReader& table) {
    PathFollowerDescription out;
    out.path.points = read_points(table);
    out.path.closed = table.boolean("closed", false);
    out.preview_time = table.number("preview_s", preview, out.preview_time);
    out.largest_angle = table.number("largest_angle_deg", not_negative, out.largest_angle);
    out.largest_rate = table.number("largest_rate_deg_per_s", positive, out.largest_rate);
    if (table.is_recording()) return out;
    try {
        const Path whole(out.path);
    } catch (const std::invalid_argument& mistake) {
        const std::string_view key = table.has("point") ? "point" : table.has("x_m") ? "x_m" : "file";
        table.expect(false, key, std::string("a path, but ") + mistake.what());
    }
    return out;
}

SpeedControlDescription read_speed(const TableReader& table) {
    SpeedControlDescription out;
    out.speed = read_signal(table, "speed_m_per_s", not_negative);
    out.may_brake = table.boolean("may_brake", out.may_brake);
    out.largest_acceleration = table.number("largest_acceleration_m_per_s2", positive, out.largest_acceleration);
    return out;
}

ShiftingDescription read_gear(const TableReader& table) {
    ShiftingDescription out;
    table.choose({{"choice"}, {"number"}}, [&](std::size_t group) {
        if (group == 1) {
            const double number = table.number("number", whole_gear);
            out.gear = table.is_recording() ? 1 : static_cast<int>(number);
        } else {
            table.one_of("choice", std::array<std::string_view, 1>{"automatic"}, 0);
            out.first_gear = static_cast<int>(table.number("first", whole_forward_gear, out.first_gear));
        }
    });
    return out;
}

EndingDescription read_ending(const TableReader& table, bool follows_path) {
    EndingDescription out;
    const auto limit = [&table](std::string_view key, std::optional<double>& to) {
        if (table.has(key)) to = table.number(key, positive);
    };
    limit("speed_below_m_per_s", out.speed_below);
    limit("speed_above_m_per_s", out.speed_above);
    limit("distance_m", out.distance);
    limit("station_m", out.station);
    limit("path_offset_m", out.path_offset);
    limit("lateral_acceleration_m_per_s2", out.lateral_acceleration);
    limit("roll_deg", out.roll);
    out.earliest = table.number("earliest_s", not_negative, out.earliest);
    for (const std::string_view key : {"station_m", "path_offset_m"}) {
        table.expect(follows_path || !table.has(key), key, "a [driver.path] beside it");
    }
    return out;
}

}  // namespace

std::vector<std::array<double, 2>> parse_path_points(std::string_view text, const std::string& path) {
    std::vector<std::array<double, 2>> points;
    bool headings = false;
    for (std::size_t begin = 0, number = 1; begin < text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        if (line.find_first_not_of(" \t\r") == std::string_view::npos || line.front() == '#') continue;
        std::array<double, 2> point{};
        const Line says = read_line(line, point);
        if (says == Line::point) {
            points.push_back(point);
        } else if (says == Line::headings && points.empty() && !headings) {
            headings = true;
        } else {
            throw Error(ExitCode::bad_file, path + ":" + std::to_string(number) + ": expected a point as x,y [m]");
        }
    }
    return points;
}

DriverDescription read_driver(const TableReader& table) {
    DriverDescription driver;
    driver.interval = table.number("interval_s", interval, driver.interval);
    if (const auto path = table.optional_table("path")) driver.steering = read_path(*path);
    if (const auto speed = table.optional_table("speed")) driver.speed = read_speed(*speed);
    if (const auto gear = table.optional_table("gear")) driver.shifting = read_gear(*gear);
    if (const auto ending = table.optional_table("ending")) {
        driver.ending = read_ending(*ending, driver.steering.has_value());
    }
    return driver;
}

}  // namespace hamilcar::io
