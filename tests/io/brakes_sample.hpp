// Brake systems of fluid and of air for the shipped car, which has none of its own.
#pragma once

#include "files.hpp"

namespace hamilcar::io {

inline constexpr const char* fluid_system = R"(
[brakes]
medium = "fluid"
pedal_force_N = 300
pedal_ratio = 3.5
booster_gain = 5
master_cylinder_diameter_mm = 23.8
knee_pressure_bar = 100
response_time_s = 0.03
circuits = "diagonal"
failed_circuit = 2

[brakes.modulator]
pump_flow_cm3_per_s = 8
pump_pressure_bar = 180
)";

inline constexpr const char* air_system = R"(
[brakes]
medium = "air"
pedal_force_N = 350
full_pressure_bar = 8

[brakes.modulator]
)";

// Of the front axle: every key that a brake in a system of fluid may have.
inline constexpr const char* front_brake = R"(volume_cm3 = 3.1
line_flow_cm3_per_s = 70
type = "drum"
self_energizing = 0.5
heat.capacity_J_per_K = 4000
heat.cooling_W_per_K = 15
heat.cooling_W_s_per_K_m = 2.5
heat.temperature_degC = [0, 300, 700]
heat.friction = [0.9, 1.05, 0.6]
heat.friction_loss_s_per_m = 0.004
heat.friction_radius_m = 0.13
)";

// The shipped car, which has no brake system of its own, with one and with further keys of its front brakes.
inline std::string car_with_brakes(const std::string& system, const std::string& front = "") {
    constexpr const char* torque = "max_torque_N_m = 1650.0";
    return changed(shipped_car_text(), torque, front + torque) + system;
}

}  // namespace hamilcar::io
