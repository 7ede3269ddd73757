// What the Velocity block may raise.
#pragma once

#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

// Flags of the mathematics, for whoever watches the run: never a throw inside a step.
template <class T>
struct Health {
    T violation{0};  // largest |Phi| of all cut equations [m or m^2]
    T mobility{1};   // smallest det Phi_w relative to design; 0 where a linkage locks, negative beyond

    void include(const Health& other) {
        violation = max(violation, other.violation);
        mobility = min(mobility, other.mobility);
    }
    // A cut equation violated this far no longer holds the car together: about 10 mm at a 0.3 m arm. (`include` may lose a
    // NaN; whoever asks here also asks whether the state is finite.)
    auto comes_apart() const { return !(violation < T(5e-3)); }
    // A linkage whose det Phi_w has fallen to this share of its design value is about to lock.
    auto locks() const { return !(mobility > T(1e-3)); }
};

}  // namespace hamilcar
