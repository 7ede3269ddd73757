#include "hamilcar/maneuver/lane_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "hamilcar/maneuver/course_driver.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar {

namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
constexpr double finest = 1;                   // of the speed that is sought [km/h]
constexpr double widening = 1.15;              // between two speeds while none has failed, or none has passed
constexpr double slowest = 15, fastest = 200;  // that are tried [km/h]
constexpr int most_speeds = 14;                // of a search, the first one among them
constexpr double entry_tolerance = 3;          // of the speed at the first cones, for a run to be one of it [km/h]

// Interpolated to where the box's front or rear passes a place, by its center's x; NaN where it never came there.
double speed_at(const History& history, double x) {
    for (std::size_t i = 1; i < history.size(); ++i) {
        if (history.x[i] < x || history.x[i - 1] >= x) continue;
        const double share = (x - history.x[i - 1]) / (history.x[i] - history.x[i - 1]);
        return history.speed[i - 1] + share * (history.speed[i] - history.speed[i - 1]);
    }
    return nowhere;
}

// What it entered the course at, the box's front at the first cones; NaN where it never came there [km/h].
double entry_speed(const VehicleDescription& vehicle, const LaneChange& change, const History& history) {
    return speed_at(history, change.lanes.front().begin - footprint(vehicle).front) / kilometer_per_hour;
}

// Between the highest speed that went well, or at which the vehicle came to a stand, and the lowest one above it at which it
// failed, or could not enter at that speed.
struct Bracket {
    double low = nowhere, failed = nowhere;  // as wanted [km/h]
    double low_entry = nowhere;              // as measured
    bool low_is_clean = false;
    double too_fast = nowhere, too_fast_entry = nowhere;  // lowest that it could not enter at, and what it had then

    void add(const CourseDrive& drive, double entry) {
        const bool clean = drive.passage.clean();
        if (std::abs(entry - drive.speed) > entry_tolerance) {
            failed = too_fast = drive.speed, too_fast_entry = entry;
        } else if (clean || drive.passage.too_slow()) {
            low = drive.speed, low_entry = entry, low_is_clean = clean;
        } else {
            failed = drive.speed;
        }
    }
    bool closed() const { return failed - low <= finest; }
    double clean() const { return low_is_clean ? low_entry : nowhere; }
    // Whole kilometers per hour between the two, else farther out.
    double next() const {
        if (std::isnan(failed)) return std::floor(low * widening + finest);
        if (std::isnan(low)) return std::floor(failed / widening);
        return std::floor(0.5 * (low + failed) + 0.5 * finest);
    }
};

double largest(const std::vector<double>& values) {
    double out = 0;
    for (const double value : values) out = std::max(out, std::abs(value));
    return out;
}

double largest_rate(const std::vector<double>& values, const std::vector<double>& time) {
    double out = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        out = std::max(out, std::abs(values[i] - values[i - 1]) / (time[i] - time[i - 1]));
    }
    return out;
}

void add_figures(const VehicleDescription& vehicle, const LaneChange& change, const CourseDrive& drive,
                 Outcome& outcome) {
    const History& h = drive.trial.history;
    const Footprint box = footprint(vehicle);
    double sideslip = 0;
    for (std::size_t i = 0; i < h.size(); ++i) sideslip = std::max(sideslip, std::abs(h.sideslip(i)));
    const auto add = [&](const std::string& name, const std::string& unit, double value, const std::string& meaning) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    const double exit = change.lanes.back().end - box.rear;
    add("entry speed", "km/h", entry_speed(vehicle, change, h), "as the front comes to the first cones");
    add("exit speed", "km/h", speed_at(h, exit) / kilometer_per_hour, "as the rear leaves the last cones");
    add("least clearance", "m", drive.passage.clearance,
        "between the vehicle's box, or a trailer's tires, and the rows of cones; negative: across");
    add("place of the least clearance", "m", drive.passage.place, "of the center of mass behind the first cones");
    add("cones hit", "", static_cast<double>(drive.passage.cones),
        "that the vehicle's box or a trailer's tires ran over");
    add("largest steering wheel angle", "deg", largest(h.steering_wheel) / degree, "either way");
    add("largest steering wheel rate", "deg/s", largest_rate(h.steering_wheel, h.time) / degree, "either way");
    add("largest lateral acceleration", "m/s^2", largest(h.lateral_acceleration), "of the motor vehicle, either way");
    add("largest yaw rate", "deg/s", largest(h.yaw_rate) / degree, "either way");
    add("largest sideslip angle", "deg", sideslip / degree, "of the center of mass, either way");
    add("largest roll angle", "deg", largest(h.roll) / degree, "either way");
}

io::Chart path_chart(const LaneChange& change, const Course& course, const CourseDrive& drive) {
    io::Chart chart{.title = change.title + ": path", .x_label = "x [m]", .y_label = "y [m]", .equal_axes = true};
    io::Curve line{.label = "line to follow"};
    const double margin = 20;  // beyond the cones [m]
    for (const auto& [x, y] : course.line) {
        if (x < change.lanes.front().begin - margin || x > change.lanes.back().end + margin) continue;
        line.x.push_back(x), line.y.push_back(y);
    }
    chart.curves = {line, {.label = "center of mass", .x = drive.trial.history.x, .y = drive.trial.history.y}};
    io::Marks cones{.label = "cones"};
    for (const auto& [x, y] : course.cones) cones.x.push_back(x), cones.y.push_back(y);
    chart.marks = {cones};
    for (const Gate& gate : course.boundaries) {
        chart.lines.push_back({gate.from[0], gate.from[1], gate.to[0], gate.to[1]});
    }
    return chart;
}

void add_charts(const LaneChange& change, const Course& course, const CourseDrive& drive, Outcome& outcome) {
    const History& h = drive.trial.history;
    const auto scaled = [](std::vector<double> values, double unit) {
        for (double& value : values) value /= unit;
        return values;
    };
    outcome.charts.push_back(path_chart(change, course, drive));
    const auto over_x = [&](const std::string& title, const std::string& label, std::vector<io::Curve> curves) {
        outcome.charts.push_back({.title = title, .x_label = "x [m]", .y_label = label, .curves = std::move(curves)});
    };
    over_x("Steering wheel", "angle [deg]",
           {{.label = "steering wheel", .x = h.x, .y = scaled(h.steering_wheel, degree)}});
    over_x("Lateral acceleration", "lateral acceleration [m/s^2]",
           {{.label = "lateral acceleration", .x = h.x, .y = h.lateral_acceleration}});
    std::vector<double> sideslip;
    for (std::size_t i = 0; i < h.size(); ++i) sideslip.push_back(h.sideslip(i) / degree);
    over_x("Yaw rate, sideslip and roll", "[deg/s], [deg]",
           {{.label = "yaw rate [deg/s]", .x = h.x, .y = scaled(h.yaw_rate, degree)},
            {.label = "sideslip angle [deg]", .x = h.x, .y = sideslip},
            {.label = "roll angle [deg]", .x = h.x, .y = scaled(h.roll, degree)}});
}

// The highest clean speed by steps outward and then bisection; the run at it is kept.
void search(CourseDriver& driver, const CourseDrive& first, const std::function<double(const CourseDrive&)>& entry,
            bool film, Outcome& outcome) {
    Bracket bracket;
    bracket.add(first, entry(first));
    while (!bracket.closed() && driver.may_go_on()) {
        const double speed = bracket.next();
        if (speed < slowest || speed > fastest) break;
        CourseDrive drive = driver.drive(speed, film, outcome);
        if (!add_search_trial(outcome, drive.trial)) return;
        bracket.add(drive, entry(drive));
        if (bracket.low != speed || !bracket.low_is_clean || drive.trial.film.columns.empty()) continue;
        outcome.runs.clear();
        outcome.runs.push_back(std::move(drive.trial.film));
    }
    outcome.figures.push_back(
        {"highest clean entry speed", "km/h", "that was found without a cone hit, as measured", bracket.clean()});
    if (!bracket.low_is_clean) {
        outcome.notes.push_back(fmt::format(
            "no speed was found at which the course is driven without a cone hit{}{}",
            std::isnan(bracket.failed) ? "" : fmt::format(", down to {:g} km/h", bracket.failed),
            std::isnan(bracket.low) ? "" : fmt::format("; at {:g} km/h it came to a stand on the way", bracket.low)));
    } else if (std::isnan(bracket.failed)) {
        outcome.notes.push_back(fmt::format("no cone fell up to {:g} km/h, where the search ended", bracket.low));
    } else if (bracket.failed == bracket.too_fast) {
        outcome.notes.push_back(fmt::format(
            "no cone fell up to {:g} km/h; at {:g} km/h, where the search ended, the course was entered at {:.1f} km/h",
            bracket.low, bracket.too_fast, bracket.too_fast_entry));
    }
}

// Of the drive at the speed that was asked for. A course entered at another speed is no run of this one, however clean.
void add_verdicts(const CourseDrive& drive, double entry, Outcome& outcome) {
    const Passage& p = drive.passage;
    const bool entered = std::abs(entry - drive.speed) <= entry_tolerance;
    const std::string spoken =
        std::isnan(entry) ? "it did not come to the first cones" : fmt::format("{:.1f} km/h", entry);
    outcome.verdicts.push_back(
        {fmt::format("entered within {:g} km/h of {:g} km/h", entry_tolerance, drive.speed), entered, spoken});
    const std::string room = p.clearance < 0 ? fmt::format("a row of cones crossed by {:.2f} m", -p.clearance)
                                             : fmt::format("{:.2f} m of clearance", p.clearance);
    outcome.verdicts.push_back({"no cone is hit and no border crossed", p.clean(),
                                p.too_slow()  ? "it came to a stand on the course"
                                : !p.complete ? "the course was not driven to its end"
                                              : fmt::format("{} cones, {}", p.cones, room)});
    if (!entered && !std::isnan(entry)) {
        outcome.notes.push_back(
            fmt::format("the course was entered at {:.1f} km/h, not at {:g} km/h: this is no run of that speed", entry,
                        drive.speed));
    }
    if (!p.complete) {
        outcome.notes.push_back(fmt::format("the drive at {:g} km/h ended {:.1f} m behind the first cones{}",
                                            drive.speed, drive.trial.history.x.back(),
                                            drive.trial.ended ? ": " + *drive.trial.ended : ""));
    }
}

Outcome drive_lane_change(const VehicleDescription& vehicle, const LaneChange& change, const Settings& settings,
                          const ManeuverOptions& options) {
    Outcome outcome;
    CourseDriver driver(vehicle, change, settings, options, settings.at("search") == 1 ? most_speeds : 1);
    outcome.course = driver.course();
    if (straight::is_heavy(vehicle)) {
        outcome.notes.push_back("the course is made for cars and light trucks of up to 3.5 t; this vehicle is heavier");
    }
    CourseDrive first = driver.drive(settings.at("speed"), options.keep_runs, outcome);
    if (first.trial.breaks_off()) {
        add_trial(outcome, std::move(first.trial));
        return outcome;
    }
    add_figures(vehicle, change, first, outcome);
    add_charts(change, outcome.course, first, outcome);
    const auto entry = [&](const CourseDrive& drive) { return entry_speed(vehicle, change, drive.trial.history); };
    add_verdicts(first, entry(first), outcome);
    if (settings.at("search") == 1) search(driver, first, entry, options.keep_runs, outcome);
    add_trial(outcome, std::move(first.trial));
    return outcome;
}

}  // namespace

std::vector<Setting> lane_change_settings(double usual_speed, bool usual_search) {
    return {{"speed", "km/h", "at which the course is entered", usual_speed, slowest, fastest},
            {"search", "", "1: also seek the highest entry speed without a cone hit", usual_search ? 1.0 : 0.0, 0, 1,
             SettingKind::toggle},
            {"attempts", "", "at each speed, each with what the driver learned from the one before", 6, 1, 20,
             SettingKind::whole},
            {"preview_time", "s", "how far ahead the driver looks", 0.4, 0.2, 2}};
}

double usual_entry_speed(const VehicleDescription& vehicle, double standard, double acceleration) {
    constexpr double part = 0.6, step = 5;  // of the acceleration that tips it over [1]; [km/h]
    const double bearable = part * tipping_acceleration(vehicle);
    return std::max(rounded_down(standard * std::min(1.0, std::sqrt(bearable / acceleration)), step), slowest);
}

Maneuver through_lanes(LaneChange (*lanes)(const VehicleDescription&), Maneuver named) {
    named.obstacle = needs_steering_and_drive;
    named.drive = [lanes](const VehicleDescription& vehicle, const Settings& settings, const ManeuverOptions& options) {
        return drive_lane_change(vehicle, lanes(vehicle), settings, options);
    };
    named.course = [lanes](const VehicleDescription& vehicle, const Settings&) {
        return lane_course(lanes(vehicle).lanes, footprint(vehicle));
    };
    return named;
}

}  // namespace hamilcar
