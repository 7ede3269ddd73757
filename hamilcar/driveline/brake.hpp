// A wheel's brake: dry friction of the disc on an elastic carrier, behind a proportioning valve.
#pragma once

#include <tuple>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/force/dry_friction.hpp"

namespace hamilcar {

template <class T>
struct Brake {
    T max_torque, stiffness, damping;
    T compliance;                      // 1 / stiffness; zero without a brake
    T valve_command, valve_reduction;  // reduction of the slope above this command
    T parking_torque;                  // that the parking brake holds when fully applied
    int has_parking;
    static constexpr auto members() {
        return std::tuple(&Brake::max_torque, &Brake::stiffness, &Brake::damping, &Brake::compliance,
                          &Brake::valve_command, &Brake::valve_reduction, &Brake::parking_torque, &Brake::has_parking);
    }

    Brake() = default;
    explicit Brake(const BrakeDescription& d)
        : max_torque(d.max_torque),
          stiffness(d.windup_stiffness),
          damping(d.windup_damping),
          compliance(d.windup_stiffness > 0 ? 1 / d.windup_stiffness : 0),
          valve_command(d.valve_command),
          valve_reduction(1 - d.valve_slope),
          parking_torque(d.parking_torque),
          has_parking(d.parking_torque > 0 ? 1 : 0) {}

    // Friction limit where the torque follows the pedal at once [N m].
    T limit(const T& command) const {
        return (command - valve_reduction * max(T(command - valve_command), T(0))) * max_torque;
    }

    // Torque on the wheel about its axis; `limit`: of friction [N m]; `spin`: relative to the carrier.
    typename DryFriction<T>::Output evaluate(const T& limit, const T& spin, const T& windup) const {
        return DryFriction<T>::evaluate(limit, spin, windup, stiffness, damping, compliance);
    }
};

}  // namespace hamilcar
