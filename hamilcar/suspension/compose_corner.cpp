#include "hamilcar/suspension/compose_corner.hpp"

#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

namespace {

struct ComposeSuspension {
    ComposedSpokeDescription out;

    void operator()(const MacPhersonDescription& d) {
        Hardpoints points;
        points.points = {{"strut_top_m", d.strut_top},   {"slide_point_m", d.slide_point},
                         {"arm_front_m", d.arm_front},   {"arm_rear_m", d.arm_rear},
                         {"ball_joint_m", d.ball_joint}, {"rack_end_m", d.rack_end},
                         {"rack_axis", d.rack_axis},     {"tie_rod_outer_m", d.tie_rod_outer}};
        points.numbers = {{"steered", d.steered ? 1 : 0}};
        if (d.arm_length) points.numbers["arm_length_m"] = *d.arm_length;
        if (d.tie_rod_length) points.numbers["tie_rod_length_m"] = *d.tie_rod_length;
        take(macpherson_recipe, points);
        LineDescription strut;
        strut.coordinate = 3;
        spring_line = damper_line = strut;
    }
    void operator()(const SemiTrailingArmDescription& d) {
        Hardpoints points;
        points.points = {{"inner_bush_m", d.inner_bush}, {"outer_bush_m", d.outer_bush}};
        take(semi_trailing_arm_recipe, points);
        spring_line = {1, 0, d.spring_arm, d.spring_body, {}};
        damper_line = {1, 0, d.damper_arm, d.damper_body, {}};
    }
    void take(const Recipe& recipe, const Hardpoints& points) {
        const Composition composition = recipe.compose(points);
        out.suspension = recipe.keyword;
        out.linkage = composition.linkage;
        carrier = composition.carriers[0];
    }

    std::size_t carrier = 1;
    LineDescription spring_line, damper_line;
};

}  // namespace

ComposedSpokeDescription compose_corner(const CornerDescription& corner) {
    ComposeSuspension compose;
    std::visit(compose, corner.suspension);
    ComposedSpokeDescription& out = compose.out;
    out.name = corner.name;
    out.bodies = {{compose.carrier, corner.carrier}};
    ComposedWheelDescription wheel;
    wheel.name = corner.name, wheel.part = compose.carrier, wheel.wheel = corner.wheel;
    wheel.bump = corner.bump, wheel.rebound = corner.rebound;
    wheel.tire = corner.tire, wheel.brake = corner.brake, wheel.drive_share = corner.drive_share;
    out.wheels = {wheel};
    out.springs = {{corner.name, compose.spring_line, corner.spring}};
    out.dampers = {{corner.name, compose.damper_line, corner.damper}};
    return out;
}

VehicleDescription composed_throughout(VehicleDescription vehicle) {
    std::vector<ComposedSpokeDescription> spokes;
    for (const CornerDescription& corner : vehicle.corners) spokes.push_back(compose_corner(corner));
    for (ComposedBarDescription& bar : vehicle.composed_bars) {
        bar.left += vehicle.corners.size(), bar.right += vehicle.corners.size();
    }
    for (const AntiRollBarDescription& bar : vehicle.anti_roll_bars) {
        vehicle.composed_bars.push_back({bar.left, bar.right, bar.rate});
    }
    spokes.insert(spokes.end(), vehicle.composed.begin(), vehicle.composed.end());
    vehicle.composed = spokes;
    vehicle.corners.clear(), vehicle.anti_roll_bars.clear();
    return vehicle;
}

}  // namespace hamilcar
