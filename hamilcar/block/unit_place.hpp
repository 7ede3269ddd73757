// Where a unit, the motor vehicle or a trailer, stands on the ground, and what lies below it.
#pragma once

#include "hamilcar/block/model.hpp"
#include "hamilcar/road/ground.hpp"

namespace hamilcar {

template <class T>
struct UnitPlace {
    Vec3<T> position;  // of its origin, ground axes [m]
    Mat3<T> R;         // to ground axes
};

// `plane`: the road's plane as seen from the unit; `storage` holds what an uneven road needs.
template <class T>
GroundBelow<T> ground_below(const Model<T>& model, const UnitPlace<T>& place, const RoadPlane<T>& plane, double time,
                            UnevenGround<T>& storage) {
    if (!model.surface) [[likely]]
        return {plane, nullptr};
    storage = {model.surface, model.road.normal, model.road.friction, place.position, place.R, time};
    return {plane, &storage};
}

// What the body stands on if it comes down: the plane under a patch of its size, from a point of the chassis in its middle.
template <class T>
WheelRoad<T> ground_of_hull(const GroundBelow<T>& ground, const Hull<T>& hull, const Spatial<T>& motion) {
    if (!ground.uneven) [[likely]]
        return {ground.plane, T(0)};
    constexpr int no_wheel = 1000;  // no post carries it
    return ground.under(hull.center, Vec3<T>::UnitY(), motion, T(3) * max(hull.half[0], T(0.1)),
                        hull.clearance(ground.plane), {no_wheel, no_wheel});
}

}  // namespace hamilcar
