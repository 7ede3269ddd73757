#include "hamilcar/maneuver/runs.hpp"

#include <algorithm>

#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

// Calls f(body) for everything that has mass.
template <class F>
void for_each_body(const VehicleDescription& vehicle, F&& f) {
    f(vehicle.chassis);
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        for (const SuspensionBodyDescription& body : suspension.bodies) f(body.body);
    }
    for (const TrailerDescription& trailer : vehicle.trailers) f(trailer.chassis);
}

}  // namespace

double tipping_acceleration(const VehicleDescription& vehicle) {
    double mass = 0, moment = 0;
    for_each_body(
        vehicle, [&](const BodyDescription& body) { mass += body.mass, moment += body.mass * body.center_of_mass[2]; });
    double half_track = 1e9, ground = 1e9;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        half_track = std::min(half_track, std::abs(wheel.wheel.center[1]));
        ground = std::min(ground, wheel.wheel.center[2] - casing_of(wheel.tire).radius);
    });
    return vehicle.gravity * half_track / (moment / mass - ground);
}

SignalDescription turned(const std::vector<std::array<double, 2>>& corners) {
    constexpr double fine = 0.01;  // [s]
    SignalDescription out;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const auto [from, start] = corners[i];
        const auto [to, end] = corners[i + 1];
        const int parts = start == end ? 1 : std::max(1, static_cast<int>(std::ceil((to - from) / fine)));
        for (int k = 0; k < parts; ++k) {
            const double share = static_cast<double>(k) / parts;
            out.time.push_back(from + share * (to - from)), out.value.push_back(start + share * (end - start));
        }
    }
    out.time.push_back(corners.back()[0]), out.value.push_back(corners.back()[1]);
    return out;
}

void lift_foot(ScenarioDescription& scenario, double speed, double time) {
    constexpr double at_once = 0.01;  // [s]
    scenario.driver.speed->may_brake = false;
    scenario.driver.speed->speed = {
        .time = {0, time, time + at_once}, .value = {speed, speed, 0}, .interpolation = Interpolation::linear};
}

}  // namespace hamilcar
