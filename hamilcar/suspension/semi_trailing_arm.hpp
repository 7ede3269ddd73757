// Semi-trailing arm (paper, Fig. 4): one hinge with a swept axis, no loop. The arm's angle is the independent
// coordinate, positive in jounce.
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/linkage/line.hpp"
#include "hamilcar/linkage/linkage.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

template <class T>
struct SemiTrailingArm {
    static constexpr std::string_view keyword = "semi_trailing_arm";
    static constexpr std::array<std::string_view, 1> coordinate_names{"arm angle"};
    static constexpr std::array<std::string_view, 0> cut_names{};
    using Linkage = hamilcar::Linkage<T, std::tuple<Revolute<T>>, std::tuple<>, Coordinates<0>, Coordinates<>>;
    Linkage linkage;
    PointLine<T> spring_line, damper_line;
    std::array<double, 1> design{};  // arm angle [rad]
    static constexpr auto members() {
        return std::tuple(&SemiTrailingArm::linkage, &SemiTrailingArm::spring_line, &SemiTrailingArm::damper_line);
    }

    explicit SemiTrailingArm(const SemiTrailingArmDescription& points) {
        const Vec3<double> inner = vec3(points.inner_bush), outer = vec3(points.outer_bush);
        Vec3<double> axis = (outer - inner).normalized();
        if (axis.y() < 0) axis = -axis;  // toward +y on both sides: a positive angle lifts a wheel behind the axis
        linkage.joints = {Revolute<T>{as<T>(outer), as<T>(axis)}};  // the paper's u_41 is -axis (12)
        spring_line = {as<T>(vec3(points.spring_body)), as<T>(vec3(points.spring_arm))};
        damper_line = {as<T>(vec3(points.damper_body)), as<T>(vec3(points.damper_arm))};
    }
    SemiTrailingArm() = default;
};

}  // namespace hamilcar
