// The shipped car with a battery, a motor by maps in front and one in each rear wheel, and an engine whose gearbox has an inertia.
#pragma once

#include "powertrain_sample.hpp"

namespace hamilcar::io {

inline constexpr const char* electric_drive = R"(
[battery]
capacity_Ah = 100
charge = [0, 0.5, 1]
open_voltage_V = [300, 350, 400]
resistance_ohm = 0.1
initial_charge = 0.7
max_discharge_W = 150e3
max_charge_W = 80e3
auxiliary_power_W = 400

[[differential]]
name = "front"
ratio = 9
outputs = ["front_left", "front_right"]

[[power_unit]]
name = "front_motor"
output = "front"
axis = [0, 1, 0]

[power_unit.motor]
speed_rpm = [0, 4000, 12000]
brake_regeneration = 0.8

[[power_unit.motor.at_voltage]]
voltage_V = 300
torque_N_m = [250, 200, 30]

[[power_unit.motor.at_voltage]]
voltage_V = 400
torque_N_m = [260, 260, 60]

[power_unit.motor.efficiency_map]
speed_rpm = [0, 6000]

[[power_unit.motor.efficiency_map.at_torque]]
torque_N_m = 10
efficiency = [0.5, 0.8]

[[power_unit.motor.efficiency_map.at_torque]]
torque_N_m = 200
efficiency = [0.7, 0.95]

[[power_unit]]
name = "rear_left_motor"
output = "rear_left"
mount = "carrier"
inertia_kg_m2 = 0.02

[power_unit.motor]
max_torque_N_m = 60
max_power_W = 20e3
max_speed_rpm = 9000

[power_unit.gearbox]
ratios = [5]

[[power_unit]]
name = "rear_right_motor"
output = "rear_right"
inertia_kg_m2 = 0.02
axis = [0, 1, 0]

[power_unit.motor]
max_torque_N_m = 60
max_power_W = 20e3
max_speed_rpm = 9000
efficiency = 0.8

[power_unit.gearbox]
ratios = [5]

[power_unit.shafts]
gearbox_inertia_kg_m2 = 0.01
stiffness_N_m_per_rad = 6000
backlash_deg = 3
)";

}  // namespace hamilcar::io
