// The pose of a unit, the motor vehicle or a trailer, and the ground below it.
#pragma once

#include "hamilcar/block/model.hpp"
#include "hamilcar/road/ground.hpp"

namespace hamilcar {

template <class T>
struct UnitPose {
    Vec3<T> position;  // of its origin, ground axes [m]
    Mat3<T> R;         // to ground axes
};

// `plane`: the road's plane as seen from the unit; `storage` holds what an uneven road needs.
template <class T>
UnitGround<T> ground_below(const Model<T>& model, const UnitPose<T>& pose, const TangentPlane<T>& plane, double time,
                           UnevenGround<T>& storage) {
    if (!model.surface) [[likely]]
        return {plane, nullptr};
    storage = {model.surface, model.road.normal, model.road.friction, pose.position, pose.R, time};
    return {plane, &storage};
}

// The ground that the hull may touch: a plane fitted under a patch of the hull's size, below its center.
template <class T>
WheelGround<T> ground_of_hull(const UnitGround<T>& ground, const Hull<T>& hull, const Spatial<T>& motion) {
    if (!ground.uneven) [[likely]]
        return {ground.plane, T(0)};
    constexpr int no_wheel = 1000;  // no post of a rig is below it
    return ground.under(hull.center, Vec3<T>::UnitY(), motion, T(3) * max(hull.half[0], T(0.1)),
                        hull.clearance(ground.plane), {no_wheel, no_wheel});
}

}  // namespace hamilcar
