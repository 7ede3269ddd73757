// ISO 7975: from a steady circle the brake is applied, harder from run to run, while the steering wheel stays where it is. How
// much faster or slower than a vehicle that keeps to its circle the real one turns after a second tells whether it turns in,
// runs wide or spins. Settling is driven once; every run repeats what the driver's hands did.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/circle_braking.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar {

namespace {

using circle_braking::nowhere, circle_braking::Run, circle_braking::Steady;

constexpr double usual_radius = 100, usual_acceleration = 5;  // [m], [m/s^2]
constexpr int enough_locked = 2;                              // wheels, where the series ends
constexpr double tolerance = 0.03;  // of radius, lateral acceleration and steadiness before there is a note [1]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    constexpr double part = 0.43, step = 0.5;  // of what tips the vehicle over [1]; [m/s^2]
    const double bearable = rounded_down(part * tipping_acceleration(vehicle), step);
    return {{"radius", "m", "of the circle", usual_radius, 20, 500},
            {"lateral_acceleration", "m/s^2", "on the circle, before braking", std::min(usual_acceleration, bearable),
             0.5, 12},
            {"least_deceleration", "m/s^2", "asked for in the first run", 2, 0.5, 15},
            {"deceleration", "m/s^2", "asked for in the last run, if no wheel locks before", 8, 0.5, 20},
            {"step", "m/s^2", "between runs", 1, 0.25, 10},
            {"reference", "m/s^2", "deceleration that the figures are stated at", 4, 0.5, 15}};
}

struct Driven {
    Run run;
    History history;
};

// Between the two runs around a deceleration; NaN outside.
double at_deceleration(const std::vector<Driven>& all, double deceleration, double Run::*value) {
    for (std::size_t i = 1; i < all.size(); ++i) {
        const Run &low = all[i - 1].run, &high = all[i].run;
        if (!(low.deceleration <= deceleration && deceleration <= high.deceleration)) continue;
        if (high.deceleration == low.deceleration) return low.*value;
        const double share = (deceleration - low.deceleration) / (high.deceleration - low.deceleration);
        return low.*value + share * (high.*value - low.*value);
    }
    return nowhere;
}

// Of all runs the value farthest from what is neutral, either way and with its sign.
double farthest(const std::vector<Driven>& all, double Run::*value, double neutral = 0) {
    double out = nowhere;
    for (const Driven& one : all) {
        const double here = one.run.*value;
        if (std::isnan(out) || std::abs(here - neutral) > std::abs(out - neutral)) out = here;
    }
    return out;
}

void add_figures(const std::vector<Driven>& all, const Steady& steady, double reference, Outcome& outcome) {
    const auto add = [&](const std::string& name, const std::string& unit, double value, const std::string& meaning) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    const auto at = [&](double Run::*value) { return at_deceleration(all, reference, value); };
    if (std::isnan(at(&Run::deceleration)) && !all.empty()) {
        outcome.notes.push_back(
            fmt::format("no figures at {:g} m/s^2: the runs' mean decelerations go from {:.1f} to {:.1f} m/s^2",
                        reference, all.front().run.deceleration, farthest(all, &Run::deceleration)));
    }
    const std::string where = fmt::format("1 s after braking began, at a mean deceleration of {:g} m/s^2", reference);
    add("radius", "m", steady.radius, "of the steady circle");
    add("lateral acceleration", "m/s^2", steady.speed * steady.speed / steady.radius, "on the steady circle");
    add("speed", "km/h", steady.speed / kilometer_per_hour, "on the steady circle");
    add("steering wheel angle", "deg", steady.steering_wheel / degree, "held from the beginning of braking on");
    add("yaw rate ratio", "", at(&Run::yaw_rate_ratio),
        "yaw rate over that of a vehicle that stays on the circle, " + where);
    add("lateral acceleration ratio", "", at(&Run::acceleration_ratio), "likewise, " + where);
    add("path deviation", "m", at(&Run::deviation), "of the center of mass from the circle, inward positive, " + where);
    add("sideslip change", "deg", at(&Run::sideslip_change) / degree, "since the beginning of braking, " + where);
    add("extreme yaw rate ratio", "", farthest(all, &Run::yaw_rate_ratio, 1),
        "1 s after braking began, the one of all runs that is farthest from 1");
    add("largest path deviation", "m", farthest(all, &Run::deviation),
        "1 s after braking began, the largest of all runs either way, inward positive");
    add("largest sideslip change", "deg", farthest(all, &Run::largest_sideslip_change) / degree,
        "either way, of all runs");
    add("largest yaw acceleration", "deg/s^2", farthest(all, &Run::largest_yaw_acceleration) / degree,
        "either way, of all runs");
    add("largest deceleration", "m/s^2", farthest(all, &Run::deceleration), "mean over 1 s, of all runs");
    const auto locking = std::ranges::find_if(all, [](const Driven& one) { return one.run.locked > 0; });
    add("deceleration with locked wheels", "m/s^2", locking == all.end() ? nowhere : locking->run.deceleration,
        "of the first run in which a wheel locked within 1 s");
}

io::Chart over_deceleration(const std::vector<Driven>& all, const std::string& title, const std::string& label,
                            double Run::*value, double unit = 1) {
    io::Curve curve{.label = title, .points = true};
    for (const Driven& one : all) {
        curve.x.push_back(one.run.deceleration), curve.y.push_back(one.run.*value / unit);
    }
    return {.title = title, .x_label = "mean deceleration [m/s^2]", .y_label = label, .curves = {curve}};
}

// After the beginning of braking only.
io::Curve braking_part(const History& h, const std::string& label, const std::vector<double>& x,
                       const std::vector<double>& y) {
    const auto from = static_cast<long>(row_at(h, circle_braking::settling));
    return {.label = label, .x = {x.begin() + from, x.end()}, .y = {y.begin() + from, y.end()}};
}

void add_charts(const std::vector<Driven>& all, double radius, Outcome& outcome) {
    const auto ratio = [&](const std::string& title, double Run::*value) {
        outcome.charts.push_back(over_deceleration(all, title, "over that on the circle [1]", value));
        outcome.charts.back().horizontal_marks = {{1, "stays on the circle"}};
    };
    ratio("Yaw rate ratio after 1 s", &Run::yaw_rate_ratio);
    ratio("Lateral acceleration ratio after 1 s", &Run::acceleration_ratio);
    outcome.charts.push_back(over_deceleration(all, "Path deviation after 1 s", "inward [m]", &Run::deviation));
    outcome.charts.push_back(
        over_deceleration(all, "Largest change of the sideslip angle", "[deg]", &Run::largest_sideslip_change, degree));
    io::Chart yaw{.title = "Yaw rate while braking", .x_label = "time [s]", .y_label = "yaw rate [deg/s]"};
    io::Chart path{.title = "Path while braking", .x_label = "x [m]", .y_label = "y [m]", .equal_axes = true};
    for (const Driven& one : all) {
        const History& h = one.history;
        const std::string label = fmt::format("{:.1f} m/s^2", one.run.deceleration);
        yaw.curves.push_back(braking_part(h, label, h.time, straight::scaled(h.yaw_rate, 1 / degree)));
        path.curves.push_back(braking_part(h, label, h.x, h.y));
    }
    if (!all.empty()) {
        const History& h = all.back().history;
        const auto reference = straight::scaled(circle_braking::reference_yaw_rate(h), 1 / degree);
        yaw.curves.push_back(braking_part(h, "on the circle, last run", h.time, reference));
    }
    io::Curve line{.label = "circle"};
    for (const auto& [x, y] : circle_braking::circle(radius)) line.x.push_back(x), line.y.push_back(y);
    line.x.push_back(line.x.front()), line.y.push_back(line.y.front());
    path.curves.push_back(std::move(line));
    outcome.charts.push_back(std::move(yaw));
    outcome.charts.push_back(std::move(path));
}

// Whether braking can begin from there.
bool settles(const Trial& trial, const Settings& settings, Outcome& outcome) {
    if (trial.breaks_off()) return false;
    if (trial.stopped != Stopped::no || trial.history.time.back() < circle_braking::settling - 0.01) {
        outcome.failed =
            "the steady circle was not reached: " + (trial.trouble.empty() ? "the run ended early" : trial.trouble);
        return false;
    }
    const Steady steady = circle_braking::steady(trial.history);
    const double radius = settings.at("radius"), wanted = settings.at("lateral_acceleration");
    const double reached = steady.speed * steady.speed / steady.radius;
    const auto off = [](double found, double asked) { return std::abs(found - asked) > tolerance * asked; };
    if (off(steady.radius, radius) || off(reached, wanted) || steady.unrest > tolerance) {
        outcome.notes.push_back(
            fmt::format("before braking the vehicle drove a radius of {:.1f} m at {:.2f} m/s^2, with a yaw rate "
                        "that varied by {:.1f} %; wanted: {:g} m at {:g} m/s^2",
                        steady.radius, reached, 100 * steady.unrest, radius, wanted));
    }
    return true;
}

// Pedal commands of the runs.
std::vector<double> pedals(const VehicleDescription& vehicle, const Settings& settings, Outcome& outcome) {
    const double full = straight::full_brake_force(vehicle) / straight::total_mass(vehicle);
    const double last = settings.at("deceleration"), step = settings.at("step");
    std::vector<double> out;
    for (double asked = settings.at("least_deceleration"); asked <= last + 1e-9; asked += step) {
        if (asked > full) {
            outcome.notes.push_back(
                fmt::format("its brakes are for {:.1f} m/s^2 at most, and the series ends there", full));
            break;
        }
        out.push_back(asked / full);
    }
    return out;
}

Outcome drive_all(const VehicleDescription& vehicle, const Settings& settings, const ManeuverOptions& options) {
    if (settings.at("least_deceleration") > settings.at("deceleration")) {
        throw io::Error(
            io::ExitCode::bad_file,
            fmt::format("setting 'least_deceleration' of maneuver 'braking_in_turn' = {:g}: expected at most "
                        "'deceleration', {:g} [m/s^2]",
                        settings.at("least_deceleration"), settings.at("deceleration")),
            "maneuver.settings.least_deceleration");
    }
    Outcome outcome;
    const double radius = settings.at("radius"), speed = std::sqrt(radius * settings.at("lateral_acceleration"));
    outcome.course.line = circle_braking::circle(radius);
    const auto wanted = pedals(vehicle, settings, outcome);
    const double count = static_cast<double>(wanted.size()) + 1;
    const ScenarioDescription steady = circle_braking::on_circle(vehicle, options, radius, speed);
    Trial settling = drive(vehicle, steady, {.keep_going = share(options, 0, 1 / count)});
    const History settled = settling.history;
    const bool ready = settles(settling, settings, outcome);
    add_trial(outcome, std::move(settling));
    if (!ready) return outcome;
    std::vector<Driven> all;
    for (const double pedal : wanted) {
        const double n = static_cast<double>(all.size()) + 1;
        ScenarioDescription scenario = circle_braking::braking(steady, settled, speed, pedal);
        scenario.name = fmt::format("braking in a turn, pedal at {:.0f} %", 100 * pedal);
        Trial trial = drive(vehicle, scenario,
                            {.film = options.keep_runs, .keep_going = share(options, n / count, (n + 1) / count)});
        if (trial.breaks_off()) {
            add_trial(outcome, std::move(trial));
            return outcome;
        }
        all.push_back({circle_braking::evaluated(trial.history), trial.history});
        all.back().run.pedal = pedal;
        trial.complaints.clear();  // that a braking car does not hold its speed
        add_trial(outcome, std::move(trial));
        if (all.back().run.locked < enough_locked) continue;
        outcome.notes.push_back(fmt::format("{} wheels locked at {:.1f} m/s^2, and the series ends there",
                                            all.back().run.locked, all.back().run.deceleration));
        break;
    }
    add_figures(all, circle_braking::steady(settled), settings.at("reference"), outcome);
    add_charts(all, radius, outcome);
    return outcome;
}

std::string obstacle(const VehicleDescription& vehicle) {
    const std::string drive = needs_steering_and_drive(vehicle);
    if (!drive.empty()) return drive;
    return straight::full_brake_force(vehicle) > 0 ? "" : "it has no brakes";
}

}  // namespace

Maneuver braking_in_turn() {
    return {.name = "braking_in_turn",
            .title = "Braking in a turn",
            .standard = "ISO 7975",
            .summary =
                "From a steady circle the brake is applied with the steering held: whether the vehicle keeps to its "
                "circle.",
            .settings = settings,
            .obstacle = obstacle,
            .drive = drive_all,
            .course = [](const VehicleDescription&, const Settings& settings) {
                Course course;
                course.line = circle_braking::circle(settings.at("radius"));
                return course;
            }};
}

}  // namespace hamilcar
