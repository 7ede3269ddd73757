// The ground under a wheel. On a plane road it is the road; otherwise it is the plane that best fits the surface under the
// wheel's patch, so that a short obstacle acts before the center is above it and never as a step (docs/models/roads.md).
//
// Everything is evaluated with the wheel's velocity, so the rate at which the plane rises under the wheel's lowest point is
// exact, and with it the tire's damper and the energy balance. Positions are relative to the unit's origin, which avoids small
// differences of large numbers far from the start of the road, also in single precision.
#pragma once

#include "hamilcar/math/paired.hpp"
#include "hamilcar/math/spatial.hpp"
#include "hamilcar/road/plane.hpp"
#include "hamilcar/road/surface.hpp"

namespace hamilcar {

// The ground under one wheel.
template <class T>
struct WheelGround {
    TangentPlane<T> plane;
    T rise;  // of the plane, along its normal, under the wheel's lowest point [m/s]
};

// Motion of a wheel in ground axes, relative to its unit's origin.
template <class T>
struct WheelOverGround {
    Vec3<T> center, velocity;  // [m, m/s]
    Vec3<T> axis, axis_rate;   // unit, [1/s]
    T radius;                  // [m]
};

// A point of the ground and how it moves with the wheel.
template <class T>
struct MovingPoint {
    Vec3<T> place, rate;  // [m, m/s]
};

// Projection of the wheel's center onto the road's plane; `offset`: of that plane.
template <class T>
MovingPoint<T> foot_on_plane(const WheelOverGround<T>& wheel, const Vec3<T>& normal, const T& offset) {
    return {wheel.center - normal * (normal.dot(wheel.center) - offset),
            wheel.velocity - normal * normal.dot(wheel.velocity)};
}

template <class T>
PatchPose<T> patch_below(const WheelOverGround<T>& wheel, const MovingPoint<T>& foot, const Vec3<T>& unit,
                         const T& clearance) {
    const Vec3<T>& e = wheel.axis;
    const Vec3<T>& e_rate = wheel.axis_rate;
    const T scale = T(1) / sqrt(max(e[0] * e[0] + e[1] * e[1], T(1e-6)));
    const T ahead_x = e[1] * scale, ahead_y = -e[0] * scale;
    const T shrinking = scale * scale * (e[0] * e_rate[0] + e[1] * e_rate[1]);
    return {.unit_x = unit[0],
            .unit_y = unit[1],
            .x = foot.place[0],
            .y = foot.place[1],
            .x_rate = foot.rate[0],
            .y_rate = foot.rate[1],
            .ahead_x = ahead_x,
            .ahead_y = ahead_y,
            .ahead_x_rate = e_rate[1] * scale - ahead_x * shrinking,
            .ahead_y_rate = -e_rate[0] * scale - ahead_y * shrinking,
            .radius = wheel.radius,
            .clearance = clearance};
}

// The fitted plane with its rise, in ground axes relative to the unit's origin; `normal`: of the road's plane.
template <class T>
WheelGround<T> fitted_road(const WheelOverGround<T>& wheel, const MovingPoint<T>& foot, const Vec3<T>& normal,
                           const PatchPose<T>& at, const PatchPlane<T>& fit) {
    const T gradient_x = fit.ahead * at.ahead_x - fit.left * at.ahead_y - normal[0] / normal[2];
    const T gradient_y = fit.ahead * at.ahead_y + fit.left * at.ahead_x - normal[1] / normal[2];
    const T scale = T(1) / sqrt(gradient_x * gradient_x + gradient_y * gradient_y + T(1));
    const Vec3<T> n(-gradient_x * scale, -gradient_y * scale, scale);
    const Vec3<T> tilting(  // rate of the normal, before normalization
        scale * (fit.left_rate * at.ahead_y + fit.left * at.ahead_y_rate - fit.ahead_rate * at.ahead_x -
                 fit.ahead * at.ahead_x_rate),
        -scale * (fit.left_rate * at.ahead_x + fit.left * at.ahead_x_rate + fit.ahead_rate * at.ahead_y +
                  fit.ahead * at.ahead_y_rate),
        T(0));
    const Vec3<T> up(T(0), T(0), T(1));
    const Vec3<T> middle = foot.place + up * fit.height, middle_rate = foot.rate + up * fit.height_rate;
    const T s = n.dot(wheel.axis), c = sqrt(max(T(1) - s * s, T(1e-6)));
    const Vec3<T> lowest = wheel.center - (n - wheel.axis * s) * (wheel.radius / c);
    const Vec3<T> arm = middle - lowest;
    return {{n, n.dot(middle), fit.friction}, tilting.dot(arm) - n.dot(tilting) * n.dot(arm) + n.dot(middle_rate)};
}

// The position of a vehicle unit above an uneven surface.
template <class T>
struct UnevenGround {
    const Surface* surface;
    Vec3<T> base;      // normal of the plane, ground axes
    T friction;        // factor of the plane
    Vec3<T> position;  // of the unit's origin
    Mat3<T> R;         // to ground axes
    double time;       // [s]
};

// The plane under the wheel with that index.
template <class T>
PatchPlane<T> query_surface(const Surface* surface, double time, const PatchPose<T>& place,
                            const std::array<int, 2>& numbers) {
    return surface->under(place, numbers[0], time);
}

// The plane that best fits the surface under a wheel, in chassis axes. `numbers`: the wheel's index. If the `clearance` [m] above
// the plane road exceeds the maximum height of the surface, `road` is left unchanged. S holds one wheel, or two side by side.
template <class S, class T>
void fit_ground(const UnevenGround<T>& uneven, const Vec3<S>& center, const Vec3<S>& axis, const Spatial<S>& motion,
                const S& radius, const S& clearance, const std::array<int, 2>& numbers, WheelGround<S>& road) {
    const Mat3<S> R = in_both<S>(uneven.R);
    const Vec3<S> base = in_both<S>(uneven.base);
    const WheelOverGround<S> wheel{R * center, R * velocity_at<S>(motion, center), R * axis,
                                   R * angular(motion).cross(axis), radius};
    const MovingPoint<S> foot = foot_on_plane<S>(wheel, base, road.plane.offset);
    const PatchPose<S> place = patch_below<S>(wheel, foot, in_both<S>(uneven.position), clearance);
    const PatchPlane<S> fit = query_surface(uneven.surface, uneven.time, place, numbers);
    const WheelGround<S> found = fitted_road<S>(wheel, foot, base, place, fit);
    const auto there = fit.found > S(0);
    const Vec3<S> normal = R.transpose() * found.plane.normal;
    for (int i = 0; i < 3; ++i) road.plane.normal[i] = select(there, normal[i], road.plane.normal[i]);
    road.plane.offset = select(there, found.plane.offset, road.plane.offset);
    road.plane.friction = select(there, S(uneven.friction) * found.plane.friction, road.plane.friction);
    road.rise = select(there, found.rise, road.rise);
}

// The ground below one unit's wheels.
template <class T>
struct UnitGround {
    TangentPlane<T> plane;
    const UnevenGround<Element<T>>* uneven;  // null where the road is a plane

    // Under a wheel with tire radius `radius` and carrier motion `motion`, in chassis axes. `clearance`: minimum height above the
    // plane at which the surface can matter [m]. `numbers`: indices of the wheels side by side in T; only the first if T holds one.
    WheelGround<T> under(const Vec3<T>& center, const Vec3<T>& axis, const Spatial<T>& motion, const T& radius,
                         const T& clearance, const std::array<int, 2>& numbers) const {
        WheelGround<T> road{plane, T(0)};
        if (uneven) [[unlikely]]
            fit_ground<T>(*uneven, center, axis, motion, radius, clearance, numbers, road);
        return road;
    }
};

}  // namespace hamilcar
