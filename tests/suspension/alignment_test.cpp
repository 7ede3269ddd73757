// Alignment by other routes: the figures of the kinematics, which know the steering axis as a screw; what was not turned keeps its
// length; a rod that is longer from the start, in a car that is left to settle.
#include "hamilcar/suspension/alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/kinematics.hpp"
#include "hamilcar/analysis/linear_model.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/toml_document.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using units::degree;

AxleFigures at_design(const VehicleDescription& vehicle, const std::string& axle) {
    for (const AxleReport& report : kinematics(vehicle, {.steps = 2})) {
        if (report.name == axle) return report.design;
    }
    ADD_FAILURE() << "no axle " << axle;
    return {};
}

double distance_of(const CutJointDescription& cut) {
    const Vec3<double> span = vec3(cut.tip) - vec3(cut.foot), axis = vec3(cut.axis);
    return cut.length.value_or(cut.kind == CutJoint::distance ? span.norm() : (span - axis * axis.dot(span)).norm());
}

struct Case {
    std::string vehicle, axle;
    std::optional<double> toe, camber, caster;  // [deg]
    std::string turned;                         // the rod whose length sets toe, or camber
};
void PrintTo(const Case& one, std::ostream* out) {
    *out << one.vehicle << " " << one.axle;
}

std::string keys(const Case& one) {
    std::string text;
    const auto add = [&](const char* key, const std::optional<double>& value) {
        if (value) text += "alignment." + std::string(key) + " = " + std::to_string(*value) + "\n";
    };
    add("toe_in_deg", one.toe), add("camber_deg", one.camber), add("caster_deg", one.caster);
    return text;
}

class Alignments : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Shipped, Alignments,
                         testing::Values(Case{"bmw_323i", "front", 0.25, -1.2, 7.5, "tie rod"},
                                         Case{"bmw_323i", "front", -0.2, {}, {}, "tie rod"},
                                         Case{"formula", "front", -0.3, -3.0, 5.0, "tie rod"},
                                         Case{"formula", "rear", 0.4, -2.0, {}, "toe link"},
                                         Case{"bmw_e90_330i", "rear", 0.3, -2.2, {}, "link 5"},
                                         Case{"offroader", "front", 0.2, {}, {}, "tie rod"}));

TEST_P(Alignments, SetTheAnglesThatTheKinematicsFind) {
    const VehicleDescription car = test::shipped_with(GetParam().vehicle, GetParam().axle, keys(GetParam()));
    const AxleFigures found = at_design(car, GetParam().axle);
    for (const WheelFigures& wheel : {found.left, found.right}) {
        if (GetParam().toe) EXPECT_NEAR(wheel.toe / degree, *GetParam().toe, 1e-7);
        if (GetParam().camber) EXPECT_NEAR(wheel.camber / degree, *GetParam().camber, 1e-7);
        if (GetParam().caster) EXPECT_NEAR(wheel.caster / degree, *GetParam().caster, 1e-7);
    }
}

// The wheel's height, every length but those of the rods that were turned, and what the springs are without load.
TEST_P(Alignments, LeaveAloneWhatIsNotTurned) {
    const VehicleDescription before = test::shipped(GetParam().vehicle);
    const VehicleDescription after = test::shipped_with(GetParam().vehicle, GetParam().axle, keys(GetParam()));
    int turned = 0;
    for (std::size_t s = 0; s < before.suspensions.size(); ++s) {
        const SuspensionDescription &from = before.suspensions[s], &to = after.suspensions[s];
        for (std::size_t i = 0; i < from.wheels.size(); ++i) {
            EXPECT_NEAR(to.wheels[i].wheel.center[2], from.wheels[i].wheel.center[2], 1e-9);
        }
        for (std::size_t i = 0; i < from.linkage.cuts.size(); ++i) {
            const double change = distance_of(to.linkage.cuts[i]) - distance_of(from.linkage.cuts[i]);
            const std::string& name = from.linkage.cuts[i].name;
            const bool may_turn = name == GetParam().turned || name == "link 4" || name == "drag link";
            if (name == GetParam().turned && std::abs(change) > 1e-5) ++turned;
            if (!may_turn) EXPECT_NEAR(change, 0, 1e-11) << name;
        }
        for (std::size_t i = 0; i < from.springs.size(); ++i) {
            const auto free_length = [](const SuspensionSpringDescription& of) {
                const double length =
                    of.line.coordinate ? of.line.at_design : (vec3(of.line.on_part) - vec3(of.line.on_base)).norm();
                return length + of.spring.force_at_design / of.spring.rate;
            };
            EXPECT_NEAR(free_length(to.springs[i]), free_length(from.springs[i]), 1e-9);
        }
    }
    EXPECT_GT(turned, 0) << GetParam().turned;
}

// The carrier's inertia turns with it: the same about its own axes.
TEST(Alignment, TurnsInertiasWithTheirParts) {
    const VehicleDescription before = test::shipped("bmw_323i");
    const VehicleDescription after =
        test::shipped_with("bmw_323i", "front", "alignment.toe_in_deg = 2\nalignment.camber_deg = 3\n");
    for (const std::size_t s : {0, 1}) {
        const auto along_spin = [&](const VehicleDescription& car) {
            const BodyDescription& b = car.suspensions[s].bodies[0].body;
            const auto& [xy, yz, xz] = b.products;
            Mat3<double> I;
            I << b.inertia[0], xy, xz, xy, b.inertia[1], yz, xz, yz, b.inertia[2];
            const Vec3<double> e = vec3(car.suspensions[s].wheels[0].wheel.spin_axis);
            return std::pair(e.dot(I * e), I.trace());
        };
        EXPECT_NEAR(along_spin(after).first, along_spin(before).first, 1e-12);
        EXPECT_NEAR(along_spin(after).second, along_spin(before).second, 1e-12);
        EXPECT_GT(
            std::abs(after.suspensions[s].bodies[0].body.inertia[0] - before.suspensions[s].bodies[0].body.inertia[0]),
            1e-4);
    }
}

// A tie rod that the file says to be as long as the aligned one: the same car, which finds its place by itself.
TEST(Alignment, IsACarWithALongerTieRodThatSettled) {
    const VehicleDescription aligned = test::shipped_with("bmw_323i", "front", "alignment.toe_in_deg = 0.6\n");
    const double length = distance_of(aligned.suspensions[0].linkage.cuts[1]);
    char text[64];
    std::snprintf(text, sizeof text, "hardpoints.tie_rod_length_m = %.17g\n", length);
    const VehicleDescription longer = test::shipped_with("bmw_323i", "front", text);
    const Linearizer one(aligned), other(longer);
    const OperatingPoint a = one.operating_point({}), b = other.operating_point({});
    ASSERT_TRUE(a.found && b.found);
    const Model<double>&m = one.model(), &n = other.model();
    const Velocity<double> v = velocity_block(m, a.state, a.input), w = velocity_block(n, b.state, b.input);
    EXPECT_NEAR(a.state.position()[2], b.state.position()[2], 1e-9);
    for (std::size_t s = 0; s < aligned.suspensions.size(); ++s) {
        EXPECT_LT((v.suspensions[s].center[0] - w.suspensions[s].center[0]).norm(), 1e-9);
        EXPECT_LT((v.suspensions[s].axis[0] - w.suspensions[s].axis[0]).norm(), 1e-9);
    }
    const double design = vec3(test::shipped("bmw_323i").suspensions[0].wheels[0].wheel.spin_axis)[0];
    EXPECT_GT(std::abs(v.suspensions[0].axis[0][0] - design), 5e-3) << "it did turn";
}

// The link that sets camber is a part that the spring and a bar sit on, which stays untwisted.
TEST(Alignment, TurnsALinkThatIsAPart) {
    const std::string bar =
        "anti_roll_bar = {rate_N_m_per_rad = 600, pivot_m = [-2.6, 0.4, 0.35], arm_end_m = [-2.75, 0.5, 0.35], link_m "
        "= [-2.76, 0.52, "
        "0.41], on = \"link_4\"}\n";
    const VehicleDescription before = test::shipped_with("bmw_e90_330i", "rear", bar);
    const VehicleDescription after =
        test::shipped_with("bmw_e90_330i", "rear", bar + "alignment = {toe_in_deg = 0.3, camber_deg = -2.4}\n");
    const AxleFigures found = at_design(after, "rear");
    for (const WheelFigures& wheel : {found.left, found.right}) {
        EXPECT_NEAR(wheel.toe / degree, 0.3, 1e-7);
        EXPECT_NEAR(wheel.camber / degree, -2.4, 1e-7);
    }
    const auto length_of = [](const VehicleDescription& car, const std::string& link, const std::string& ball) {
        const LinkageDescription& d = car.suspensions[2].linkage;
        const auto joint = std::ranges::find(d.joints, link, &TreeJointDescription::part);
        const auto cut = std::ranges::find(d.cuts, ball, &CutJointDescription::name);
        return (vec3(cut->foot) - vec3(joint->point)).norm();
    };
    EXPECT_GT(std::abs(length_of(after, "link 4", "link 4 ball") - length_of(before, "link 4", "link 4 ball")), 1e-3);
    EXPECT_NEAR(length_of(after, "bar arm", "drop link"), length_of(before, "bar arm", "drop link"), 1e-11);
    const Model<double> model = test::make_model(after);
    const State<double> design = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    EXPECT_EQ(bar_deflections(model.vehicle, design, velocity_block(model, design, {}))[2], 0);
}

TEST(Alignment, OfTheRightSideAlone) {
    const VehicleDescription car = test::shipped_with("bmw_323i", "front", "right.alignment.camber_deg = -2.0\n");
    const AxleFigures before = at_design(test::shipped("bmw_323i"), "front"), after = at_design(car, "front");
    EXPECT_NEAR(after.left.camber, before.left.camber, 1e-12);
    EXPECT_NEAR(after.right.camber / degree, -2.0, 1e-7);
}

// A carrier on a file's own linkage, with a rod that sets its camber.
TEST(Alignment, OfAFilesOwnLinkage) {
    const SuspensionDescription recipe = test::shipped("pickup").suspensions[0];
    Composition made;
    made.linkage = recipe.linkage, made.carriers = {recipe.wheels[0].part};
    made.adjusters = {{WheelAngle::toe, recipe.linkage.cuts[1].name}};
    ASSERT_TRUE(can_set(made, WheelAngle::toe));
    ASSERT_FALSE(can_set(made, WheelAngle::camber));
    SuspensionDescription suspension = recipe;
    ASSERT_EQ(align(suspension, made, {{0.01, {}, {}}}), std::nullopt);
    const Point& axis = suspension.wheels[0].wheel.spin_axis;
    EXPECT_NEAR(std::atan2(axis[0], axis[1]), 0.01, 1e-9);
}

TEST(Alignment, ThatCannotBeReachedChangesNothing) {
    const SuspensionDescription from = test::shipped("pickup").suspensions[0];
    Composition made;
    made.linkage = from.linkage, made.carriers = {from.wheels[0].part};
    made.adjusters = {{WheelAngle::toe, from.linkage.cuts[1].name}};
    SuspensionDescription suspension = from;
    EXPECT_NE(align(suspension, made, {{2.5, {}, {}}}), std::nullopt);
    EXPECT_EQ(suspension.linkage.cuts[1].length, from.linkage.cuts[1].length);
    EXPECT_EQ(suspension.wheels[0].wheel.spin_axis, from.wheels[0].wheel.spin_axis);
}

}  // namespace
}  // namespace hamilcar
