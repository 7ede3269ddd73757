// Every recipe of a suspension in an independent engine: cars on four such wheels, thrown on a slope with a slide, a
// roll and a yaw rate, run into their stops; no part, spring or point is where symmetry could hide something.
#include <gtest/gtest.h>

#include "linkage/samples.hpp"
#include "oracle/side_by_side.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

using test::LinkageSample;

constexpr double path_tolerance = 1e-9;  // [m]

// An arm free in space, held by a ball at one bush and a line through both at the other.
LinkageSample held_by_cuts() {
    LinkageDescription linkage;
    const Point inner{0.3, 0.2, 0.28}, outer{0.42, 0.6, 0.3};
    linkage.joints.push_back({TreeJoint::free, "arm", 0, {0.1, 0.5, 0.3}, {}, {}});
    linkage.cuts.resize(2);
    linkage.cuts[0].kind = CutJoint::spherical, linkage.cuts[0].tip = linkage.cuts[0].foot = inner;
    linkage.cuts[1].kind = CutJoint::line, linkage.cuts[1].tip = linkage.cuts[1].foot = outer;
    linkage.cuts[1].axis = direction_between(inner, outer);
    return {"held_by_cuts", "", linkage, {{1, {0.01, 0.72, 0.3}}}};
}

std::vector<LinkageSample> samples() {
    std::vector<LinkageSample> all = test::recipe_samples();
    all.push_back(held_by_cuts());
    return all;
}

// From a sample at the left front to where it is wanted.
struct Place {
    bool right, rear;

    Point direction(const Point& p) const { return right ? mirrored(p) : p; }
    Point point(const Point& p) const {
        Point there = direction(p);
        if (rear) there[0] -= 2.6;
        return there;
    }
};

LinkageDescription linkage_at(const Place& place, LinkageDescription linkage) {
    for (TreeJointDescription& joint : linkage.joints) {
        joint.point = place.point(joint.point);
        joint.axis = place.direction(joint.axis), joint.second_axis = place.direction(joint.second_axis);
    }
    for (CutJointDescription& cut : linkage.cuts) {
        cut.tip = place.point(cut.tip), cut.foot = place.point(cut.foot), cut.axis = place.direction(cut.axis);
        if (place.rear) cut.drive = {};
    }
    return linkage;
}

Point shifted(const Point& p, double x, double y, double z) {
    return {p[0] + x, p[1] + y, p[2] + z};
}

// Wheel carriers, axles and whatever ends the tree have a mass; arms and struts that carry more may go without.
void add_bodies(SuspensionDescription& suspension) {
    const auto& joints = suspension.linkage.joints;
    for (std::size_t part = 1; part <= joints.size(); ++part) {
        std::vector<Point> wheels;
        for (const auto& wheel : suspension.wheels) {
            if (wheel.part == part) wheels.push_back(wheel.wheel.center);
        }
        const bool outward = std::any_of(joints.begin(), joints.end(), [&](const auto& j) { return j.parent == part; });
        if (wheels.size() == 1) {
            suspension.bodies.push_back(
                {part, {30, shifted(wheels[0], 0.02, -0.03, 0.01), {1.1, 0.7, 1.0}, {0.02, 0.01, 0.03}}});
        } else if (wheels.size() == 2 || joints[part - 1].kind == TreeJoint::free) {
            suspension.bodies.push_back(
                {part, {90, shifted(joints[part - 1].point, 0.01, 0.03, 0.02), {35, 3, 35}, {}}});
        } else if (!outward) {
            suspension.bodies.push_back(
                {part, {2, shifted(joints[part - 1].point, 0.03, 0.01, 0.02), {0.02, 0.02, 0.02}, {}}});
        }
    }
}

void add_wheels(const LinkageSample& sample, const Place& place, SuspensionDescription& suspension) {
    const SuspensionWheelDescription paper_wheel = test::paper_car().suspensions[0].wheels[0];
    const bool solid = sample.wheels.size() == 2 && sample.keyword != "twist_beam";
    for (const PartPoint& at : sample.wheels) {
        SuspensionWheelDescription& wheel = suspension.wheels.emplace_back();
        const Point center = place.point(at.point);
        const double inward = center[1] > 0 ? -1 : 1;
        wheel.name = suspension.name, wheel.part = at.part, wheel.wheel = paper_wheel.wheel,
        wheel.wheel.center = center;
        wheel.wheel.spin_axis = {0.02, std::sqrt(1 - 0.02 * 0.02 - 0.04 * 0.04), -0.04 * inward};
        wheel.dual_spacing = sample.name == "leaf_axle" ? 0.2 : 0;
        wheel.bump = {0.02, 60e3, 1e6}, wheel.rebound = {0.02, 80e3, 0};
        wheel.tire = paper_wheel.tire, wheel.brake = paper_wheel.brake;
        wheel.drive_share = 0.25, wheel.drive_reaction = solid ? 1 : 0;
        if (!sample.bar_arms.empty()) wheel.bar_arm = sample.bar_arms[suspension.wheels.size() - 1];
        const LineDescription line{
            at.part, 0, shifted(center, 0.01, 0.1 * inward, 0.1), shifted(center, 0.05, 0.15 * inward, 0.5), {}};
        suspension.springs.push_back({suspension.name, line, {25e3, 2900}});
        suspension.dampers.push_back({suspension.name, line, {{-1, 0, 1}, {-1200, 0, 2000}}});
    }
    LineDescription about;
    about.coordinate = suspension.linkage.coordinate_count() - 1;
    suspension.springs.push_back({suspension.name, about, {300, 20}});
    suspension.dampers.push_back({suspension.name, about, {{-1, 1}, {-5, 5}}});
}

SuspensionDescription suspension_at(const LinkageSample& sample, const Place& place) {
    SuspensionDescription suspension;
    suspension.name = std::string(place.rear ? "rear" : "front") + (place.right ? "_right" : "_left");
    suspension.keyword = sample.keyword;
    suspension.linkage = linkage_at(place, sample.linkage);
    add_wheels(sample, place, suspension);
    add_bodies(suspension);
    return suspension;
}

VehicleDescription car_on(const LinkageSample& sample) {
    VehicleDescription car;
    car.name = sample.name;
    car.chassis = {1000, {-1.25, 0.02, 0.55}, {320, 1500, 1600}, {10, -15, 20}};
    car.aerodynamics = {0.7, 1.2, {-1, 0, 0.6}};
    car.steering = {0.04, 0.06};
    for (const bool rear : {false, true}) {
        for (const bool right : {false, true}) {
            if (!right || sample.wheels.size() == 1) car.suspensions.push_back(suspension_at(sample, {right, rear}));
        }
    }
    const double of_arms = sample.bar_arms.empty() ? 1 : 0.1;  // [m^2]
    car.anti_roll_bars = {{0, 1, 6e3 * of_arms}, {2, 3, 4e3 * of_arms}};
    return car;
}

ScenarioDescription thrown() {
    ScenarioDescription s = test::scenario(1, 12);
    s.solver.integrator = "rk4";
    s.solver.step = 5e-4;
    s.initial.settle = false;
    s.initial.velocity = {12, 0.5, 0.1}, s.initial.angular_velocity = {0.3, -0.1, 0.2};
    s.road = {.grade = 0.03, .bank = 0.02, .friction = 0.9};
    s.drive = test::table({0, 0.3, 0.5}, {0, 900, 0});
    s.brake = test::table({0.5, 0.7}, {0, 0.3});
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0, 0.3, 0.6, 0.9}, {0, 0.008, -0.006, 0.002});
    return s;
}

class SimbodyRecipes : public testing::TestWithParam<LinkageSample> {};

TEST_P(SimbodyRecipes, TakeTheSamePath) {
    oracle::SideBySide both(car_on(GetParam()), thrown(), oracle::SpindleModel::strut);
    const double gap = both.largest_gap();
    std::printf("largest gap: %.2e m\n", gap);
    EXPECT_LT(gap, path_tolerance);
}

INSTANTIATE_TEST_SUITE_P(All, SimbodyRecipes, testing::ValuesIn(samples()),
                         [](const auto& sample) { return sample.param.name; });

}  // namespace
}  // namespace hamilcar
