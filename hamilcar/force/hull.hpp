// Contact of the car body with the road: points of the hull with normal force and friction, for a car that has tipped over.
// Hunt-Crossley damping grows with the depth, so a contact begins without a jump.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/math/convert.hpp"
#include "hamilcar/road/plane.hpp"

namespace hamilcar {

template <class T>
struct Hull {
    static constexpr double sliding_speed = 0.1;  // below it friction fades like a viscous force [m/s]
    std::vector<Vec3<T>> points;                  // chassis axes [m]
    Vec3<T> center, half;                         // of the box around them [m]
    T stiffness, damping, friction;
    static constexpr auto members() {
        return std::tuple(&Hull::points, &Hull::center, &Hull::half, &Hull::stiffness, &Hull::damping, &Hull::friction);
    }

    Hull() = default;
    explicit Hull(const HullDescription& d) : stiffness(d.stiffness), damping(d.damping), friction(d.friction) {
        Vec3<double> low = Vec3<double>::Zero(), high = Vec3<double>::Zero();
        for (const Point& point : d.points) {
            const Vec3<double> p = vec3(point);
            low = points.empty() ? p : Vec3<double>(low.cwiseMin(p));
            high = points.empty() ? p : Vec3<double>(high.cwiseMax(p));
            points.push_back(as<T>(p));
        }
        center = as<T>(Vec3<double>(0.5 * (high + low)));
        half = as<T>(Vec3<double>(0.5 * (high - low)));
    }

    static T depth(const TangentPlane<T>& road, const Vec3<T>& point) {
        return max(road.offset - road.normal.dot(point), T(0));
    }

    // Whether the bounding box touches the road, or nearly: the only cost for an upright car. The margin exceeds round-off, so
    // that no point touches the road if the box does not.
    auto may_touch(const TangentPlane<T>& road) const { return clearance(road) < T(1e-3); }
    // Height of the box above the plane [m].
    T clearance(const TangentPlane<T>& road) const {
        const Vec3<T>& n = road.normal;
        return n.dot(center) - (abs(n[0]) * half[0] + abs(n[1]) * half[1] + abs(n[2]) * half[2]) - road.offset;
    }

    struct Contact {
        Spatial<T> wrench;  // on the chassis, about its origin
        T lost_power;       // from damping and friction [W]
    };

    // Sum over all points, for the motion of the chassis; `rise`: velocity of the plane along its normal [m/s].
    Contact contact(const TangentPlane<T>& road, const Spatial<T>& chassis, const T& rise = T(0)) const {
        std::array<T, 7> untouched;
        untouched.fill(T(0));
        const std::array<T, 7> sum = unless(
            may_touch(road), [&] { return untouched; }, [&] { return pressed(road, chassis, rise); });
        Contact out;
        for (std::size_t i = 0; i < 6; ++i) out.wrench[static_cast<Eigen::Index>(i)] = sum[i];
        out.lost_power = sum[6];
        return out;
    }

    T potential(const TangentPlane<T>& road) const {
        T sum(0);
        for (const Vec3<T>& point : points) {
            const T pressed = depth(road, point);
            sum += T(0.5) * stiffness * pressed * pressed;
        }
        return sum;
    }

private:
    // The wrench and the lost power.
    std::array<T, 7> pressed(const TangentPlane<T>& road, const Spatial<T>& chassis, const T& rise) const {
        Contact sum{Spatial<T>::Zero(), T(0)};
        for (const Vec3<T>& point : points) {
            const T pressed = depth(road, point);
            if (!any(pressed > T(0))) continue;
            const Vec3<T> v = velocity_at<T>(chassis, point);
            const T leaving = road.normal.dot(v),
                    rising = leaving - rise;  // relative to the ground, relative to the rising plane
            const Vec3<T> slip = v - road.normal * leaving;
            const T speed = sqrt(slip.squaredNorm() + T(sliding_speed * sliding_speed));
            const T elastic = stiffness * pressed, normal = elastic * max(T(1) - damping * rising, T(0));
            const Vec3<T> force = road.normal * normal - slip * (friction * road.friction * normal / speed);
            sum.wrench += force_at<T>(point, force);
            sum.lost_power += force.dot(v) - elastic * rising;
        }
        std::array<T, 7> out;
        for (std::size_t i = 0; i < 6; ++i) out[i] = sum.wrench[static_cast<Eigen::Index>(i)];
        out[6] = sum.lost_power;
        return out;
    }
};

}  // namespace hamilcar
