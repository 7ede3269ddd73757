// The ground under a wheel. On a plane road it is the road; on any other it is the plane that fits the surface best under the
// wheel's patch, so that a short obstacle is felt before the center is above it and never as a step (docs/models/roads.md).
//
// Heights are taken at five stations along the wheel's heading, on two lines abreast, weighted like a raised cosine:
//
//     mean   z = sum w h,   slope ahead = sum w a h / sum w a^2,   slope aside = (left - right) / (2 b)
// All of it is evaluated with the wheel's velocity as a derivative, so the rate at which the plane itself rises under the
// wheel's lowest point is exact, and with it the damper in the tire and the energy balance.
#pragma once

#include "hamilcar/math/dual.hpp"
#include "hamilcar/math/spatial.hpp"
#include "hamilcar/road/plane.hpp"
#include "hamilcar/road/surface.hpp"

namespace hamilcar {

// What the ground is evaluated in: the number itself, and never in single precision, which 300 m from the origin would
// know a height over ground to no better than 0.03 mm.
template <class T>
using RoadNumber = std::conditional_t<std::is_same_v<Element<T>, float>, double, Element<T>>;

// A wheel in ground axes.
template <class E>
struct WheelAbove {
    Vec3<E> center, velocity;  // [m, m/s]
    Vec3<E> axis, axis_rate;   // unit, [1/s]
    E radius;                  // [m]
    int number;                // in the vehicle's order, for posts
};

// The plane under it, in ground axes.
template <class E>
struct FittedPlane {
    Vec3<E> normal;
    E offset;    // [m]
    E friction;  // factor [1]
    E rise;      // of the plane, along its normal, under the wheel's lowest point [m/s]
};

// The shape of the patch, in radii of the wheel.
struct Patch {
    static constexpr double half_length = 1.0 / 3, half_width = 0.25;
    static constexpr std::array<double, 5> stations{-1, -0.5, 0, 0.5, 1};
    static constexpr std::array<double, 5> weights{1.0 / 12, 3.0 / 12, 4.0 / 12, 3.0 / 12, 1.0 / 12};
    static constexpr std::size_t points = 2 * stations.size();  // first the right line, then the left one
    static constexpr double station(std::size_t point) { return stations[point % stations.size()]; }
    static constexpr double side(std::size_t point) { return point < stations.size() ? -1 : 1; }
    static constexpr double weight(std::size_t point) { return 0.5 * weights[point % stations.size()]; }
    static constexpr double second_moment = 2.0 / 12 * 1 + 6.0 / 12 * 0.25;  // sum of w a^2
};

template <class E>
FittedPlane<E> fit_plane(const Surface& surface, const Vec3<E>& base, const E& base_friction,
                         const WheelAbove<E>& wheel, double time) {
    using D = Dual<E, 1>;  // value and rate
    const auto moving = [](const E& value, const E& rate) { return D(value, std::array<E, 1>{rate}); };
    const auto scaled = [&](const D& number, const E& by) {
        return moving(number.value() * by, number.partial(0) * by);
    };
    Vec3<D> center, axis, n0;
    for (int i = 0; i < 3; ++i) {
        center[i] = moving(wheel.center[i], wheel.velocity[i]);
        axis[i] = moving(wheel.axis[i], wheel.axis_rate[i]);
        n0[i] = D(base[i]);
    }
    const Vec3<D> foot = center - n0 * n0.dot(center);
    const D scale = D(1) / sqrt(max(axis[0] * axis[0] + axis[1] * axis[1], D(1e-6)));
    const D ahead_x = axis[1] * scale, ahead_y = -axis[0] * scale;  // heading; to the left of it (-ahead_y, ahead_x)
    const E a = wheel.radius * E(Patch::half_length), b = wheel.radius * E(Patch::half_width);
    std::array<D, Patch::points> x, y;
    for (std::size_t p = 0; p < Patch::points; ++p) {
        const E along = a * E(Patch::station(p)), beside = b * E(Patch::side(p));
        x[p] = foot[0] + scaled(ahead_x, along) - scaled(ahead_y, beside);
        y[p] = foot[1] + scaled(ahead_y, along) + scaled(ahead_x, beside);
    }
    const std::array<D, Patch::points> height = surface.heights(x, y);
    D mean(0), ahead(0), aside(0);  // ahead and aside over a and b
    E friction(surface.has_patches() ? 0 : 1);
    for (std::size_t p = 0; p < Patch::points; ++p) {
        const double weight = Patch::weight(p);
        mean += scaled(height[p], E(weight));
        ahead += scaled(height[p], E(weight * Patch::station(p)));
        aside += scaled(height[p], E(weight * Patch::side(p)));
        if (surface.has_patches()) friction += E(weight) * E(surface.friction(value_of(x[p]), value_of(y[p])));
    }
    const SignalValue<double> post = surface.post(wheel.number, time);
    mean += foot[2] + moving(E(post.value), E(post.rate));
    const E plane_x = -base[0] / base[2], plane_y = -base[1] / base[2];  // slopes of the plane below it all
    const D slope =
        scaled(ahead, E(1 / Patch::second_moment) / a) + scaled(ahead_x, plane_x) + scaled(ahead_y, plane_y);
    const D bank = scaled(aside, E(1) / b) - scaled(ahead_y, plane_x) + scaled(ahead_x, plane_y);
    Vec3<D> normal(-slope * ahead_x + bank * ahead_y, -slope * ahead_y - bank * ahead_x, D(1));
    const D inverse_length = D(1) / sqrt(normal[0] * normal[0] + normal[1] * normal[1] + D(1));
    for (int i = 0; i < 3; ++i) normal[i] = normal[i] * inverse_length;
    const D offset = normal[0] * foot[0] + normal[1] * foot[1] + normal[2] * mean;

    FittedPlane<E> out;
    for (int i = 0; i < 3; ++i) out.normal[i] = normal[i].value();
    out.offset = offset.value();
    out.friction = base_friction * friction;
    const E s = out.normal.dot(wheel.axis), c = sqrt(max(E(1) - s * s, E(1e-6)));
    const Vec3<E> lowest = wheel.center - (out.normal - wheel.axis * s) * (wheel.radius / c);
    out.rise = offset.partial(0);
    for (int i = 0; i < 3; ++i) out.rise -= normal[i].partial(0) * lowest[i];
    return out;
}

// A unit of a car above an uneven surface.
template <class E>
struct UnevenGround {
    const Surface* surface;
    Vec3<E> base;      // normal of the plane, ground axes
    E friction;        // factor of the plane
    Vec3<E> position;  // of the unit's origin
    Mat3<E> R;         // to ground axes
    double time;       // [s]
    UnevenGround() {}
    UnevenGround(const Surface* below, const Vec3<E>& normal, const E& factor, const Vec3<E>& origin,
                 const Mat3<E>& turn, double now)
        : surface(below), base(normal), friction(factor), position(origin), R(turn), time(now) {}
};

// What a tire is told of the ground.
template <class T>
struct WheelRoad {
    RoadPlane<T> plane;
    T rise;  // of the plane, along its normal, under the wheel's lowest point [m/s]
};

// The plane that fits the surface best under a wheel; chassis axes. `numbers`: the wheel's. What is higher above the plane
// road than the surface ever gets, `clearance` [m], keeps the plane that `road` is.
template <class T>
void fit_ground(const UnevenGround<RoadNumber<T>>& uneven, const Vec3<T>& center, const Vec3<T>& axis,
                const Spatial<T>& motion, const T& radius, const T& clearance, const std::array<int, 2>& numbers,
                WheelRoad<T>& road) {
    using E = RoadNumber<T>;
    if (value_of(clearance) > uneven.surface->highest()) return;
    const Vec3<T> velocity = velocity_at<T>(motion, center), axis_rate = angular(motion).cross(axis);
    const auto ground = [&](const Vec3<T>& v) -> Vec3<E> {
        return uneven.R * Vec3<E>(static_cast<E>(v[0]), static_cast<E>(v[1]), static_cast<E>(v[2]));
    };
    const FittedPlane<E> found = fit_plane<E>(*uneven.surface, uneven.base, uneven.friction,
                                              {uneven.position + ground(center), ground(velocity), ground(axis),
                                               ground(axis_rate), static_cast<E>(radius), numbers[0]},
                                              uneven.time);
    const Vec3<E> normal = uneven.R.transpose() * found.normal;
    for (int i = 0; i < 3; ++i) road.plane.normal[i] = static_cast<T>(normal[i]);
    road.plane.offset = static_cast<T>(found.offset - found.normal.dot(uneven.position));
    road.plane.friction = static_cast<T>(found.friction);
    road.rise = static_cast<T>(found.rise);
}

// The ground below one unit's wheels.
template <class T>
struct GroundBelow {
    RoadPlane<T> plane;
    const UnevenGround<RoadNumber<T>>* uneven;  // null where the road is a plane

    // Under a wheel with tire radius `radius`, its carrier moving with `motion`; chassis axes. `clearance`: at least so far
    // above the plane is all that asks [m]. `numbers`: of the wheels side by side in T, the first alone where there is one.
    WheelRoad<T> under(const Vec3<T>& center, const Vec3<T>& axis, const Spatial<T>& motion, const T& radius,
                       const T& clearance, const std::array<int, 2>& numbers) const {
        WheelRoad<T> road{plane, T(0)};
        if (uneven) [[unlikely]]
            fit_ground(*uneven, center, axis, motion, radius, clearance, numbers, road);
        return road;
    }
};

}  // namespace hamilcar
