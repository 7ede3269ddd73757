// Adjustable dampers, active anti-roll bars and their controllers for any vehicle, whatever its own file says.
#pragma once

#include <cmath>

#include "hamilcar/vehicle/command_layout.hpp"
#include "support/fleet.hpp"

namespace hamilcar::test {

// Of the dampers' own forces, with the lag of a proportional valve [1], [s].
struct Adjustment {
    double soft = 0.4, firm = 2, response_time = 0.01;
};

inline VehicleDescription with_adjustable_dampers(VehicleDescription car, const Adjustment& by = {}) {
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionDamperDescription& one : suspension.dampers) {
            one.damper.soft = by.soft, one.damper.firm = by.firm, one.damper.response_time = by.response_time;
        }
    }
    return car;
}

// Of those that act on travels: a file refuses the others.
inline VehicleDescription with_active_bars(VehicleDescription car, double max_force = 4000,
                                           double response_time = 0.03) {
    std::vector<bool> has_arm;
    for_each_wheel(car, [&](const auto& wheel, std::size_t) { has_arm.push_back(wheel.bar_arm.has_value()); });
    for (AntiRollBarDescription& bar : car.anti_roll_bars) {
        if (!has_arm[bar.left]) bar.max_force = max_force, bar.response_time = response_time;
    }
    return car;
}

inline VehicleDescription with_both(const VehicleDescription& car) {
    return with_active_bars(with_adjustable_dampers(car));
}

inline ControllerDescription controller(const char* kind, double rate = 200,
                                        std::vector<std::pair<std::string, double>> settings = {}) {
    return {.kind = kind, .rate = rate, .settings = std::move(settings)};
}

// By these alone.
inline VehicleDescription controlled_by(VehicleDescription car, std::vector<ControllerDescription> controllers) {
    car.controllers = std::move(controllers);
    return car;
}

// Told from outside.
inline VehicleDescription told(VehicleDescription car) {
    return controlled_by(std::move(car), {controller("external", 100)});
}

// Another number for each command, all within their limits.
inline std::vector<double> mixed_commands(const CommandLayout& layout, double phase = 0) {
    std::vector<double> out;
    for (const Command& one : layout.commands()) {
        const double share = 0.5 + 0.45 * std::sin(phase + 1.7 * static_cast<double>(out.size()));
        out.push_back(one.min + share * (one.max - one.min));
    }
    return out;
}

}  // namespace hamilcar::test
