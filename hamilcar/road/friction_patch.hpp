// Ice, water, sand, one side of a split road: a rectangle in which a factor on the tire's friction holds.
#pragma once

#include "hamilcar/road/obstacle.hpp"

namespace hamilcar {

struct FrictionPatch {
    SmoothRange along, across;
    double friction = 1;  // [1]

    FrictionPatch() = default;
    explicit FrictionPatch(const FrictionPatchDescription& d)
        : along(d.start, d.end, d.ramp), across(d.right, d.left, d.ramp), friction(d.friction) {}

    // How much of the patch there is: 1 within, 0 outside.
    template <class N>
    N weight(const N& x, const N& y) const {
        return along.weight(x) * across.weight(y);
    }
};

}  // namespace hamilcar
