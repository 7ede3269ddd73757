#include "hamilcar/maneuver/amplitude.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/linear_model.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

Setting speed_setting(const VehicleDescription& vehicle, double default_value, double default_heavy) {
    return {"speed", "km/h", "that the driver holds", is_heavy(vehicle) ? default_heavy : default_value, 20, 250};
}

Setting acceleration_setting(const VehicleDescription& vehicle, double default_value, double default_heavy,
                             const std::string& meaning) {
    const double value = is_heavy(vehicle) ? default_heavy : default_value;
    return {"lateral_acceleration", "m/s^2", meaning, value, 0.05, 30};
}

Amplitude amplitude_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration) {
    const Linearizer linearizer(vehicle);
    const Column column(vehicle.steering);
    constexpr double less = 0.85, min_share = 0.05;
    for (double share = 1; share > min_share; share *= less) {
        const double tried = share * lateral_acceleration;
        const OperatingPoint at = linearizer.operating_point({.speed = speed, .lateral_acceleration = tried});
        if (!at.found) continue;
        Amplitude out{column.angle(at.input.rack.displacement), tried, ""};
        if (share < 1) {
            out.note = fmt::format("no steady driving at {:.3g} m/s^2 and {:.3g} km/h: {:.3g} m/s^2 instead",
                                   lateral_acceleration, speed / kilometer_per_hour, tried);
        }
        return out;
    }
    const double angle = std::min(angle_for(vehicle, speed, lateral_acceleration), steering_lock(vehicle));
    return {angle, lateral_acceleration,
            "no steady driving was found: the steering wheel's angle is that of linear theory"};
}

double angle_for(TestRun& test, double speed, double lateral_acceleration) {
    const Amplitude amplitude = amplitude_for(test.vehicle, speed, lateral_acceleration);
    if (!amplitude.note.empty()) test.outcome.notes.push_back(amplitude.note);
    return amplitude.angle;
}

Drive drive_aimed(TestRun& test, const Aim& aim, double speed, double angle) {
    constexpr int tries = 3;
    constexpr double good = 0.02, max_change = 1.5;  // share of what is wanted; of the next angle over the last one
    const double lock = steering_lock(test.vehicle);
    for (int i = 1;; ++i) {
        const Share share{1 - std::pow(0.5, i - 1), i < tries ? 1 - std::pow(0.5, i) : 1};
        Drive drive =
            test.drive(steered_at(test, speed, aim.steering(angle)), {.interval = aim.interval, .share = share});
        if (drive.stopped != Stopped::no) return drive;
        const double better = aim.lateral_acceleration / aim.reached(drive.recording);
        const double next = std::min(angle * std::clamp(better, 1 / max_change, max_change), lock);
        if (i == tries || !(std::abs(better - 1) > good) || next == angle) return drive;
        test.take_energy(drive);
        angle = next;
    }
}

void judge_speed(TestRun& test, const Recording& recording, double from, double to) {
    const double wanted = test["speed"];
    constexpr double tolerance = 2;  // ISO 7401's [km/h]
    const auto off = shifted(between(recording[channel::speed], from, to).values, -wanted);
    const double farthest = largest_magnitude(off) / kilometer_per_hour;
    test.verdict(fmt::format("speed within {:g} km/h of {:.4g} km/h from {:.3g} s to {:.3g} s", tolerance,
                             wanted / kilometer_per_hour, from, to),
                 farthest <= tolerance, fmt::format("{:.2g} km/h off", farthest));
}

void judge_lateral_acceleration(TestRun& test, const std::string& what, double reached) {
    constexpr double tolerance = 0.1;
    const double wanted = test["lateral_acceleration"];
    test.verdict(fmt::format("{} within 10 percent of {:.3g} m/s^2", what, wanted),
                 std::abs(reached / wanted - 1) <= tolerance, fmt::format("{:.3g} m/s^2", reached));
}

}  // namespace hamilcar
