// Mechanics of a steering for any vehicle, whatever its own file says: the numbers of the tests stay when those of the files change.
#pragma once

#include "support/fleet.hpp"

namespace hamilcar::test {

// Without friction, damping and assist: nothing but masses and the torsion bar, of usual sizes for a passenger car.
inline SteeringMechanicsDescription bare_mechanics() {
    SteeringMechanicsDescription d;
    d.rack_mass = 3, d.rack_stiffness = 1e6, d.stop_stiffness = 2e6;
    d.wheel_inertia = 0.04, d.wheel_stiffness = 10;
    d.bar_stiffness = 115;  // 2 N m a degree
    d.hands_stiffness = 1000, d.hands_damping = 9;
    return d;
}

inline SteeringAssistDescription usual_assist() {
    return {.torque = {0, 1, 3, 6},
            .force = {0, 0, 1000, 6000},
            .speed = {0, 30, 60},
            .share = {1, 0.6, 0.4},
            .response_time = 0.004,
            .lead_time = 0.01,
            .fastest_rack = 0.3,
            .rack_band = 0.05};
}

// With everything that there is.
inline SteeringMechanicsDescription full_mechanics() {
    SteeringMechanicsDescription d = bare_mechanics();
    d.rack_damping = 60, d.rack_friction = 150, d.rack_stiffness = 1.5e6;
    d.wheel_damping = 0.05, d.wheel_friction = 0.3, d.wheel_stiffness = 30;
    d.bar_damping = 0.4;
    d.joint_error = 0.01, d.joint_phase = 0.3;
    d.assist = usual_assist();
    return d;
}

inline VehicleDescription with_mechanics(VehicleDescription car, const SteeringMechanicsDescription& mechanics) {
    car.steering.mechanics = mechanics;
    return car;
}

// The rack moves on its own. Hands hold the steering wheel firmly until told otherwise.
inline ScenarioDescription set_free(ScenarioDescription s) {
    s.steering_mechanics = true;
    return s;
}

// The numbers of the steering in a state.
inline SteeringState<const double> steering_state(const Model<double>& model, const State<double>& state) {
    const SteeringState<const double> at = model.vehicle.steering.state(state.values.data());
    return at;
}

}  // namespace hamilcar::test
