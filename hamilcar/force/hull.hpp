// The body on the road: points of the hull that push and rub where the car has tipped over. Upright they cost one height
// each. Hunt and Crossley's damping grows with the depth, so a touch begins without a jump.
#pragma once

#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/math/convert.hpp"
#include "hamilcar/road/plane.hpp"

namespace hamilcar {

template <class T>
struct Hull {
    static constexpr double sliding_speed = 0.1;  // below it friction fades like a viscous force [m/s]
    std::vector<Vec3<T>> points;                  // chassis axes [m]
    T stiffness, damping, friction;

    Hull() = default;
    explicit Hull(const HullDescription& d) : stiffness(d.stiffness), damping(d.damping), friction(d.friction) {
        for (const Point& point : d.points) points.push_back(as<T>(vec3(point)));
    }

    static T depth(const RoadPlane<T>& road, const Vec3<T>& point) {
        return max(road.offset - road.normal.dot(point), T(0));
    }

    struct Contact {
        Spatial<T> wrench;  // on the chassis, about its origin
        T lost_power;       // of damping and friction [W]
    };

    // All points together, for the chassis moving with v_1.
    Contact contact(const RoadPlane<T>& road, const Spatial<T>& hub) const {
        Contact sum{Spatial<T>::Zero(), T(0)};
        for (const Vec3<T>& point : points) {
            const T pressed = depth(road, point);
            if (!any(pressed > T(0))) continue;
            const Vec3<T> v = velocity_at<T>(hub, point);
            const T rising = road.normal.dot(v);
            const Vec3<T> slip = v - road.normal * rising;
            const T speed = sqrt(slip.squaredNorm() + T(sliding_speed * sliding_speed));
            const T elastic = stiffness * pressed, normal = elastic * max(T(1) - damping * rising, T(0));
            const Vec3<T> force = road.normal * normal - slip * (friction * road.friction * normal / speed);
            sum.wrench += force_at<T>(point, force);
            sum.lost_power += force.dot(v) - elastic * rising;
        }
        return sum;
    }

    T potential(const RoadPlane<T>& road) const {
        T sum(0);
        for (const Vec3<T>& point : points) {
            const T pressed = depth(road, point);
            sum += T(0.5) * stiffness * pressed * pressed;
        }
        return sum;
    }
};

}  // namespace hamilcar
