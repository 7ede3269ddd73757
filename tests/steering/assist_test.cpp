// A power assist without a car: its map by hand, on both sides, over speed, ahead of time, and beyond what its pump follows.
#include <gtest/gtest.h>

#include <numbers>

#include "hamilcar/vehicle/build_steering.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

constexpr double ratio = 2 * std::numbers::pi / 0.05;  // [rad/m]

SteeringSystem<double> made(const SteeringMechanicsDescription& mechanics) {
    auto out = make_steering<double>({.rack_per_revolution = 0.05, .rack_travel = 0.07, .mechanics = mechanics});
    out.place = 0;
    return out;
}

using Numbers = std::array<double, steering_numbers>;

constexpr SteeringHands<double> off{0, 0, 0, 0};

class SteeringAssist : public testing::Test {
protected:
    // What it asks for at a torque of the bar that does not change but for the rack's speed, and one of the vehicle.
    double asked(double torque, double rack_rate, double speed, double lead_time = 0) const {
        SteeringMechanicsDescription d = test::bare_mechanics();
        d.assist = test::usual_assist();
        d.assist.lead_time = lead_time;
        const SteeringSystem<double> system = made(d);
        Numbers x{0, 0, torque / d.bar_stiffness, d.wheel_inertia * ratio * rack_rate, 0, 0, 500};
        const auto out = system.evaluate(system.state(x.data()), rack_rate, off, speed);
        EXPECT_NEAR(out.assist_force, 500, 1e-12) << "its force is a state";
        return 500 + d.assist.response_time * out.assist_rate;
    }
};

TEST_F(SteeringAssist, FollowsItsMapOnBothSides) {
    for (const double side : {1.0, -1.0}) {
        EXPECT_NEAR(asked(side * 0.5, 0, 0), 0, 1e-9);
        EXPECT_NEAR(asked(side * 2, 0, 0), side * 300, 1e-9);
        EXPECT_NEAR(asked(side * 4.5, 0, 0), side * 1550, 1e-9);
        EXPECT_NEAR(asked(side * 9, 0, 0), side * 2500, 1e-9) << "no more than the map's end";
        EXPECT_NEAR(asked(side * 4.5, 0, 15), side * 0.8 * 1550, 1e-9) << "less at speed";
        EXPECT_NEAR(asked(side * 4.5, 0, -45), side * 0.5 * 1550, 1e-9) << "in reverse as well";
        EXPECT_NEAR(asked(side * 4.5, 0, 90), side * 0.4 * 1550, 1e-9);
    }
}

TEST_F(SteeringAssist, FadesWhereThePumpDoesNotFollow) {
    for (const double way : {1.0, -1.0}) {
        EXPECT_NEAR(asked(way * 4.5, way * 0.29, 0), way * 1550, 1e-9);
        EXPECT_NEAR(asked(way * 4.5, way * 0.31, 0), way * 1550 * 0.8, 1e-9);
        EXPECT_NEAR(asked(way * 4.5, way * 0.34, 0), way * 1550 * 0.2, 1e-9);
        EXPECT_NEAR(asked(way * 4.5, way * 0.4, 0), 0, 1e-9);
        EXPECT_NEAR(asked(way * 4.5, way * -0.4, 0), way * 1550, 1e-9) << "pushed back, it needs no flow";
    }
}

// A wheel that turns against a rack that stands: the torque that will be there after the lead's time.
TEST_F(SteeringAssist, AnswersToATorqueAheadOfTime) {
    SteeringMechanicsDescription d = test::bare_mechanics();
    d.assist = test::usual_assist();
    d.bar_damping = 3;  // no part of what it measures
    const SteeringSystem<double> system = made(d);
    constexpr double rate = 2;
    Numbers x{0, 0, 3.0 / d.bar_stiffness, d.wheel_inertia * rate, 0, 0, 0};
    const auto out = system.evaluate(system.state(x.data()), 0, off, 0);
    const double ahead = 3.0 + d.bar_stiffness * rate * 0.006;
    EXPECT_NEAR(d.assist.response_time * out.assist_rate, 600 + (ahead - 3) * 1900 / 3, 1e-9);
    EXPECT_NEAR(asked(4.5, 0.1, 0, 0.006), 1550, 1e-9) << "rack and wheel together: nothing to lead";
}

}  // namespace
}  // namespace hamilcar
