// How well the constraints hold, as the Velocity block finds it.
#pragma once

#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

// For the caller to check after a step: nothing throws inside one.
template <class T>
struct Health {
    T violation{0};  // largest |Phi| of all cut equations [m or m^2]
    T mobility{1};   // smallest det Phi_w relative to design; 0 where a linkage locks, negative beyond

    void include(const Health& other) {
        violation = max(violation, other.violation);
        mobility = min(mobility, other.mobility);
    }
    // A cut equation violated this far no longer holds the car together: about 10 mm at a 0.3 m arm. (`include` may lose a
    // NaN, so callers also check that the state is finite.)
    auto loops_open() const { return !(violation < T(5e-3)); }
    // A linkage whose det Phi_w has fallen to this share of its design value is about to lock.
    auto locks() const { return !(mobility > T(1e-3)); }
};

}  // namespace hamilcar
