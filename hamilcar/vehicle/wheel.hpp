// A wheel spins about an axis of its carrier; only its spin inertia is its own, the rest is part of the carrier.
#pragma once

#include <tuple>

#include "hamilcar/math/eigen.hpp"

namespace hamilcar {

template <class T>
struct Wheel {
    Vec3<T> center, axis;  // at design [m], unit
    T spin_inertia;        // [kg m^2]
    T inverse_spin_inertia;
    static constexpr auto members() {
        return std::tuple(&Wheel::center, &Wheel::axis, &Wheel::spin_inertia, &Wheel::inverse_spin_inertia);
    }
};

}  // namespace hamilcar
