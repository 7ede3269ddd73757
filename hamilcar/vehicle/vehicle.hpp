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
                          &V::actuator_place, &V::gravity, &V::total_mass, &V::state_size, &V::commands,
                          &V::is_measured);
    }
    std::vector<SuspensionPair<Paired<T>>> pairs;  // of neighboring suspensions, where T has pairs
    static constexpr auto derived_members() { return std::tuple(&Vehicle::pairs); }

    Vehicle() = default;
    explicit Vehicle(const VehicleDescription& description);

    void add_suspensions(const VehicleDescription& description, const StateLayout& layout);
    void add_powertrain(const VehicleDescription& description, const StateLayout& layout);
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
