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
            .force = {0, 0, 600, 2500},
            .speed = {0, 30, 60},
            .share = {1, 0.6, 0.4},
            .response_time = 0.004,
            .lead_time = 0.006,
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

// Springs and dampers between chassis and knuckle in front, off the strut: the rack moves them.
inline VehicleDescription sprung_at_the_knuckle() {
    VehicleDescription car = shipped("bmw_323i");
    for (std::size_t s = 0; s < 2; ++s) {
        SuspensionDescription& suspension = car.suspensions[s];
        const Point& c = suspension.wheels[0].wheel.center;
        LineDescription line;
        line.part = suspension.wheels[0].part;
        line.on_part = {c[0] + 0.06, 0.8 * c[1], 0.36}, line.on_base = {c[0] - 0.01, 0.75 * c[1], 0.7};
        suspension.springs[0].line = suspension.dampers[0].line = line;
    }
    return car;
}

// The rack moves on its own. Hands hold the steering wheel firmly until told otherwise.
inline ScenarioDescription set_free(ScenarioDescription s) {
    s.steering_mechanics = true;
    return s;
}

// A lane change under drive and brake, by hands that hold less and less and pull besides.
inline ScenarioDescription steering_moves(const VehicleDescription& car, double duration = 2) {
    ScenarioDescription s = set_free(everything_moves(car, duration));
    s.hands = table({0.8, 1.6}, {1, 0.1});
    s.steering_torque = table({0.3, 0.6, 1.0, 1.5}, {0, 2, -3, 0});
    return s;
}

inline Input<double> hands_off(double) {
    Input<double> input;
    input.hands_hold = 0;
    return input;
}

// Steps by the blocks as they are written, with inputs as a function of time; look(time, state) after each.
template <class Driver, class Look>
void drive(const Model<double>& model, State<double>& state, const char* method, double step, double duration,
           const Driver& driver, const Look& look) {
    Integrator<State<double>> integrator(*find_method(method), step, model.vehicle.state_size);
    const long steps = std::lround(duration / step);
    for (long i = 0; i < steps; ++i) {
        integration_block(model, integrator, driver, static_cast<double>(i) * step, state);
        look(static_cast<double>(i + 1) * step, state);
    }
}

// The numbers of the steering in a state.
inline SteeringState<const double> steering_state(const Model<double>& model, const State<double>& state) {
    return model.vehicle.steering.state(state.values.data());
}

}  // namespace hamilcar::test
