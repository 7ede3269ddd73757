// The corners that have a program of their own: MacPherson struts and semi-trailing arms.
#include "hamilcar/io/axle_file.hpp"

#include "hamilcar/io/body_file.hpp"
#include "hamilcar/io/composed_axle_file.hpp"
#include "hamilcar/io/kind.hpp"
#include "hamilcar/suspension/list.hpp"

namespace hamilcar::io {

namespace {

// Two hardpoints that a part spans: no part has the length zero.
void expect_apart(const TableReader& points, std::string_view one, const Point& a, std::string_view other,
                  const Point& b) {
    points.expect(a != b, other, "a point apart from '" + std::string(one) + "'");
}

std::optional<double> optional_length(const TableReader& points, std::string_view key) {
    if (!points.has(key)) return {};
    return points.number(key, positive);
}

SuspensionDescription read_macpherson(const TableReader& points) {
    const MacPhersonDescription strut{.strut_top = points.array<3>("strut_top_m"),
                                      .slide_point = points.array<3>("slide_point_m"),
                                      .arm_front = points.array<3>("arm_front_m"),
                                      .arm_rear = points.array<3>("arm_rear_m"),
                                      .ball_joint = points.array<3>("ball_joint_m"),
                                      .rack_end = points.array<3>("rack_end_m"),
                                      .tie_rod_outer = points.array<3>("tie_rod_outer_m"),
                                      .rack_axis = points.unit_direction("rack_axis", {0, 1, 0}),
                                      .steered = points.boolean("steered", true),
                                      .arm_length = optional_length(points, "arm_length_m"),
                                      .tie_rod_length = optional_length(points, "tie_rod_length_m")};
    expect_apart(points, "strut_top_m", strut.strut_top, "slide_point_m", strut.slide_point);
    expect_apart(points, "arm_front_m", strut.arm_front, "arm_rear_m", strut.arm_rear);
    expect_apart(points, "rack_end_m", strut.rack_end, "tie_rod_outer_m", strut.tie_rod_outer);
    return strut;
}

SuspensionDescription read_semi_trailing_arm(const TableReader& points) {
    const SemiTrailingArmDescription arm{.inner_bush = points.array<3>("inner_bush_m"),
                                         .outer_bush = points.array<3>("outer_bush_m"),
                                         .spring_arm = points.array<3>("spring_arm_m"),
                                         .spring_body = points.array<3>("spring_body_m"),
                                         .damper_arm = points.array<3>("damper_arm_m"),
                                         .damper_body = points.array<3>("damper_body_m")};
    expect_apart(points, "inner_bush_m", arm.inner_bush, "outer_bush_m", arm.outer_bush);
    expect_apart(points, "spring_arm_m", arm.spring_arm, "spring_body_m", arm.spring_body);
    expect_apart(points, "damper_arm_m", arm.damper_arm, "damper_body_m", arm.damper_body);
    return arm;
}

// What the keys mean that the recipe of the same name does not have: there, a spring says itself where it acts.
const std::vector<HardpointKey> seats{{"spring_arm_m", HardpointKind::point, "spring's seat on the arm"},
                                      {"spring_body_m", HardpointKind::point, "spring's seat on the chassis"},
                                      {"damper_arm_m", HardpointKind::point, "damper's mount on the arm"},
                                      {"damper_body_m", HardpointKind::point, "damper's mount on the chassis"}};

constexpr std::array suspension_kinds{
    Kind<SuspensionDescription>{MacPherson<double>::keyword, read_macpherson},
    Kind<SuspensionDescription>{SemiTrailingArm<double>::keyword, read_semi_trailing_arm}};

const Kind<SuspensionDescription>* own_kind(std::string_view suspension) {
    const auto found = std::ranges::find(suspension_kinds, suspension, &Kind<SuspensionDescription>::keyword);
    return found == suspension_kinds.end() ? nullptr : &*found;
}

}  // namespace

bool has_own_program(std::string_view suspension) {
    return own_kind(suspension) != nullptr;
}

CornerDescription read_left_corner(const TableReader& axle, std::string_view suspension, const NamedTires& tires) {
    const TableReader spring = axle.table("spring"), hardpoints = axle.table("hardpoints");
    const SuspensionDescription points = own_kind(suspension)->read(hardpoints);
    note_meanings(hardpoints, find_recipe(suspension)->keys, suspension);
    note_meanings(hardpoints, seats, suspension);
    const WheelDescription wheel = read_wheel(axle.table("wheel"));
    return {.name = axle.text("name") + "_left",
            .suspension = points,
            .carrier = read_body(axle.table("carrier"), wheel),
            .wheel = wheel,
            .spring = {spring.number("rate_N_per_m", positive), spring.number("force_at_design_N", any_number)},
            .damper = read_damper(axle.table("damper")),
            .bump = read_stop(axle.optional_table("bump_stop")),
            .rebound = read_stop(axle.optional_table("rebound_stop")),
            .tire = tire_of(axle, tires),
            .brake = read_brake(axle.optional_table("brake")),
            .drive_share = axle.number("drive_share", fraction, 0) / 2};
}

}  // namespace hamilcar::io
