// Ice, water, sand, one side of a split-mu road: a rectangle with a factor on the tire's friction.
#pragma once

#include "hamilcar/road/obstacle.hpp"

namespace hamilcar {

struct FrictionPatch {
    SmoothRange along, across;
    double friction = 1;  // [1]

    FrictionPatch() = default;
    explicit FrictionPatch(const FrictionPatchDescription& d)
        : along(d.start, d.end, d.ramp), across(d.right, d.left, d.ramp), friction(d.friction) {}

    // 1 within the patch, 0 outside.
    template <class N>
    N weight(const N& x, const N& y) const {
        return along.weight(x) * across.weight(y);
    }
};

}  // namespace hamilcar
