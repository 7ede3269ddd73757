// A wheel's brake: the grip of its disc on a carrier that gives way a little, behind a valve that may hold pressure back.
#pragma once

#include <tuple>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/driveline/grip.hpp"

namespace hamilcar {

template <class T>
struct Brake {
    T max_torque, stiffness, damping;
    T compliance;                // 1 / stiffness; zero where there is no brake
    T valve_command, held_back;  // share of the growth beyond this command that the valve keeps from the brake
    static constexpr auto members() {
        return std::tuple(&Brake::max_torque, &Brake::stiffness, &Brake::damping, &Brake::compliance,
                          &Brake::valve_command, &Brake::held_back);
    }

    Brake() = default;
    explicit Brake(const BrakeDescription& d)
        : max_torque(d.max_torque),
          stiffness(d.windup_stiffness),
          damping(d.windup_damping),
          compliance(d.windup_stiffness > 0 ? 1 / d.windup_stiffness : 0),
          valve_command(d.valve_command),
          held_back(1 - d.valve_slope) {}

    // What the brake can hold [N m].
    T limit(const T& command) const {
        return (command - held_back * max(T(command - valve_command), T(0))) * max_torque;
    }

    // Torque on the wheel about its axis, turning with `spin` against the carrier.
    typename Grip<T>::Output evaluate(const T& command, const T& spin, const T& windup) const {
        return Grip<T>::evaluate(limit(command), spin, windup, stiffness, damping, compliance);
    }
};

}  // namespace hamilcar
