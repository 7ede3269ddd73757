// From a description to the constants of a car, for any scalar type.
#pragma once

#include <stdexcept>

#include "hamilcar/math/convert.hpp"
#include "hamilcar/vehicle/build_brakes.hpp"
#include "hamilcar/vehicle/build_powertrain.hpp"
#include "hamilcar/vehicle/build_steering.hpp"
#include "hamilcar/vehicle/build_suspension.hpp"
#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

template <class T>
Vehicle<T>::Vehicle(const VehicleDescription& d)
    : chassis(make_body<T>(d.chassis)),
      chassis_inertia(SpatialInertia<T>::about_origin(chassis.mass, chassis.center, chassis.inertia)),
      aerodynamics(d.aerodynamics),
      hull(d.hull),
      brakes(),
      steering(),
      gravity(d.gravity),
      total_mass(chassis.mass) {
    for (const AntiRollBarDescription& bar : d.anti_roll_bars) {
        anti_roll_bars.push_back(
            {static_cast<int>(bar.left), static_cast<int>(bar.right), T(bar.rate), -1, T(bar.max_force)});
    }
    const StateLayout layout(d);
    if (layout.size() > state_capacity)
        throw std::length_error("the vehicle has more coordinates than a state can hold");
    state_size = layout.size();
    add_suspensions(d, layout);
    add_powertrain(d, layout);
    add_brakes(d, layout);
    add_steering(d, layout);
    add_actuators(d, layout);
    is_measured = d.controllers.empty() ? 0 : 1;
}

// Suspensions, then trailers, in the order of the description.
template <class T>
void Vehicle<T>::add_suspensions(const VehicleDescription& d, const StateLayout& layout) {
    if (d.suspensions.size() > std::size_t{max_suspensions} || d.trailers.size() > std::size_t{max_trailers}) {
        throw std::length_error("a vehicle has at most 40 suspensions and 8 trailers");
    }
    int wheel_count = 0;
    for (const SuspensionDescription& suspension : d.suspensions) {
        suspensions.push_back(make_suspension<T>(suspension, layout.suspension(suspensions.size()), wheel_count));
        wheel_count += static_cast<int>(suspension.wheels.size());
        for (const SuspensionBody<T>& body : suspensions.back().bodies) total_mass += body.body.mass;
    }
    for (const TrailerDescription& trailer : d.trailers) {
        trailers.push_back(make_trailer<T>(trailer, layout.trailer(trailers.size())));
        total_mass += trailers.back().chassis.mass;
    }
}

// Rotors spin on their own: their spin inertia is not part of the chassis's.
template <class T>
void Vehicle<T>::add_powertrain(const VehicleDescription& d, const StateLayout& layout) {
    powertrain = make_powertrain<T>(d);
    const StateLayout::PowertrainPlaces& places = layout.powertrain();
    powertrain.differential_place = places.differentials, powertrain.supplied_place = places.supplied;
    powertrain.battery.place = places.battery;
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        PowerUnit<T>& unit = powertrain.units[i];
        unit.place = places.units[i];
        if (!unit.rotor_is_free) continue;
        subtract_rotor(unit.axis, unit.inertia, chassis_inertia.inertia);
        if (unit.shafts.exist()) subtract_rotor(unit.axis, unit.shafts.inertia, chassis_inertia.inertia);
    }
    for (Differential<T>& one : powertrain.differentials) attach_to_axle(one);
}

// A differential whose wheels are those of a live axle sits on that axle.
template <class T>
void Vehicle<T>::attach_to_axle(Differential<T>& one) {
    if (one.outputs[0] < 0 || one.outputs[1] < 0) return;
    const auto place = [&](int output) {
        return locate_wheel(*this, powertrain.wheels[static_cast<std::size_t>(output)]);
    };
    const auto [s, first] = place(one.outputs[0]);
    const auto [other, second] = place(one.outputs[1]);
    Suspension<T>& suspension = suspensions[s];
    const int frame = suspension.wheels[first].reaction;
    if (s != other || frame == 0 || suspension.wheels[second].reaction != frame) return;
    one.on_axle = static_cast<int>(s);
    suspension.shaft_frame = frame, suspension.shaft_axis = one.shaft_axis;
}

template <class T>
void Vehicle<T>::add_brakes(const VehicleDescription& d, const StateLayout& layout) {
    const CommandLayout layout_of_commands(d);
    commands = layout_of_commands.size();
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) powertrain.units[i].command = layout_of_commands.unit(i);
    if (!d.brakes.exists) return;
    brakes = make_brakes<T>(d, layout_of_commands);
    brakes.place = layout.brakes();
}

template <class T>
void Vehicle<T>::add_steering(const VehicleDescription& d, const StateLayout& layout) {
    if (!d.steering.moves_on_its_own()) return;
    steering = make_steering<T>(d.steering);
    steering.place = layout.steering();
}

template <class T>
void Vehicle<T>::add_actuators(const VehicleDescription& d, const StateLayout& layout) {
    const CommandLayout told(d);
    actuator_place = layout.actuators();
    for (const CommandLayout::Actuator& one : told.actuators()) {
        const Command& command = told.commands()[static_cast<std::size_t>(one.command)];
        actuators.push_back({one.command, T(1 / one.response_time), T(command.rest)});
    }
    for (std::size_t s = 0; s < suspensions.size(); ++s) {
        for (std::size_t i = 0; i < suspensions[s].dampers.size(); ++i) {
            suspensions[s].dampers[i].actuator = told.actuator(told.damper(s, i));
        }
    }
    for (std::size_t i = 0; i < anti_roll_bars.size(); ++i) anti_roll_bars[i].actuator = told.actuator(told.bar(i));
    for (std::size_t i = 0; i < d.axle_steers.size(); ++i) {
        const AxleSteerDescription& one = d.axle_steers[i];
        axle_steers.push_back({told.axle_steer(i), layout.axle_steer(i), T(one.travel),
                               T(one.frequency * one.frequency), T(2 * one.damping_ratio * one.frequency)});
    }
    for (std::size_t s = 0; s < suspensions.size(); ++s) {
        const auto& by = d.suspensions[s].steered_by;
        suspensions[s].steered_by = by ? static_cast<int>(*by) : -1;
    }
}

// Compiled once, in vehicle.cpp.
extern template Vehicle<double>::Vehicle(const VehicleDescription&);
extern template void Vehicle<double>::add_suspensions(const VehicleDescription&, const StateLayout&);
extern template void Vehicle<double>::add_powertrain(const VehicleDescription&, const StateLayout&);
extern template void Vehicle<double>::attach_to_axle(Differential<double>&);
extern template void Vehicle<double>::add_brakes(const VehicleDescription&, const StateLayout&);
extern template void Vehicle<double>::add_steering(const VehicleDescription&, const StateLayout&);
extern template void Vehicle<double>::add_actuators(const VehicleDescription&, const StateLayout&);

}  // namespace hamilcar
