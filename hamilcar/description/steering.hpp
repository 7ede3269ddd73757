// The mechanics of a steering as a person writes them down: what is between the hands and the rack. SI units, radians.
#pragma once

#include <vector>

namespace hamilcar {

// Force of the power assist on the rack: over the torque of the torsion bar, times a share over the vehicle's speed.
struct SteeringAssistDescription {
    std::vector<double> torque, force;  // [N m], increasing from 0; [N], from 0 at least
    std::vector<double> speed, share;   // [m/s], increasing; [1]
    double response_time = 0.003;       // first order [s]
    double lead_time = 0.006;           // of the torque that it answers to, against its own lag [s]
    double fastest_rack = 1;            // up to where it helps fully; a pump's flow ends there [m/s]
    double rack_band = 0.05;            // over which it fades beyond [m/s]
};

struct SteeringMechanicsDescription {
    double rack_mass = 0;        // with what an assisting motor's rotor adds [kg]
    double rack_damping = 0;     // [N s/m]
    double rack_friction = 0;    // dry [N]
    double rack_stiffness = 0;   // of that friction while it holds [N/m]
    double stop_stiffness = 0;   // beyond the rack's travel [N/m]
    double wheel_inertia = 0;    // of steering wheel and column [kg m^2]
    double wheel_damping = 0;    // [N m s/rad]
    double wheel_friction = 0;   // dry [N m]
    double wheel_stiffness = 0;  // of that friction while it holds [N m/rad]
    double bar_stiffness = 0;    // of the torsion bar with the column [N m/rad]
    double bar_damping = 0;      // [N m s/rad]
    double joint_error = 0;      // amplitude by which bent joints lead and lag, twice a turn [rad]
    double joint_phase = 0;      // angle of the steering wheel at which they do neither [rad]
    double hands_stiffness = 0;  // of hands that hold firmly [N m/rad]
    double hands_damping = 0;    // [N m s/rad]
    SteeringAssistDescription assist;
};

}  // namespace hamilcar
