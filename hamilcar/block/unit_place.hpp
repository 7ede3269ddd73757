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

// Lane by lane what an uneven road is asked with.
template <class T>
[[gnu::noinline]] void stand_on(const Model<T>& model, const UnitPlace<T>& place, double time,
                                UnevenGround<RoadNumber<T>>& ground) {
    static_assert(lane_count<T> <= static_cast<int>(UnevenGround<RoadNumber<T>>::most_lanes));
    ground.count = lane_count<T>;
    for (int l = 0; l < lane_count<T>; ++l) {
        auto& to = ground.lanes[static_cast<std::size_t>(l)];
        to.surface = model.surface.lanes[static_cast<std::size_t>(l)];
        to.friction = detail::road_number(model.road.friction, l);
        to.time = time;
        for (int i = 0; i < 3; ++i) {
            to.base[i] = detail::road_number(model.road.normal[i], l);
            to.position[i] = detail::road_number(place.position[i], l);
            for (int j = 0; j < 3; ++j) to.R(i, j) = detail::road_number(place.R(i, j), l);
        }
    }
}

// `plane`: the road's plane as seen from the unit; `storage` holds what an uneven road needs.
template <class T>
HAMILCAR_CORE GroundBelow<T> ground_below(const Model<T>& model, const UnitPlace<T>& place, const RoadPlane<T>& plane,
                                          double time, UnevenGround<RoadNumber<T>>& storage) {
    if (!model.surface.any) [[likely]]
        return {plane, nullptr};
    stand_on(model, place, time, storage);
    return {plane, &storage};
}

// What the body stands on if it comes down: the plane under a patch of its size, from a point of the chassis in its middle.
template <class T>
HAMILCAR_CORE WheelRoad<T> ground_of_hull(const GroundBelow<T>& ground, const Hull<T>& hull, const Spatial<T>& motion) {
    if (!ground.uneven) [[likely]]
        return {ground.plane, T(0)};
    constexpr int no_wheel = 1000;  // no post carries it
    return ground.under(hull.center, Vec3<T>::UnitY(), motion, T(3) * max(hull.half[0], T(0.1)), {no_wheel, no_wheel});
}

}  // namespace hamilcar
