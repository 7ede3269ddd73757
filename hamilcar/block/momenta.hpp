// Momenta block (paper, section 6.1 (2)): forces, then the rates of the momenta.
//
//     P_V' of suspensions and hitches (suspension_momenta.hpp)
//     p' = F,  L' = N_O - r' x p                                 // external forces only
#pragma once

#include "hamilcar/block/powertrain_momenta.hpp"

namespace hamilcar {

// Forces of the ground, the air and gravity on the chassis itself.
template <class T>
void chassis_momenta(const Vehicle<T>& vehicle, const Surroundings<T>& world, const Vec3<T>& wind,
                     const UnitGround<T>& ground, Spatial<T>& external, T& work_rate) {
    const auto air = vehicle.aerodynamics.evaluate(world.chassis, wind);
    const WheelGround<T> below = ground_of_hull(ground, vehicle.hull, world.chassis);
    const auto hull = vehicle.hull.contact(below.plane, world.chassis, below.rise);
    external =
        air.wrench + hull.wrench +
        spatial<T>(world.gravity * vehicle.chassis.mass, vehicle.chassis_inertia.first_moment.cross(world.gravity));
    work_rate = air.power + hull.lost_power;
}

// The steering from the rack to the hands, once the suspensions' force on the rack is known.
template <class T, class S>
void steering_momenta(const Vehicle<T>& vehicle, const State<T>& state, const Input<T>& input,
                      const Velocity<T, S>& velocity, Momenta<T>& out) {
    const SteeringHands<T> hands{input.rack.displacement, input.rack.rate, input.hands_hold, input.hands_torque};
    out.steering = vehicle.steering.evaluate(vehicle.steering.state(state.values.data()), velocity.rack.rate, hands,
                                             linear(velocity.chassis)[0]);
    out.work_rate += out.steering.work_rate;
}

template <class T>
void actuator_rates(const Vehicle<T>& vehicle, const State<T>& state, const Input<T>& input, Momenta<T>& out) {
    for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
        const Actuator<T>& one = vehicle.actuators[i];
        const T target = input.commands ? input.commands[one.command] : one.rest;
        out.actuator_rates[i] =
            one.rate * (target - state.values[static_cast<std::size_t>(vehicle.actuator_place) + i]);
    }
}

// Of the brake on a wheel [N m].
template <class T>
T brake_torque(const Vehicle<T>& vehicle, const Momenta<T>& momenta, int number) {
    const auto [s, w] = locate_wheel(vehicle, number);
    return momenta.suspensions[s].wheels[w].brake_torque;
}

template <class S, class T>
Momenta<T> momenta_block_of(const Model<T>& model, const State<T>& state, const Input<T>& input,
                            const Velocity<T, S>& velocity) {
    Momenta<T> out;
    const Vehicle<T>& vehicle = model.vehicle;
    const UnitPose<T> pose{state.position(), velocity.R_GC};
    const Surroundings<T> world = surroundings_of(model, pose, velocity.chassis);
    UnevenGround<T> uneven;
    const UnitGround<T> below_chassis = ground_below(model, pose, world.road, input.time, uneven);
    const Mat3<T>& R = velocity.R_GC;
    const Vec3<T> wind = R.row(0).transpose() * input.wind_x + R.row(1).transpose() * input.wind_y;
    chassis_momenta(vehicle, world, wind, below_chassis, out.external, out.work_rate);
    ShaftTorques<T> shafts;
    brake_limits(vehicle, state, input, velocity, out.brakes);
    powertrain_momenta(vehicle, state, input, velocity, out, shafts);
    add_parking_brakes(vehicle, input, out.brakes);
    suspension_momenta(model, state, input, velocity, world, shafts, out);
    actuator_rates(vehicle, state, input, out);
    if (vehicle.steering.exists()) steering_momenta(vehicle, state, input, velocity, out);
    brake_rates(
        vehicle.brakes, state, input, [&](int wheel) { return brake_torque(vehicle, out, wheel); }, out.brakes);
    return out;
}

// One suspension after the other, with everything that channels and the energy balance read.
template <class T>
Momenta<T> momenta_block(const Model<T>& model, const State<T>& state, const Input<T>& input,
                         const Velocity<T>& velocity) {
    return momenta_block_of(model, state, input, velocity);
}

extern template Momenta<double> momenta_block<double>(const Model<double>&, const State<double>&, const Input<double>&,
                                                      const Velocity<double>&);

}  // namespace hamilcar
