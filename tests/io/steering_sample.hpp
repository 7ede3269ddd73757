// Steerings with mechanics for the shipped car, in the place of its own.
#pragma once

#include "files.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {

inline constexpr const char* ratio_alone = R"([steering]
rack_m_per_revolution = 0.0365
rack_travel_m = 0.073
)";

// Every key, each with a number that no other one has.
inline constexpr const char* whole_steering = R"([steering]
rack_m_per_revolution = 0.0365
rack_travel_m = 0.073

[steering.rack]
mass_kg = 3.5
damping_N_s_per_m = 700
friction_N = 90
holding_stiffness_N_per_m = 2e6
stop_stiffness_N_per_m = 3e6

[steering.column]
inertia_kg_m2 = 0.045
damping_N_m_s_per_rad = 0.25
friction_N_m = 0.3
holding_stiffness_N_m_per_rad = 40
torsion_bar_stiffness_N_m_per_rad = 95
torsion_bar_damping_N_m_s_per_rad = 0.15
joint_error_deg = 1.5
joint_phase_deg = -30

[steering.assist]
torque_N_m = [0, 2, 8]
force_N = [0, 100, 4100]
speed_m_per_s = [0, 10, 40]
share = [1, 0.6, 0.2]
response_time_s = 0.004
lead_time_s = 0.007
fastest_rack_m_per_s = 0.11
rack_speed_band_m_per_s = 0.05

[steering.hands]
stiffness_N_m_per_rad = 800
damping_N_m_s_per_rad = 6
)";

inline constexpr const char* least_steering = R"([steering]
rack_m_per_revolution = 0.0365
rack_travel_m = 0.073
rack.mass_kg = 3.5
column.inertia_kg_m2 = 0.045
column.torsion_bar_stiffness_N_m_per_rad = 95
)";

// The shipped car with another steering than its own.
inline std::string car_with_steering(const std::string& steering) {
    const std::string& car = shipped_car_text();
    return car.substr(0, car.find("[steering]")) + steering + car.substr(car.find("\n[aerodynamics]"));
}

inline SteeringDescription read_steering_of(const std::string& text) {
    const TemporaryFolder folder;
    return read_vehicle(folder.write("car.toml", car_with_steering(text))).steering;
}

}  // namespace hamilcar::io
