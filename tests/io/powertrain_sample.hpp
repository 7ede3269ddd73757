// The shipped car with another drive: engine, converter, motor and a tree of three differentials.
#pragma once

#include "files.hpp"

namespace hamilcar::io {

// What drives stands before what is driven.
inline constexpr const char* four_driven_wheels = R"(
[[differential]]
name = "center"
kind = "torque_biasing"
torque_share = 0.4
outputs = ["front", "rear"]
preload_N_m = 20
bias_ratio = 3
shaft_stiffness_N_m_per_rad = 14e3

[[differential]]
name = "rear"
kind = "limited_slip"
ratio = 3.25
outputs = ["rear_left", "rear_right"]
preload_N_m = 50
locking_value_drive = 0.25
locking_value_coast = 0.1
shaft_stiffness_N_m_per_rad = 8e3

[[differential]]
name = "front"
kind = "viscous"
ratio = 3.2
outputs = ["front_right", "front_left"]
viscosity_N_m_s_per_rad = 12
shaft_stiffness_N_m_per_rad = 7e3

[[power_unit]]
name = "engine"
output = "center"
inertia_kg_m2 = 0.2
axis = [-2, 0, 0]
response_time_s = 0.1
stiffness_N_m_per_rad = 1500
damping_ratio = 0.2

[power_unit.engine]
idle_rpm = 900
speed_rpm = [600, 3000, 6000]
full_load_N_m = [100, 200, 0]
overrun_N_m = [-10, -20, -40]

[[power_unit.engine.part_load]]
throttle = 0.5
torque_N_m = [90, 120, 0]

[power_unit.converter]
speed_ratio = [0, 0.9, 1]
torque_ratio = [2, 1, 1]
pump_torque_at_2000rpm_N_m = [250, 100, 0]
lockup_capacity_N_m = 350

[power_unit.gearbox]
ratios = [3, 1.5, 1]
reverse_ratio = 2
efficiency = 0.9
shift = "automatic"
shift_time_s = 0.3
upshift_rpm = 5500
upshift_closed_rpm = 2000
downshift_rpm = 2500
downshift_closed_rpm = 900

[[power_unit]]
name = "motor"
output = "rear"
inertia_kg_m2 = 0.05
stiffness_N_m_per_rad = 2000

[power_unit.motor]
max_torque_N_m = 200
max_power_W = 60e3
max_speed_rpm = 9000
regeneration = 0.3
)";

// The shipped car with this for its drive.
inline std::string car_driven_by(const std::string& drive) {
    const std::string& text = shipped_car_text();
    return text.substr(0, text.find("[[differential]]")) + drive;
}

}  // namespace hamilcar::io
