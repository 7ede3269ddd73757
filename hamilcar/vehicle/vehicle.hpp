// The constants of a car: its chassis, suspensions with everything attached to them, trailers. Built once from a description,
// never changed by a step.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "hamilcar/driveline/brake_system.hpp"
#include "hamilcar/driveline/powertrain.hpp"
#include "hamilcar/force/aerodynamics.hpp"
#include "hamilcar/force/hull.hpp"
#include "hamilcar/math/gather.hpp"
#include "hamilcar/math/paired.hpp"
#include "hamilcar/steering/steering_system.hpp"
#include "hamilcar/tire/list.hpp"
#include "hamilcar/vehicle/state_layout.hpp"
#include "hamilcar/vehicle/suspension.hpp"

namespace hamilcar {

template <class T>
struct AntiRollBar {
    int left, right;  // wheels
    T rate;           // of the difference of their travels [N/m], or of the angles of the bar's arms [N m/rad]
    int actuator;     // of the share of its own force; -1: it has none
    T max_force;      // [N]
    static constexpr auto members() {
        using B = AntiRollBar;
        return std::tuple(&B::left, &B::right, &B::rate, &B::actuator, &B::max_force);
    }
};

// Follows a command with a lag.
template <class T>
struct Actuator {
    int command;
    T rate, rest;  // [1/s]; where there are no commands
    static constexpr auto members() { return std::tuple(&Actuator::command, &Actuator::rate, &Actuator::rest); }
};

// Moves the rack of an axle that the steering wheel does not move: follows a command with the lag of a damped oscillator, so that the
// rack's rate is continuous whatever the command does.
//
//     s = travel x,   x'' = stiffness (command - x) - damping x'
template <class T>
struct AxleSteer {
    int command;           // -1: it takes none, and rests
    int place;             // in a state: x, x'
    T travel;              // [m]
    T stiffness, damping;  // [1/s^2], [1/s]
    static constexpr auto members() {
        using A = AxleSteer;
        return std::tuple(&A::command, &A::place, &A::travel, &A::stiffness, &A::damping);
    }

    RackMotion<T> motion(const T* values, const T* commands) const {
        const T &x = values[place], &rate = values[place + 1];
        const T target = commands && command >= 0 ? commands[command] : T(0);
        return {travel * x, travel * rate, travel * (stiffness * (target - x) - damping * rate)};
    }
    // As a prescribed rack moves: its rate and acceleration.
    void write_rates(const RackMotion<T>& motion, T* rates) const {
        rates[place] = motion.rate / travel, rates[place + 1] = motion.acceleration / travel;
    }
};

template <class T>
struct Vehicle {
    RigidBody<T> chassis;
    SpatialInertia<T> chassis_inertia;  // about the vehicle origin
    std::vector<Suspension<T>> suspensions;
    std::vector<AntiRollBar<T>> anti_roll_bars;
    std::vector<Trailer<T>> trailers;
    Aerodynamics<T> aerodynamics;
    Hull<T> hull;
    Powertrain<T> powertrain;
    BrakeSystem<T> brakes;
    SteeringSystem<T> steering;  // exists where the rack moves on its own
    std::vector<Actuator<T>> actuators;
    std::vector<AxleSteer<T>> axle_steers;
    int actuator_place = 0;  // of the first one's number in a state
    T gravity;               // [m/s^2]
    T total_mass;            // of everything [kg]
    int state_size;
    int commands;     // that its actuators take (command_layout.hpp)
    int is_measured;  // whether its right-hand side reports what sensors read (block/measurement.hpp)
    static constexpr auto members() {
        using V = Vehicle;
        return std::tuple(&V::chassis, &V::chassis_inertia, &V::suspensions, &V::anti_roll_bars, &V::trailers,
                          &V::aerodynamics, &V::hull, &V::powertrain, &V::brakes, &V::steering, &V::actuators,
                          &V::axle_steers, &V::actuator_place, &V::gravity, &V::total_mass, &V::state_size,
                          &V::commands, &V::is_measured);
    }
    std::vector<SuspensionPair<Paired<T>>> pairs;  // of neighboring suspensions, where T has pairs
    static constexpr auto derived_members() { return std::tuple(&Vehicle::pairs); }

    Vehicle() = default;
    explicit Vehicle(const VehicleDescription& description);

    void add_suspensions(const VehicleDescription& description, const StateLayout& layout);
    void add_powertrain(const VehicleDescription& description, const StateLayout& layout);
    void attach_to_axle(Differential<T>& differential);
    void add_brakes(const VehicleDescription& description, const StateLayout& layout);
    void add_steering(const VehicleDescription& description, const StateLayout& layout);
    void add_actuators(const VehicleDescription& description, const StateLayout& layout);

    // Calls alone(index) for each single suspension and together(pair, its index) for each pair.
    template <class Alone, class Together>
    void for_each_suspension(const Alone& alone, const Together& together) const {
        std::size_t next_pair = 0;
        for (std::size_t s = 0; s < suspensions.size(); ++s) {
            if constexpr (has_pairs<T>) {
                if (next_pair < pairs.size() && pairs[next_pair].first == static_cast<int>(s)) {
                    together(pairs[next_pair], next_pair);
                    ++next_pair, ++s;
                    continue;
                }
            }
            alone(s);
        }
    }
};

// The rack that moves a suspension, where it stands; its rates count for nothing. `rack`: that of the steering wheel.
template <class T>
RackMotion<T> rack_at(const Vehicle<T>& vehicle, const Suspension<T>& suspension, const RackMotion<T>& rack,
                      const T* values) {
    if (suspension.steered_by < 0) return rack;
    const AxleSteer<T>& own = vehicle.axle_steers[static_cast<std::size_t>(suspension.steered_by)];
    return {own.travel * values[own.place], T(0), T(0)};
}

// Sizes of a state (state_layout.hpp): of the chassis, and of all at most.
inline constexpr int chassis_size = 14;
inline constexpr int beyond_chassis_capacity = 640;
inline constexpr int state_capacity = chassis_size + beyond_chassis_capacity;

// A wheel by its number: the suspension, and the wheel's index in it.
template <class T>
std::array<std::size_t, 2> locate_wheel(const Vehicle<T>& vehicle, int number) {
    std::size_t s = 0;
    while (s + 1 < vehicle.suspensions.size() && vehicle.suspensions[s + 1].first_wheel <= number) ++s;
    return {s, static_cast<std::size_t>(number - vehicle.suspensions[s].first_wheel)};
}

}  // namespace hamilcar

#include "hamilcar/vehicle/build.hpp"
