#include "hamilcar/maneuver/slow_steer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/butterworth.hpp"
#include "hamilcar/analysis/series_tools.hpp"

namespace hamilcar {

namespace {

constexpr double steering_rate = 13.5 * degree;       // [rad/s]
constexpr double sought = 0.3 * standard_gravity;     // [m/s^2]
constexpr double line_from = 0.1 * standard_gravity;  // NHTSA TP-126: the line is fitted between these [m/s^2]
constexpr double line_to = 0.375 * standard_gravity;
constexpr double enough = 0.4 * standard_gravity;  // the turn ends; smoothing needs a little more than the line [m/s^2]
constexpr double least_reached = 0.15 * standard_gravity;  // below it there is no line to speak of [m/s^2]
constexpr double tipping_share =
    0.85;                      // of the lateral acceleration that tips a rigid vehicle over: no further than there [1]
constexpr double start = 0.5;  // of the turn [s]
constexpr double largest_angle = 270 * degree;  // no further, as far as the steering goes
constexpr int directions = 2;

struct Turn {
    std::vector<double> angle, acceleration;  // toward the turn [rad], [m/s^2]
    Trial trial;
};

Turn turn(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed, double side, double from,
          double to) {
    const double largest = std::min(largest_angle, steering_lock(vehicle)), time = largest / steering_rate;
    ScenarioDescription scenario = driving_at(vehicle, options, speed, start + time);
    scenario.name = side > 0 ? "slowly increasing steer, left" : "slowly increasing steer, right";
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = turned({{0, 0}, {start, 0}, {start + time, side * largest}});
    scenario.driver.ending.lateral_acceleration = std::min(enough, tipping_share * tipping_acceleration(vehicle));
    Turn out;
    out.trial = drive(vehicle, scenario, {.keep_going = share(options, from, to)});
    if (out.trial.breaks_off()) return out;
    const History& h = out.trial.history;
    for (const double value : smoothed(h.lateral_acceleration, row_rate(h))) out.acceleration.push_back(side * value);
    for (const double value : h.steering_wheel) out.angle.push_back(side * value);
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

io::Curve curve(const Turn& turn, const std::string& label) {
    constexpr std::size_t every = 10;  // rows
    io::Curve out{.label = label};
    for (std::size_t i = 0; i < turn.angle.size(); i += every) {
        out.x.push_back(turn.angle[i] / degree), out.y.push_back(turn.acceleration[i]);
    }
    return out;
}

}  // namespace

double row_rate(const History& history) {
    return history.size() < 2 ? 1
                              : static_cast<double>(history.size() - 1) / (history.time.back() - history.time.front());
}

std::vector<double> smoothed(const std::vector<double>& values, double rate) {
    return low_passed_both_ways(values, rate, {.order = 6, .cutoff = 6});
}

SlowSteer slow_steer(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed, double from,
                     double to, Outcome& outcome) {
    SlowSteer out{.r_squared = 1, .reached = endless};
    for (int i = 0; i < directions; ++i) {
        const double side = i == 0 ? 1 : -1, width = (to - from) / directions;
        const Turn one = turn(vehicle, options, speed, side, from + i * width, from + (i + 1) * width);
        if (!add_search_trial(outcome, one.trial)) {
            out.failed = outcome.failed;
            return out;
        }
        const double reached = *std::ranges::max_element(one.acceleration);
        const auto fit = line(one, reached);
        out.reached = std::min(out.reached, reached);
        if (!fit || reached < least_reached || fit->slope <= 0) {
            out.failed = fmt::format(
                "slowly increasing steer at {:.4g} km/h came to a lateral acceleration of {:.2f} m/s^2 "
                "only, too little for the angle at 0.3 g{}",
                speed / kilometer_per_hour, reached, one.trial.trouble.empty() ? "" : ": " + one.trial.trouble);
            return out;
        }
        out.angle += (sought - fit->intercept) / fit->slope / directions;
        out.r_squared = std::min(out.r_squared, fit->r_squared);
        out.over.push_back(curve(one, side > 0 ? "to the left" : "to the right"));
    }
    if (out.reached < sought) {
        outcome.notes.push_back(
            fmt::format("the angle at 0.3 g is extrapolated: slowly increasing steer ended at {:.2f} m/s^2, "
                        "before a wheel lifts or because the lock was reached",
                        out.reached));
    }
    return out;
}

void add_slow_steer(const SlowSteer& test, Outcome& outcome) {
    outcome.figures.push_back(
        {"steering wheel angle at 0.3 g", "deg", "A of the slowly increasing steer test", test.angle / degree});
    io::Chart chart{.title = "Slowly increasing steer",
                    .x_label = "steering wheel angle [deg]",
                    .y_label = "lateral acceleration [m/s^2]",
                    .curves = test.over};
    chart.vertical_marks = {{test.angle / degree, "A"}};
    outcome.charts.push_back(std::move(chart));
}

}  // namespace hamilcar
