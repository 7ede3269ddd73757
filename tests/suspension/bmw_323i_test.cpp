// The shipped hardpoints against kinematics that were derived from them before there was a simulator, by a calculation of
// its own: camber, toe, caster, strut length and longitudinal wheel movement over travel, steer over rack, arm angles.
// Published are alignment, camber gain and rack ratio at design alone, which the hardpoints were solved for
// (vehicles/bmw_323i.toml; tests/analysis/kinematics_test.cpp): these curves were never published.
#include <gtest/gtest.h>

#include <numbers>

#include "support/car.hpp"
#include "support/hardpoints.hpp"

namespace hamilcar {
namespace {

constexpr double degree = 180 / std::numbers::pi;
constexpr double angle_tolerance = 0.02;   // [deg]
constexpr double length_tolerance = 2e-4;  // [m]; hardpoints are printed to 0.1 mm

// One suspension held at a wheel travel and a rack displacement.
class HeldSuspension {
public:
    explicit HeldSuspension(std::size_t index) : model_(test::make_model(test::paper_car())), index_(index) {
        state_ = design_state(model_, Vec3<double>::Zero(), Mat3<double>::Identity());
        EXPECT_TRUE(assemble(model_, input_.rack, state_).assembled);
    }

    struct Figures {
        double independent, spring;                // [m or rad], [m]
        double camber, toe, steer;                 // [deg]
        Vec3<double> center_shift, contact_shift;  // [m]
    };

    Figures at(double travel, double rack = 0) {
        constexpr int lead_in = 20;
        for (int i = 1; i <= lead_in; ++i) move_to(travel * i / lead_in, rack * i / lead_in);
        const auto velocity = velocity_block(model_, state_, input_);
        const SuspensionVelocity<double>& at = velocity.suspensions[index_];
        const Vec3<double>& e = at.axis[0];
        const auto contact = [](const Vec3<double>& center, const Vec3<double>& axis) {
            const Vec3<double> down = (Vec3<double>::UnitZ() - axis * axis[2]).normalized();
            return Vec3<double>(center - down * center_height);
        };
        const auto own = suspension().state(state_.values.data());
        const double spring =
            suspension().linkage.line(suspension().springs[0].line, at.at, own.independent, own.dependent).length;
        return {own.independent[0],
                spring,
                -degree * std::asin(e[2]),
                degree * std::atan2(e[0], e[1]),
                -degree * std::atan2(e[0], e[1]),
                at.center[0] - wheel().center,
                contact(at.center[0], e) - contact(wheel().center, wheel().axis)};
    }

    // Of the steering axis, from the ball joint to the strut's top [deg].
    double caster_at(double travel) {
        at(travel);
        const test::MacPhersonPoints points = test::strut_points(test::paper_car().suspensions[index_]);
        const auto velocity = velocity_block(model_, state_, input_);
        const Placement<double>& carrier = velocity.suspensions[index_].at.pose[carrier_frame()];
        const Vec3<double> C = carrier.point(vec3(points.ball_joint)), T = vec3(points.strut_top);
        return degree * std::atan2(C[0] - T[0], T[2] - C[2]);
    }

private:
    static constexpr double center_height = 0.28;  // wheel center over ground at design [m]

    const Suspension<double>& suspension() const { return model_.vehicle.suspensions[index_]; }
    const Wheel<double>& wheel() const { return suspension().wheels[0].wheel; }
    std::size_t carrier_frame() const { return static_cast<std::size_t>(suspension().wheels[0].frame); }

    // Newton on the independent coordinate until the wheel center stands at that travel.
    void move_to(double travel, double rack) {
        input_.rack.displacement = rack;
        for (int i = 0; i < 20; ++i) {
            ASSERT_TRUE(assemble(model_, input_.rack, state_).assembled);
            const auto velocity = velocity_block(model_, state_, input_);
            const SuspensionVelocity<double>& at = velocity.suspensions[index_];
            const Spatial<double> J = at.at.motion.J[carrier_frame()].col(0);
            const double slope = velocity_at<double>(J, at.center[0])[2];
            suspension().state(state_.values.data()).independent[0] -=
                (at.center[0][2] - wheel().center[2] - travel) / slope;
        }
    }

    Model<double> model_;
    Input<double> input_;
    State<double> state_;
    std::size_t index_;
};

struct FrontRow {
    double travel_mm, camber, toe, caster, center_x_mm, contact_y_mm, strut_mm;
};
void PrintTo(const FrontRow& row, std::ostream* out) {
    *out << row.travel_mm << "mm";
}
class FrontKinematics : public testing::TestWithParam<FrontRow> {};

TEST_P(FrontKinematics, IsThatDerivedFromTheHardpoints) {
    const FrontRow row = GetParam();
    const auto f = HeldSuspension(0).at(1e-3 * row.travel_mm);
    EXPECT_NEAR(f.camber, row.camber, angle_tolerance);
    EXPECT_NEAR(f.toe, row.toe, angle_tolerance);
    EXPECT_NEAR(f.center_shift[0], 1e-3 * row.center_x_mm, length_tolerance);
    EXPECT_NEAR(f.contact_shift[1], 1e-3 * row.contact_y_mm, length_tolerance);
    EXPECT_NEAR(f.spring, 1e-3 * row.strut_mm, length_tolerance);  // it is as long as the strut
    EXPECT_NEAR(HeldSuspension(0).caster_at(1e-3 * row.travel_mm), row.caster, angle_tolerance);
}

INSTANTIATE_TEST_SUITE_P(Travel, FrontKinematics,
                         testing::Values(FrontRow{-80, 1.656, 0.334, 7.90, 1.30, -21.73, 603.75},
                                         FrontRow{-60, 0.972, 0.295, 8.15, 1.11, -14.21, 586.11},
                                         FrontRow{-40, 0.352, 0.250, 8.40, 0.83, -8.10, 568.26},
                                         FrontRow{-20, -0.203, 0.203, 8.66, 0.46, -3.37, 550.17},
                                         FrontRow{0, -0.690, 0.155, 8.94, 0, 0, 531.83},
                                         FrontRow{20, -1.105, 0.107, 9.23, -0.56, 2.01, 513.21},
                                         FrontRow{40, -1.440, 0.060, 9.53, -1.21, 2.63, 494.28},
                                         FrontRow{60, -1.689, 0.015, 9.84, -1.96, 1.83, 475.02},
                                         FrontRow{80, -1.838, -0.028, 10.17, -2.82, -0.46, 455.38}));

struct RearRow {
    double travel_mm, camber, toe, center_x_mm, contact_y_mm;
};
void PrintTo(const RearRow& row, std::ostream* out) {
    *out << row.travel_mm << "mm";
}
class RearKinematics : public testing::TestWithParam<RearRow> {};

TEST_P(RearKinematics, IsThatDerivedFromTheHardpoints) {
    const RearRow row = GetParam();
    const auto f = HeldSuspension(2).at(1e-3 * row.travel_mm);
    EXPECT_NEAR(f.camber, row.camber, angle_tolerance);
    EXPECT_NEAR(f.toe, row.toe, angle_tolerance);
    EXPECT_NEAR(f.center_shift[0], 1e-3 * row.center_x_mm, length_tolerance);
    EXPECT_NEAR(f.contact_shift[1], 1e-3 * row.contact_y_mm, length_tolerance);
}

INSTANTIATE_TEST_SUITE_P(Travel, RearKinematics,
                         testing::Values(RearRow{-80, 1.087, 0.093, 7.45, -15.86},
                                         RearRow{-60, 0.372, 0.059, 4.18, -11.49},
                                         RearRow{-40, -0.339, 0.058, 1.85, -7.39},
                                         RearRow{-20, -1.047, 0.090, 0.46, -3.56}, RearRow{0, -1.750, 0.155, 0, 0},
                                         RearRow{20, -2.450, 0.252, 0.46, 3.29}, RearRow{40, -3.146, 0.382, 1.85, 6.32},
                                         RearRow{60, -3.838, 0.545, 4.18, 9.07},
                                         RearRow{80, -4.527, 0.742, 7.45, 11.55}));

TEST(RearArm, AnglesAreThoseDerivedFromTheHardpoints) {
    EXPECT_NEAR(degree * HeldSuspension(2).at(0.02).independent, 2.739, angle_tolerance);
    EXPECT_NEAR(degree * HeldSuspension(2).at(-0.02).independent, -2.739, angle_tolerance);
    EXPECT_NEAR(degree * HeldSuspension(2).at(0.08).independent, 11.020, angle_tolerance);
    EXPECT_NEAR(degree * HeldSuspension(2).at(-0.08).independent, -11.020, angle_tolerance);
}

// At the design height the left wheel steers with the rack: the change of the wheel's heading from straight ahead.
struct SteerRow {
    double rack_mm, steer;
};
void PrintTo(const SteerRow& row, std::ostream* out) {
    *out << row.rack_mm << "mm";
}
class Steer : public testing::TestWithParam<SteerRow> {};

TEST_P(Steer, FollowsTheRack) {
    const double straight = HeldSuspension(0).at(0).steer;
    EXPECT_NEAR(HeldSuspension(0).at(0, 1e-3 * GetParam().rack_mm).steer - straight, GetParam().steer, angle_tolerance);
}

// A strut whose tie rod ends on the chassis, as on a rear axle, does not respond to the rack.
TEST(UnsteeredStrut, IgnoresTheRack) {
    VehicleDescription car = test::paper_car();
    car.suspensions[0].linkage.cuts.at(1).drive = {};  // tie rod
    const Model<double> model = test::make_model(car);
    State<double> straight = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    ASSERT_TRUE(assemble(model, {}, straight).assembled);
    State<double> turned = straight;
    ASSERT_TRUE(assemble(model, {.displacement = 0.01}, turned).assembled);
    const Input<double> moving{.rack = {0.01, 0.2, 3}};
    const auto velocity = velocity_block(model, turned, moving);
    const auto rack_motion = [&](std::size_t i) {
        return velocity.suspensions[i].at.motion.x[model.vehicle.suspensions[i].wheels[0].frame].norm();
    };
    const auto turned_by = [&](std::size_t i, int angle) {
        const Suspension<double>& suspension = model.vehicle.suspensions[i];
        return std::abs(suspension.state(turned.values.data()).dependent[angle] -
                        suspension.state(straight.values.data()).dependent[angle]);
    };
    EXPECT_EQ(rack_motion(0), 0);
    EXPECT_GT(rack_motion(1), 0.1);
    for (int angle = 0; angle < 3; ++angle) EXPECT_LE(turned_by(0, angle), 1e-15);
    EXPECT_GT(turned_by(1, 0), 0.05);  // about z
}

INSTANTIATE_TEST_SUITE_P(Rack, Steer,
                         testing::Values(SteerRow{-73, -33.97}, SteerRow{-40, -18.66}, SteerRow{-20, -9.44},
                                         SteerRow{20, 9.90}, SteerRow{40, 20.55}, SteerRow{60, 32.46},
                                         SteerRow{73, 41.31}));

}  // namespace
}  // namespace hamilcar
