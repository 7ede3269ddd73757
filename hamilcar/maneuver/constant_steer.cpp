// ISO 4138, constant steering wheel angle: the wheel is held where it leads round a circle at a crawl, and the vehicle goes
// faster in steps with a rest on each. An understeering one runs wider, an oversteering one tighter.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steady_turn.hpp"

namespace hamilcar {

namespace {

constexpr double gentle = 0.5;       // acceleration from rest to rest [m/s^2]
constexpr double shortest_ramp = 1;  // [s]
constexpr double turning = 2;        // time for the steering wheel to its angle [s]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {{"radius", "m", "at a crawl, by linear theory", heavy ? 60.0 : 50.0, 10, 500},
            {"step", "m/s^2", "of lateral acceleration on that circle from one rest to the next", heavy ? 0.15 : 0.4,
             0.05, 2},
            rest_setting(),
            {"largest_speed", "km/h", "up to which it is tried", heavy ? 70.0 : 100.0, 20, 250},
            small_setting(vehicle)};
}

// Rests on these lateral accelerations of the circle, up to the largest speed; the steering wheel has to be turned before.
std::vector<double> levels(const TestRun& test) {
    std::vector<double> out;
    for (double a = test["step"]; std::sqrt(test["radius"] * a) <= test["largest_speed"]; a += test["step"])
        out.push_back(a);
    return out;
}

double ramp(const std::vector<double>& speeds, std::size_t i) {
    return std::max(shortest_ramp, (speeds[i + 1] - speeds[i]) / gentle);
}

void run(TestRun& test) {
    const double lock = steering_lock(test.vehicle), radius = test["radius"];
    const double wanted = turning_geometry(test.vehicle).angle_per_curvature() / radius * degree,
                 angle = std::min(wanted, lock);
    if (wanted > lock) {
        test.note("the steering wheel stands at its lock: the circle is one of {:.1f} m", radius * wanted / lock);
    }
    const std::vector<double> accelerations = levels(test);
    if (accelerations.empty()) return test.fail("the largest speed is below that of the first step");
    const Stairs planned = stairs(accelerations, radius, test["rest"], turning, ramp);
    ScenarioDescription scenario = climbing(test, planned, radius);
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = {.time = {0, turning}, .value = {0, angle}};
    Drive drive = test.drive(scenario, {.interval = 0.02});
    const std::vector<SteadyTurn> rests =
        rests_of(drive.recording, planned, [](const SteadyTurn& rest, double) { return !rest.settled(); });
    evaluate(test, rests, 1.2 * test["step"], Steering::held);
    const double until = rests.empty() ? 0 : rests.back().time + steady_window / 2;
    const auto counts = [&](std::size_t row) { return drive.recording.time()[row] <= until; };
    test.figure("largest lateral acceleration", "m/s^2", largest_lateral_acceleration(drive.recording, counts),
                "over a second, up to the last steady state");
    test.figure("steering wheel angle", "deg", angle / degree, "that was held");
    finish_steady(test, drive, rests.size());
}

}  // namespace

Maneuver constant_steer() {
    return {.name = "constant_steer",
            .title = "Steady-state circular driving, constant steering wheel angle",
            .standard = "ISO 4138",
            .summary = "The steering wheel is held and the vehicle goes faster in steps: it runs wider or tighter.",
            .settings = settings,
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
