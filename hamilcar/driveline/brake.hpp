// A wheel's brake: the grip of its disc on a carrier that gives way a little.
#pragma once

#include <tuple>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/driveline/grip.hpp"

namespace hamilcar {

template <class T>
struct Brake {
    T max_torque, stiffness, damping;
    T compliance;  // 1 / stiffness; zero where there is no brake
    static constexpr auto members() {
        return std::tuple(&Brake::max_torque, &Brake::stiffness, &Brake::damping, &Brake::compliance);
    }

    Brake() = default;
    explicit Brake(const BrakeDescription& d)
        : max_torque(d.max_torque),
          stiffness(d.windup_stiffness),
          damping(d.windup_damping),
          compliance(d.windup_stiffness > 0 ? 1 / d.windup_stiffness : 0) {}

    // Torque on the wheel about its axis, turning with `spin` against the carrier.
    HAMILCAR_CORE typename Grip<T>::Output evaluate(const T& command, const T& spin, const T& windup) const {
        return Grip<T>::evaluate(command * max_torque, spin, windup, stiffness, damping, compliance);
    }
};

}  // namespace hamilcar
