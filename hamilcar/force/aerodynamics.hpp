// Aerodynamic loads on the chassis: drag, side force, lift at both axles and a yaw moment, from the relative flow.
//
//     v = velocity of the chassis's reference point less the wind's, q = rho |v| / 2
//     F_x = -q A_d v_x,  F_y = -q A_s v_y,  F_z = -q A_d v_z + q |v| (A_front + A_rear)
//     N_y = -q |v| (A_front x_front + A_rear x_rear), about the center of pressure's place,  N_z = -q V v_y
#pragma once

#include <tuple>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

template <class T>
struct Aerodynamics {
    T drag, side;    // rho A / 2 [kg/m]
    T lift;          // of both axles [kg/m]
    T pitch;         // moment of the lift about `center`, likewise [kg]
    T yaw;           // rho V / 2 [kg]
    Vec3<T> center;  // [m]
    static constexpr auto members() {
        using A = Aerodynamics;
        return std::tuple(&A::drag, &A::side, &A::lift, &A::pitch, &A::yaw, &A::center);
    }

    Aerodynamics() = default;
    explicit Aerodynamics(const AerodynamicsDescription& d) : center(as<T>(vec3(d.center))) {
        const double half = 0.5 * d.air_density;
        drag = T(half * d.drag_area), side = T(half * d.side_area.value_or(d.drag_area));
        lift = T(half * (d.lift_area[0] + d.lift_area[1]));
        pitch = T(-half * (d.lift_area[0] * (d.lift_place[0] - d.center[0]) +
                           d.lift_area[1] * (d.lift_place[1] - d.center[0])));
        yaw = T(half * d.yaw_volume);
    }

    struct Output {
        Spatial<T> wrench;  // on the chassis, about its origin
        T power;            // of the wrench on the moving chassis [W]
    };
    // `chassis`: its motion; `wind`: velocity of the air, chassis axes [m/s].
    Output evaluate(const Spatial<T>& chassis, const Vec3<T>& wind) const {
        const Vec3<T> v = velocity_at<T>(chassis, center);
        const Vec3<T> flow = v - wind;
        const T speed = sqrt(flow.squaredNorm());
        const T squared = speed * speed;
        const Vec3<T> force(flow[0] * (-drag * speed), flow[1] * (-side * speed),
                            flow[2] * (-drag * speed) + lift * squared);
        Spatial<T> wrench = force_at<T>(center, force);
        const Vec3<T> moment(T(0), pitch * squared, -yaw * speed * flow[1]);
        angular(wrench) += moment;
        return {wrench, force.dot(v) + moment.dot(angular(chassis))};
    }
};

}  // namespace hamilcar
