#include "hamilcar/maneuver/dwell_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar::dwell {

SignalDescription sine(double amplitude) {
    constexpr int points = 150;  // of the sine
    constexpr double period = 1 / frequency;
    SignalDescription out{.time = {0}, .value = {0}};
    for (int i = 0; i <= points; ++i) {
        const double t = period * i / points;
        if (4 * i > 3 * points && out.time.back() < steering + 0.75 * period + pause) {
            out.time.push_back(steering + 0.75 * period), out.value.push_back(-amplitude);
            out.time.push_back(steering + 0.75 * period + pause), out.value.push_back(-amplitude);
        }
        const double paused = 4 * i > 3 * points ? pause : 0;
        out.time.push_back(steering + t + paused);
        out.value.push_back(amplitude * std::sin(2 * std::numbers::pi * frequency * t));
    }
    return out;
}

// Yaw rate and lateral acceleration smoothed; the second peak of the yaw rate is its largest value
// against the first turn between the wheel's change of sign and its return.
void evaluate(const History& h, Run& run) {
    const double rate = row_rate(h), side = run.amplitude > 0 ? 1 : -1;
    const std::vector<double> raw_rate = straight::scaled(h.yaw_rate, -side);
    const std::vector<double> yaw_rate = smoothed(raw_rate, rate);
    const Series yaw{.values = yaw_rate, .rate = rate};
    const double reversal = steering + 0.5 / frequency, last = h.time.back();
    for (std::size_t i = 0; i < h.size(); ++i) run.sideslip = std::max(run.sideslip, std::abs(h.sideslip(i)));
    if (const auto peak = hamilcar::peak(yaw, Extreme::highest, reversal, end); peak && last > end) {
        run.peak = peak->value;
        if (last >= end + early) run.early = 100 * interpolated(yaw, end + early) / peak->value;
        if (last >= end + late) run.late = 100 * interpolated(yaw, end + late) / peak->value;
    }
    const double beginning =
        steering + std::asin(std::min(begun / std::abs(run.amplitude), 1.0)) / (2 * std::numbers::pi * frequency);
    const double measured = beginning + displacement_time;
    if (last < measured) return;
    std::vector<double> acceleration = smoothed(straight::scaled(h.lateral_acceleration, side), rate);
    const std::size_t from = row_at(h, beginning);
    acceleration.erase(acceleration.begin(), acceleration.begin() + static_cast<long>(from));
    const Series across{.values = acceleration, .rate = rate, .start = h.time[from]};
    const std::vector<double> velocity = running_integral(across);
    const std::vector<double> distance = running_integral({.values = velocity, .rate = rate, .start = h.time[from]});
    run.displacement = interpolated({.values = distance, .rate = rate, .start = h.time[from]}, measured);
    run.path = side * (interpolated({.values = h.y, .rate = rate}, measured) -
                       interpolated({.values = h.y, .rate = rate}, beginning));
}

Trial drive_run(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed, const Run& run,
                bool film, std::function<bool(double)> keep_going) {
    constexpr double afterwards = 0.3;  // smoothing needs a little more than is evaluated [s]
    ScenarioDescription scenario = driving_at(vehicle, options, speed, end + late + afterwards);
    scenario.name = fmt::format("sine with dwell, {:.0f} deg to the {} first", std::abs(run.amplitude) / degree,
                                run.amplitude > 0 ? "left" : "right");
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = sine(run.amplitude);
    lift_foot(scenario, speed, lift);
    return drive(vehicle, scenario, {.film = film, .keep_going = std::move(keep_going)});
}

}  // namespace hamilcar::dwell
