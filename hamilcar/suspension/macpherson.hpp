// MacPherson strut (paper, Figs. 3, 7, 8): the spindle hangs on a ball at the strut's top and slides along the strut;
// a massless control arm and a tie rod close two loops. The strut's length is the independent coordinate: it determines
// the wheel's travel over the whole stroke, while the three angles of the ball follow from the three cut equations.
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/linkage/line.hpp"
#include "hamilcar/linkage/linkage.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

template <class T>
struct MacPherson {
    static constexpr std::string_view keyword = "macpherson";
    static constexpr std::array<std::string_view, 4> coordinate_names{"strut angle x", "strut angle y", "strut angle z",
                                                                      "strut length"};
    static constexpr std::array<std::string_view, 2> cut_names{"control arm", "tie rod"};
    // q1, q2, q3 dependent, q4 independent (paper, section 3.3)
    using Linkage =
        hamilcar::Linkage<T, std::tuple<BryantSpherical<T>, Prismatic<T>>,
                          std::tuple<RevoluteSpherical<T>, Distance<T>>, Coordinates<3>, Coordinates<0, 1, 2>>;
    Linkage linkage;
    CoordinateLine<T, 0> spring_line, damper_line;
    std::array<double, 1> design{};  // independent coordinates at design: the strut length [m]
    static constexpr auto members() { return std::tuple(&MacPherson::linkage); }

    explicit MacPherson(const MacPhersonDescription& points) {
        const Vec3<double> top = vec3(points.strut_top), h = top - vec3(points.slide_point);
        const Vec3<double> tip = vec3(points.ball_joint), front = vec3(points.arm_front);
        const Vec3<double> u = (vec3(points.arm_rear) - front).normalized();
        const Vec3<double> foot = front + u * u.dot(tip - front);
        const Vec3<double> inner = vec3(points.rack_end), outer = vec3(points.tie_rod_outer);
        const Vec3<double> rack_axis =
            points.steered ? Vec3<double>(vec3(points.rack_axis).normalized()) : Vec3<double>::Zero();
        design = {h.norm()};
        linkage.joints = {BryantSpherical<T>{as<T>(top)},
                          Prismatic<T>{as<T>(Vec3<double>(-h.normalized())), T(design[0])}};  // (7), (8)
        linkage.cuts = {
            RevoluteSpherical<T>{as<T>(foot), as<T>(u), as<T>(tip), T(points.arm_length.value_or((tip - foot).norm()))},
            Distance<T>{as<T>(inner), as<T>(outer), as<T>(rack_axis),
                        T(points.tie_rod_length.value_or((outer - inner).norm()))}};
    }
    MacPherson() = default;
};

}  // namespace hamilcar
