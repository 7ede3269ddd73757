// ISO 7975: from a steady circle the brake is applied, harder from run to run, while the steering wheel stays where it is. How
// much faster or slower than a vehicle that keeps to its circle the real one turns after a second tells whether it turns in,
// runs wide or spins. Settling is driven once; every run repeats what the driver's hands did.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/braking.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/circle_braking.hpp"

namespace hamilcar {

namespace {

using circle_braking::Run, circle_braking::Steady;

constexpr int enough_locked = 2;  // wheels, where the series ends

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    std::vector<Setting> out = circle_braking::circle_settings(vehicle, 5);
    out.insert(out.end(), {{"least_deceleration", "m/s^2", "asked for in the first run", 2, 0.5, 15},
                           {"deceleration", "m/s^2", "asked for in the last run, if no wheel locks before", 8, 0.5, 20},
                           {"step", "m/s^2", "between runs", 1, 0.25, 10},
                           {"reference", "m/s^2", "deceleration that the figures are stated at", 4, 0.5, 15}});
    return out;
}

struct Driven : Run {
    Recording recording;
};

// Between the two runs around a deceleration; NaN outside.
double at_deceleration(const std::vector<Driven>& all, double deceleration, double Run::*value) {
    for (std::size_t i = 1; i < all.size(); ++i) {
        const Run &low = all[i - 1], &high = all[i];
        if (!(low.deceleration <= deceleration && deceleration <= high.deceleration)) continue;
        if (high.deceleration == low.deceleration) return low.*value;
        const double share = (deceleration - low.deceleration) / (high.deceleration - low.deceleration);
        return low.*value + share * (high.*value - low.*value);
    }
    return not_shown;
}

// Of all runs the value farthest from what is neutral, either way and with its sign.
double farthest(const std::vector<Driven>& all, double Run::*value, double neutral = 0) {
    double out = not_shown;
    for (const Driven& one : all) {
        const double here = one.*value;
        if (std::isnan(out) || std::abs(here - neutral) > std::abs(out - neutral)) out = here;
    }
    return out;
}

void add_figures(TestRun& test, const std::vector<Driven>& all, const Steady& steady) {
    const double reference = test["reference"];
    const auto at = [&](double Run::*value) { return at_deceleration(all, reference, value); };
    if (std::isnan(at(&Run::deceleration)) && !all.empty()) {
        test.note("no figures at {:g} m/s^2: the runs' mean decelerations go from {:.1f} to {:.1f} m/s^2", reference,
                  all.front().deceleration, farthest(all, &Run::deceleration));
    }
    const std::string where = fmt::format("1 s after braking began, at a mean deceleration of {:g} m/s^2", reference);
    circle_braking::add_steady_figures(test, steady);
    test.figure("speed", "km/h", steady.speed / kilometer_per_hour, "on the steady circle");
    test.figure("yaw rate ratio", "", at(&Run::yaw_rate_ratio),
                "yaw rate over that of a vehicle that stays on the circle, " + where);
    test.figure("lateral acceleration ratio", "", at(&Run::acceleration_ratio), "likewise, " + where);
    test.figure("path deviation", "m", at(&Run::deviation),
                "of the center of mass from the circle, inward positive, " + where);
    test.figure("sideslip change", "deg", at(&Run::sideslip_change), "since the beginning of braking, " + where);
    test.figure("extreme yaw rate ratio", "", farthest(all, &Run::yaw_rate_ratio, 1),
                "1 s after braking began, the one of all runs that is farthest from 1");
    test.figure("largest path deviation", "m", farthest(all, &Run::deviation),
                "1 s after braking began, the largest of all runs either way, inward positive");
    test.figure("largest sideslip change", "deg", farthest(all, &Run::largest_sideslip_change),
                "either way, of all runs");
    test.figure("largest yaw acceleration", "deg/s^2", farthest(all, &Run::largest_yaw_acceleration),
                "either way, of all runs");
    test.figure("largest deceleration", "m/s^2", farthest(all, &Run::deceleration), "mean over 1 s, of all runs");
    const auto locking = std::ranges::find_if(all, [](const Driven& one) { return one.locked > 0; });
    test.figure("deceleration with locked wheels", "m/s^2", locking == all.end() ? not_shown : locking->deceleration,
                "of the first run in which a wheel locked within 1 s");
}

void add_charts(TestRun& test, const std::vector<Driven>& all) {
    const auto add = [&](const std::string& title, const std::string& label, double Run::*value) -> io::Chart& {
        return test.chart(title, "mean deceleration [m/s^2]", label,
                          {over_runs(title, all, &Run::deceleration, value)});
    };
    const std::vector<std::pair<double, std::string>> neutral{{1, "stays on the circle"}};
    const std::string over = "over that on the circle [1]";
    add("Yaw rate ratio after 1 s", over, &Run::yaw_rate_ratio).horizontal_marks = neutral;
    add("Lateral acceleration ratio after 1 s", over, &Run::acceleration_ratio).horizontal_marks = neutral;
    add("Path deviation after 1 s", "inward [m]", &Run::deviation);
    add("Largest change of the sideslip angle", "[deg]", &Run::largest_sideslip_change);
    circle_braking::Drives drives;
    for (const Driven& one : all) drives.emplace_back(fmt::format("{:.1f} m/s^2", one.deceleration), &one.recording);
    circle_braking::add_time_charts(test, "while braking", drives);
}

// Pedal commands of the runs.
std::vector<double> pedals(TestRun& test) {
    const double full = brake_force_per_command(test.vehicle) / total_mass(test.vehicle);
    std::vector<double> out;
    for (double asked = test["least_deceleration"]; asked <= test["deceleration"] + 1e-9; asked += test["step"]) {
        if (asked > full) {
            test.note("its brakes are for {:.1f} m/s^2 at most, and the series ends there", full);
            break;
        }
        out.push_back(asked / full);
    }
    return out;
}

// One run after the other, until wheels lock; false if one broke off.
bool brake_harder_and_harder(TestRun& test, const Recording& settled, const std::vector<double>& pedals,
                             std::vector<Driven>& all) {
    const double width = 1 / (static_cast<double>(pedals.size()) + 1);
    for (const double pedal : pedals) {
        const double from = (static_cast<double>(all.size()) + 1) * width;
        ScenarioDescription scenario = circle_braking::braking(test, settled, pedal);
        scenario.name = fmt::format("braking in a turn, pedal at {:.0f} %", 100 * pedal);
        Drive drive = test.drive(scenario, {.share = {from, from + width}});
        if (!drive.breaks_off()) drive.warnings.clear();  // that a braking car does not hold its speed
        if (!test.take(drive)) return false;
        const Run run = circle_braking::evaluated(drive.recording, wheel_names(test.vehicle));
        all.push_back({run, std::move(drive.recording)});
        if (run.locked < enough_locked) continue;
        test.note("{} wheels locked at {:.1f} m/s^2, and the series ends there", run.locked, run.deceleration);
        break;
    }
    return true;
}

void run(TestRun& test) {
    if (test["least_deceleration"] > test["deceleration"]) {
        test.reject("least_deceleration", "expected at most 'deceleration', {:g} [m/s^2]", test["deceleration"]);
    }
    test.outcome.course.line = circle(test["radius"]);
    const auto wanted = pedals(test);
    const auto settled = circle_braking::settle(test, 1 / (static_cast<double>(wanted.size()) + 1));
    if (!settled) return;
    std::vector<Driven> all;
    if (!brake_harder_and_harder(test, *settled, wanted, all)) return;
    add_figures(test, all, circle_braking::steady(*settled));
    add_charts(test, all);
}

std::string unsupported_reason(const VehicleDescription& vehicle) {
    const std::string drive = needs_steering_and_drive(vehicle);
    return drive.empty() ? needs_brakes(vehicle) : drive;
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
            .unsupported_reason = unsupported_reason,
            .run = run,
            .course = [](const auto&, const Settings& chosen) { return Course{.line = circle(chosen.at("radius"))}; }};
}

}  // namespace hamilcar
