// The mechanics of a steering alone, without a car: forces by hand, the power that they leave by differences of the energy, joints by the
// closed form of a universal joint, a varying ratio against its table. Its assist: assist_test.cpp.
#include "hamilcar/steering/steering_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hamilcar/vehicle/build_steering.hpp"
#include "support/difference.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

using System = SteeringSystem<double>;
using Numbers = std::array<double, steering_numbers>;

constexpr double turn = 2 * std::numbers::pi;

SteeringDescription straight(const SteeringMechanicsDescription& mechanics) {
    return {.rack_per_revolution = 0.05, .rack_travel = 0.07, .angle = {}, .rack = {}, .mechanics = mechanics};
}

SteeringDescription varying(const SteeringMechanicsDescription& mechanics) {
    SteeringDescription out = straight(mechanics);
    out.angle = {0, 1, 3, 6, 10}, out.rack = {0, 0.006, 0.021, 0.051, 0.083};
    return out;
}

System made(const SteeringDescription& description) {
    System out = make_steering<double>(description);
    out.place = 0;
    return out;
}

SteeringHands<double> off() {
    return {0, 0, 0, 0};
}

TEST(SteeringForces, OfTheTorsionBarFollowTheRatio) {
    SteeringMechanicsDescription d = test::bare_mechanics();
    d.bar_damping = 0.5;
    const System system = made(straight(d));
    constexpr double ratio = turn / 0.05;  // [rad/m]
    Numbers x{0.01, 0, 0.01 * ratio + 0.03, 0.04 * 2, 0, 0, 0};
    const auto out = system.evaluate(system.state(x.data()), 0.012, off(), 0);
    const double torque = 115 * 0.03 + 0.5 * (2 - 0.012 * ratio);
    EXPECT_NEAR(out.wheel_rate, 2, 1e-14);
    EXPECT_NEAR(out.bar_torque, torque, 1e-12);
    EXPECT_NEAR(out.pinion_force, torque * ratio, 1e-9);
    EXPECT_NEAR(out.on_rack, torque * ratio, 1e-9);
    EXPECT_NEAR(out.on_wheel, -torque, 1e-12);
    EXPECT_NEAR(out.work_rate, -0.5 * std::pow(2 - 0.012 * ratio, 2), 1e-12) << "the damper's loss alone";
}

TEST(SteeringForces, OfHandsAreASpringADamperAndATorque) {
    const System system = made(straight(test::bare_mechanics()));
    constexpr double ratio = turn / 0.05;
    Numbers x{0.01, 0, 0.01 * ratio, 0.04 * 0.7, 0, 0, 0};
    const SteeringHands<double> hands{.rack = 0.0101, .rack_rate = 0.01, .hold = 0.25, .torque = -2};
    const auto out = system.evaluate(system.state(x.data()), 0, hands, 0);
    const double expected = -2 + 0.25 * (1000 * 0.0001 * ratio + 9 * (0.01 * ratio - 0.7));
    EXPECT_NEAR(out.hands_torque, expected, 1e-10);
    EXPECT_NEAR(out.on_wheel, expected, 1e-10);
    EXPECT_NEAR(out.work_rate, expected * 0.7, 1e-10);
    EXPECT_EQ(system.evaluate(system.state(x.data()), 0, off(), 0).hands_torque, 0) << "hands off";
}

TEST(SteeringForces, OfStopsPushBackBeyondTheTravelAlone) {
    const System system = made(straight(test::bare_mechanics()));
    const auto stop = [&](double rack) {
        Numbers x{rack, 0, rack * turn / 0.05, 0, 0, 0, 0};
        const auto out = system.evaluate(system.state(x.data()), 0, off(), 0);
        EXPECT_NEAR(out.on_rack, out.stop, 1e-9);
        return out.stop;
    };
    EXPECT_EQ(stop(0.0699), 0);
    EXPECT_EQ(stop(-0.0699), 0);
    EXPECT_NEAR(stop(0.072), -2e6 * 0.002, 1e-6);
    EXPECT_NEAR(stop(-0.073), 2e6 * 0.003, 1e-6);
}

// From rest to where it slides, either way.
TEST(SteeringForces, OfDryFrictionHoldAndThenSlide) {
    SteeringMechanicsDescription d = test::bare_mechanics();
    d.rack_friction = 200, d.rack_stiffness = 2e6, d.rack_damping = 50;
    d.wheel_friction = 0.4, d.wheel_stiffness = 40;
    const System system = made(straight(d));
    Numbers x{0, 0, 0, 0, 5e-5, -0.004, 0};  // half of what the rack holds, a fraction of the wheel's
    auto out = system.evaluate(system.state(x.data()), 0, off(), 0);
    EXPECT_NEAR(out.friction, -100, 1e-9);
    EXPECT_NEAR(out.on_wheel, 0.16, 1e-12);
    x = {0, 0, 0, 0.04 * 3, 1e-4, 0.01, 0};  // wound up in full, sliding
    out = system.evaluate(system.state(x.data()), 0.2, off(), 0);
    EXPECT_NEAR(out.friction, -200 - 50 * 0.2, 1e-9);
    EXPECT_NEAR(out.on_wheel, -0.4, 1e-12);
    x = {0, 0, 0, -0.04 * 3, -1e-4, -0.01, 0};
    out = system.evaluate(system.state(x.data()), -0.2, off(), 0);
    EXPECT_NEAR(out.friction, 200 + 50 * 0.2, 1e-9);
    EXPECT_NEAR(out.on_wheel, 0.4, 1e-12);
}

// A state of 7 numbers and the rack's speed, off every kink.
struct Moving {
    Numbers x;
    double rack_rate;
};

double stored(const System& system, const Moving& at) {
    const auto state = system.state(at.x.data());
    return system.kinetic(state, at.rack_rate) + system.potential(state);
}

// What the motion along the system's own rates makes of it; the rack has no mass but its own.
Moving after(const System& system, const Moving& at, const System::Output& out, double time) {
    Moving to = at;
    to.x[0] += at.rack_rate * time, to.x[2] += out.wheel_rate * time, to.x[3] += out.on_wheel * time;
    to.rack_rate += out.on_rack / system.rack_mass * time;
    return to;
}

TEST(SteeringEnergy, ChangesByThePowerOfWhatHasNoPotential) {
    std::mt19937 source(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const bool varies : {false, true}) {
        const SteeringMechanicsDescription d = test::full_mechanics();
        const System system = made(varies ? varying(d) : straight(d));
        for (int trial = 0; trial < 200; ++trial) {
            const double rack = 0.08 * unit(source);  // to beyond the stops
            Moving at{{rack, 0, system.pinion_at(rack).angle + 0.05 * unit(source), 0.08 * unit(source),
                       1e-4 * unit(source), 0.01 * unit(source), 3000 * unit(source)},
                      0.2 * unit(source)};
            const SteeringHands<double> hands{rack + 1e-3 * unit(source), 0.1 * unit(source), 0.8, 4 * unit(source)};
            const auto out = system.evaluate(system.state(at.x.data()), at.rack_rate, hands, 20);
            constexpr double step = 1e-6;
            // A piece of the ratio or the stop may begin in between.
            if (std::abs(system.pinion_at(rack + step).slope - system.pinion_at(rack - step).slope) > 0) continue;
            if (std::abs(std::abs(rack) - system.rack_travel) < 1e-5) continue;
            const double rate =
                test::derivative([&](double time) { return stored(system, after(system, at, out, time)); }, 0, step);
            EXPECT_NEAR(rate, out.work_rate, 1e-6 * (10 + std::abs(rate))) << trial;
        }
    }
}

// Joints under an angle b turn by tan(out) = tan(in) / cos(b), from where they do neither lead nor lag; the error is
// tan^2(b / 2) sin(2 in) but for terms of the fourth order.
TEST(SteeringJoints, LeadAndLagAsAUniversalJoint) {
    for (const double bend : {0.1, 0.2, 0.35}) {
        SteeringMechanicsDescription d = test::bare_mechanics();
        const double error = std::pow(std::tan(bend / 2), 2);
        d.joint_error = error, d.joint_phase = 0.4;
        const System system = made(straight(d));
        for (double angle = -7; angle < 7; angle += 0.173) {
            const double in = angle - 0.4;
            const double turned = std::atan2(std::sin(in) / std::cos(bend), std::cos(in));
            const double lead = std::remainder(turned - in, turn);
            EXPECT_NEAR(system.lower_end(angle).angle - angle, lead, 0.51 * error * error) << "bend " << bend;
            const double slope = test::derivative([&](double a) { return system.lower_end(a).angle; }, angle, 1e-3);
            EXPECT_NEAR(system.lower_end(angle).slope, slope, 1e-9);
        }
    }
}

// They pass on power, not torque.
TEST(SteeringJoints, LoseNothing) {
    SteeringMechanicsDescription d = test::bare_mechanics();
    d.joint_error = 0.03;
    const System system = made(straight(d));
    Numbers x{0.02, 0, 0.02 * turn / 0.05 + 0.1, 0.08, 0, 0, 0};
    const auto out = system.evaluate(system.state(x.data()), 0, off(), 0);
    const double lower_rate = system.lower_end(x[2]).slope * out.wheel_rate;
    EXPECT_NEAR(-out.on_wheel * out.wheel_rate, out.bar_torque * lower_rate, 1e-12);
    EXPECT_GT(std::abs(system.lower_end(x[2]).slope - 1), 0.01);
}

// Straight pieces through points of the column's curve: in between they are off by no more than curvature times length^2 / 8.
TEST(SteeringRatio, VariesAsItsTableSays) {
    const SteeringDescription description = varying(test::bare_mechanics());
    const System system = made(description);
    const Column column(description);
    double curvature = 0, most = 0;
    for (double rack = -0.0699; rack < 0.07; rack += 0.00037) {
        constexpr double h = 1e-4;
        curvature = std::max(
            curvature, std::abs(column.angle(rack + h) - 2 * column.angle(rack) + column.angle(rack - h)) / (h * h));
        most = std::max(most, std::abs(system.pinion_at(rack).angle - column.angle(rack)));
        const double slope = (system.pinion_at(rack + 1e-9).angle - system.pinion_at(rack - 1e-9).angle) / 2e-9;
        EXPECT_NEAR(system.pinion_at(rack).slope, slope, 1e-4 * slope) << rack;
        EXPECT_NEAR(system.pinion_at(-rack).angle, -system.pinion_at(rack).angle, 1e-12);
    }
    double longest = 0;
    for (std::size_t i = 0; i < system.pinion.start.size(); ++i) {
        const double begin = system.pinion.start[i];
        EXPECT_NEAR(system.pinion_at(begin).angle, column.angle(begin), 1e-12);
        longest = std::max(longest, system.pinion.end[i] - begin);
    }
    EXPECT_LT(most, longest * longest / 8 * curvature);
    EXPECT_GT(most, 0);
}

TEST(SteeringRatio, IsOneStraightLineWithoutATable) {
    const System system = made(straight(test::bare_mechanics()));
    EXPECT_EQ(system.pinion.slope.size(), 1u);
    for (const double rack : {-0.1, -0.03, 0.0, 0.05, 0.12}) {
        EXPECT_NEAR(system.pinion_at(rack).angle, rack * turn / 0.05, 1e-12);
        EXPECT_NEAR(system.pinion_at(rack).slope, turn / 0.05, 1e-9);
    }
}

}  // namespace
}  // namespace hamilcar
