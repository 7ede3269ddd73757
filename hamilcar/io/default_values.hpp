// What a vehicle file may leave out because it is hardly ever published: each from what the file must have. The formulas are
// [E], fitted to the shipped vehicles, whose own values they give within the factors in docs/files/vehicle.md ("What may be
// left out"; io_tests, DefaultValues).
#pragma once

#include <cmath>
#include <vector>

#include "hamilcar/base/units.hpp"

namespace hamilcar::io {

// Air at 20 degrees Celsius and 101.3 kPa [kg/m^3].
inline constexpr double default_air_density = 1.2;

// Caliper, bracket and knuckle in series [N m/rad], by what spins in them [kg m^2].
inline double default_windup_stiffness(double spin_inertia) {
    return 20e3 * std::pow(spin_inertia, 0.75);
}

// Half of critical [N m s/rad].
inline double default_windup_damping(double stiffness, double spin_inertia) {
    return std::sqrt(stiffness * spin_inertia);
}

// Of the shaft to one output [N m/rad]: shafts are made for what the tires can pass on, which goes with the mass [kg].
inline double default_shaft_stiffness(double chassis_mass) {
    return 6.5 * chassis_mass;
}

// Springs of a clutch disc or a flywheel [N m/rad]: ten degrees under the largest torque [N m].
inline double default_unit_stiffness(double max_torque) {
    return max_torque / (10 * units::degree);
}

// Of all that turns with the rotor [kg m^2], by the largest torque [N m].
inline double default_engine_inertia(double max_torque) {
    return 8e-4 * max_torque;
}
inline double default_motor_inertia(double max_torque) {
    return 1.6e-4 * max_torque;
}

// What an engine without fuel brakes with [N m] at its speeds [rad/s]: friction and pumping grow with the speed.
inline std::vector<double> default_overrun(const std::vector<double>& speeds, double max_torque) {
    std::vector<double> torques;
    for (const double speed : speeds) torques.push_back(-max_torque * (0.05 + 0.025 * speed / (1000 * units::rpm)));
    return torques;
}

}  // namespace hamilcar::io
