// The BMW 323i of the tests, from the numbers of the shipped vehicle (left side given, right side mirrored): bodies,
// hardpoints and the elastic parts. The tires are vertical springs; link lengths come from the hardpoints.
#pragma once

#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar::paper {

inline Hardpoints strut_hardpoints() {
    Hardpoints p;
    p.points = {{"strut_top_m", {-0.1051, 0.4962, 0.795}},   {"slide_point_m", {-0.024, 0.6013, 0.28}},
                {"arm_front_m", {0.0, 0.318, 0.1886}},       {"arm_rear_m", {-0.295, 0.335, 0.1886}},
                {"ball_joint_m", {-0.006, 0.6525, 0.165}},   {"rack_end_m", {0.1069, 0.3247, 0.2132}},
                {"tie_rod_outer_m", {0.1115, 0.6969, 0.19}}, {"rack_axis", {0, 1, 0}}};
    p.numbers = {{"steered", 1}};
    return p;
}

inline Hardpoints arm_hardpoints() {
    Hardpoints p;
    p.points = {{"inner_bush_m", {-2.277, 0.1753, 0.28}}, {"outer_bush_m", {-2.1735, 0.5617, 0.28}},
                {"spring_arm_m", {-2.4924, 0.48, 0.235}}, {"spring_body_m", {-2.48, 0.48, 0.47}},
                {"damper_arm_m", {-2.64, 0.545, 0.24}},   {"damper_body_m", {-2.6, 0.53, 0.7}}};
    return p;
}

// Of a carrier that has no products of inertia, with its wheel.
struct WheelParts {
    BodyDescription carrier;
    WheelDescription wheel;
    double spring_rate, force_at_design, damping;  // [N/m], [N], [N s/m]
};

inline SuspensionDescription suspension(const std::string& name, const Recipe& recipe, const Hardpoints& points,
                                        const WheelParts& parts) {
    const Composition made = recipe.compose(points);
    const std::size_t carrier = made.carriers.at(0);
    SuspensionDescription out;
    out.name = name, out.keyword = recipe.keyword;
    out.linkage = made.linkage;
    out.bodies = {{carrier, parts.carrier}};
    out.wheels.resize(1);
    out.wheels[0].name = name, out.wheels[0].part = carrier;
    out.wheels[0].wheel = parts.wheel;
    out.wheels[0].tire = SpringTireDescription{0.2948, 0.2948, 180000};
    out.springs = {{name, made.spring_line.value(), {parts.spring_rate, parts.force_at_design}}};
    out.dampers = {{name, made.damper_line.value(), {{-1, 1}, {-parts.damping, parts.damping}}}};
    return out;
}

// Left and right.
inline std::vector<SuspensionDescription> axle(const std::string& name, const Recipe& recipe, const Hardpoints& points,
                                               const WheelParts& parts) {
    WheelParts other = parts;
    other.carrier.center_of_mass = mirrored(parts.carrier.center_of_mass);
    other.wheel.center = mirrored(parts.wheel.center);
    const Point e = parts.wheel.spin_axis;
    other.wheel.spin_axis = {-e[0], e[1], -e[2]};
    return {suspension(name + "_left", recipe, points, parts),
            suspension(name + "_right", recipe, points.mirrored_side(), other)};
}

inline VehicleDescription reference_car() {
    const WheelParts front{{35.0, {-0.01, 0.6601, 0.31}, {0.9, 0.38, 0.62}, {}},
                           {{0, 0.7001, 0.28}, {0.002705, 0.999924, 0.012042}, 0.85},
                           26200,
                           2951,
                           2093};
    const WheelParts rear{{39.0, {-2.527, 0.6239, 0.28}, {0.85, 0.4, 1.05}, {}},
                          {{-2.57, 0.6989, 0.28}, {0.002705, 0.99953, 0.030539}, 0.85},
                          40700,
                          3339,
                          1487};
    VehicleDescription car;
    car.name = "BMW 323i (E30-based, five-body model)";
    car.chassis = {1002.0, {-1.1524, 0, 0.6137}, {215.1, 1624.6, 1573.9}, {}};
    car.suspensions = axle("front", *find_recipe("macpherson"), strut_hardpoints(), front);
    for (SuspensionDescription& driven : axle("rear", *find_recipe("semi_trailing_arm"), arm_hardpoints(), rear)) {
        driven.wheels[0].drive_share = 0.5;
        car.suspensions.push_back(driven);
    }
    car.anti_roll_bars = {{0, 1, 3493}, {2, 3, 1320}};
    car.steering = {0.0365, 0.073};
    return car;
}

}  // namespace hamilcar::paper
