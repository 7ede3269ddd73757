#include "hamilcar/maneuver/slow_steer.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/butterworth.hpp"

namespace hamilcar {

namespace {

constexpr double steering_rate = 13.5;                // [deg/s]
constexpr double sought = 0.3 * standard_gravity;     // [m/s^2]
constexpr double line_from = 0.1 * standard_gravity;  // NHTSA TP-126: the line is fitted between these [m/s^2]
constexpr double line_to = 0.375 * standard_gravity;
constexpr double enough = 0.4 * standard_gravity;  // the turn ends; smoothing needs a little more than the line [m/s^2]
constexpr double min_reached = 0.15 * standard_gravity;  // below it there is no line to speak of [m/s^2]
constexpr double tipping_share =
    0.85;                      // of the lateral acceleration that tips a rigid vehicle over: no further than there [1]
constexpr double start = 0.5;  // of the turn [s]
constexpr double largest_angle = 270;  // no further, as far as the steering goes [deg]

struct Turn {
    std::vector<double> angle, acceleration;  // toward the turn [deg], [m/s^2]
    Drive drive;
};

Turn turn(const TestRun& test, double speed, double side, Share share) {
    const double largest = std::min(largest_angle, steering_lock(test.vehicle) / degree),
                 time = largest / steering_rate;
    ScenarioDescription scenario =
        steered_at(test, speed, turned({{0, 0}, {start, 0}, {start + time, side * largest * degree}}));
    scenario.name = side > 0 ? "slowly increasing steer, left" : "slowly increasing steer, right";
    scenario.driver.ending.lateral_acceleration = std::min(enough, tipping_share * tipping_acceleration(test.vehicle));
    Turn out{.drive = test.drive(scenario, {.share = share, .replay = false})};
    if (out.drive.breaks_off()) return out;
    out.acceleration = scaled(smoothed(out.drive.recording[channel::lateral_acceleration]), side);
    out.angle = scaled(out.drive.recording[channel::steering_wheel].values, side);
    return out;
}

// The line through those rows that lie within the limits.
std::optional<FittedLine> line(const Turn& turn, double reached) {
    std::vector<double> angle, acceleration;
    for (std::size_t i = 0; i < turn.angle.size(); ++i) {
        if (turn.acceleration[i] > std::min(line_to, reached)) break;
        if (turn.acceleration[i] < line_from) continue;
        angle.push_back(turn.angle[i]), acceleration.push_back(turn.acceleration[i]);
    }
    if (angle.size() < 3 || angle.front() == angle.back()) return {};
    return fitted_line(angle, acceleration);
}

void add_line(TestRun& test, const SlowSteer& found) {
    test.figure("steering wheel angle at 0.3 g", "deg", found.angle, "A of the slowly increasing steer test");
    test.chart("Slowly increasing steer", "steering wheel angle [deg]", "lateral acceleration [m/s^2]", found.over)
        .vertical_marks = {{found.angle, "A"}};
}

}  // namespace

std::vector<double> smoothed(const Series& series) {
    return low_passed_both_ways({series.values.begin(), series.values.end()}, series.rate, {.order = 6, .cutoff = 6});
}

std::optional<SlowSteer> slow_steer(TestRun& test, double speed, Share share) {
    constexpr std::size_t every = 10;  // rows of the diagram
    SlowSteer out{.r_squared = 1, .reached = endless};
    for (const double side : {1.0, -1.0}) {
        const double middle = 0.5 * (share.from + share.to);
        const Turn one = turn(test, speed, side, side > 0 ? Share{share.from, middle} : Share{middle, share.to});
        if (!test.take_energy(one.drive)) return {};
        const double reached = *std::ranges::max_element(one.acceleration);
        const auto fit = line(one, reached);
        out.reached = std::min(out.reached, reached);
        if (!fit || reached < min_reached || fit->slope <= 0) {
            test.fail(
                "slowly increasing steer at {:.4g} km/h came to a lateral acceleration of {:.2f} m/s^2 only, too "
                "little for the angle at 0.3 g{}",
                speed / kilometer_per_hour, reached, one.drive.trouble.empty() ? "" : ": " + one.drive.trouble);
            return {};
        }
        out.angle += (sought - fit->intercept) / fit->slope / 2;
        out.r_squared = std::min(out.r_squared, fit->r_squared);
        out.over.push_back(
            curve(side > 0 ? "to the left" : "to the right", one.angle, one.acceleration, one.angle.size() / every));
    }
    if (out.reached < sought) {
        test.note(
            "the angle at 0.3 g is extrapolated: slowly increasing steer ended at {:.2f} m/s^2, before a wheel "
            "lifts or because the lock was reached",
            out.reached);
    }
    add_line(test, out);
    return out;
}

}  // namespace hamilcar
