// The prescribed motion of the rack.
#pragma once

namespace hamilcar {

// The paper's beta(t) = q17 with its rates [m, m/s, m/s^2].
template <class T>
struct RackMotion {
    T displacement{0}, rate{0}, acceleration{0};
};

}  // namespace hamilcar
