// A brake acts like a torsion spring below its limit, slides with exactly its limit above, releases at once, and never returns
// more energy to a wheel than it absorbed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hamilcar/driveline/brake.hpp"

namespace hamilcar {
namespace {

const Brake<double> brake(BrakeDescription{1650, 20e3, 130});  // the shipped car's front brake
constexpr double inertia = 0.85;                               // of its wheel [kg m^2]

struct BrakedWheel {
    double angle = 0, spin = 0, windup = 0;
};

// A Runge-Kutta step of a wheel turned by `torque` against the brake.
void advance(BrakedWheel& wheel, double command, double torque, double h) {
    const auto rate = [&](const BrakedWheel& at) {
        const auto out = brake.evaluate(brake.limit(command), at.spin, at.windup);
        return BrakedWheel{at.spin, (torque + out.torque) / inertia, out.windup_rate};
    };
    const auto moved = [&](const BrakedWheel& k, double share) {
        return BrakedWheel{wheel.angle + share * k.angle, wheel.spin + share * k.spin, wheel.windup + share * k.windup};
    };
    const auto k1 = rate(wheel), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)), k4 = rate(moved(k3, h));
    const auto mean = [h](double a, double b, double c, double d) { return h / 6 * (a + 2 * b + 2 * c + d); };
    wheel.angle += mean(k1.angle, k2.angle, k3.angle, k4.angle);
    wheel.spin += mean(k1.spin, k2.spin, k3.spin, k4.spin);
    wheel.windup += mean(k1.windup, k2.windup, k3.windup, k4.windup);
}

TEST(Brake, HoldsBelowItsLimitLikeATorsionSpring) {
    for (const double share : {0.3, 0.95, -0.95}) {
        BrakedWheel wheel;
        const double command = 0.5, torque = share * command * brake.max_torque;
        for (int i = 0; i < 2000; ++i) advance(wheel, command, torque * std::min(1.0, i / 1000.0), 1e-3);
        EXPECT_NEAR(wheel.angle, torque / brake.stiffness, 1e-12) << "settled after the ramp: e^-76";
        const double settled = wheel.angle;
        for (int i = 0; i < 60000; ++i) advance(wheel, command, torque, 1e-3);
        EXPECT_NEAR(wheel.angle, settled, 1e-12) << "no creep in a minute";
    }
}

// Proportional, then flatter: the torque of a rear axle behind a proportioning valve.
TEST(Brake, ValveReducesTheSlopeAboveItsCommand) {
    BrakeDescription rear{800, 20e3, 130};
    rear.valve_command = 0.4, rear.valve_slope = 0.25;
    const Brake<double> behind(rear);
    for (const auto& [command, torque] :
         {std::pair{0.0, 0.0}, {0.2, 160.0}, {0.4, 320.0}, {0.6, 360.0}, {1.0, 440.0}}) {
        EXPECT_NEAR(behind.limit(command), torque, 1e-12) << command;
        EXPECT_NEAR(behind.evaluate(behind.limit(command), 30, 1).torque, -torque, 1e-12) << command;
    }
    for (const double command : {0.0, 0.3, 0.7, 1.0}) EXPECT_EQ(brake.limit(command), command * 1650) << "no valve";
}

TEST(Brake, SlipsWithExactlyItsLimitAgainstTheSpin) {
    for (const double spin : {80.0, 0.5, -0.5, -80.0}) {
        for (const double command : {1.0, 0.2}) {
            double windup = 0;
            for (int i = 0; i < 20000; ++i)
                windup += 1e-4 * brake.evaluate(brake.limit(command), spin, windup).windup_rate;
            const double limit = command * brake.max_torque;
            EXPECT_EQ(brake.evaluate(brake.limit(command), spin, windup).torque, spin > 0 ? -limit : limit);
            EXPECT_NEAR(brake.evaluate(brake.limit(command), spin, windup).windup_rate, 0, 1e-9)
                << "the wind-up has an end";
        }
    }
}

// A wheel driven by more than the limit is accelerated by the excess torque.
TEST(Brake, SlidesAboveItsLimit) {
    BrakedWheel wheel;
    for (int i = 0; i < 1000; ++i) advance(wheel, 0.5, 900, 1e-3);
    const double before = wheel.spin;
    for (int i = 0; i < 1000; ++i) advance(wheel, 0.5, 900, 1e-3);
    EXPECT_NEAR(wheel.spin - before, (900 - 825) / inertia, 1e-9);
}

TEST(Brake, ReleasesAtOnceAndUnwinds) {
    const double wound = 0.08;
    for (const double spin : {-3.0, 0.0, 3.0}) EXPECT_EQ(brake.evaluate(brake.limit(0), spin, wound).torque, 0);
    double windup = wound;
    for (int i = 0; i < 1000; ++i) windup += 1e-5 * brake.evaluate(brake.limit(0), 0, windup).windup_rate;
    EXPECT_NEAR(windup, wound / std::numbers::e, 1e-3 * wound)
        << "at 100/s for 10 ms; Euler's rule errs by h/2 of 100/s";
}

TEST(Brake, WithoutABrakeThereIsNoTorque) {
    const auto out = Brake<double>(BrakeDescription{}).evaluate(1, 30, 0.3);
    EXPECT_EQ(out.torque, 0);
    EXPECT_TRUE(std::isfinite(out.windup_rate));
}

TEST(Brake, IsTheSameInBothDirections) {
    for (const double spin : {0.01, 2.0, 40.0}) {
        for (const double windup : {-0.09, -0.01, 0.0, 0.03, 0.2}) {
            const auto forward = brake.evaluate(brake.limit(0.6), spin, windup),
                       backward = brake.evaluate(brake.limit(0.6), -spin, -windup);
            EXPECT_EQ(forward.torque, -backward.torque);
            EXPECT_EQ(forward.windup_rate, -backward.windup_rate);
        }
    }
}

// Random periodic spins that hold, slip and turn back, repeated until the wind-up returns: no stored energy is left to be returned.
TEST(Brake, NeverAddsEnergyOverACycle) {
    std::mt19937 source(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const double amplitude : {0.05, 0.5, 3.0, 50.0}) {
        for (int trial = 0; trial < 10; ++trial) {
            std::array<std::pair<double, double>, 5> terms;
            for (auto& [cosine, sine] : terms) cosine = amplitude * unit(source), sine = amplitude * unit(source);
            const double period = trial % 2 ? 0.1 : 1.0, mean = trial < 5 ? 0 : 0.3 * amplitude;
            const auto spin_at = [&](double t) {
                double sum = mean;
                for (std::size_t n = 0; n < terms.size(); ++n) {
                    const double phase = 2 * std::numbers::pi * (n + 1) * t / period;
                    sum += terms[n].first * std::cos(phase) + terms[n].second * std::sin(phase);
                }
                return sum;
            };
            constexpr int steps = 20000;
            double windup = 0, start = 1, taken = 0, turnover = 0;
            for (int round = 0; round < 50 && std::abs(windup - start) > 1e-12; ++round) {
                start = windup, taken = turnover = 0;
                const double h = period / steps;
                for (int i = 0; i < steps; ++i) {  // midpoint rule
                    const double half =
                        windup + h / 2 * brake.evaluate(brake.limit(0.5), spin_at(i * h), windup).windup_rate;
                    const auto middle = brake.evaluate(brake.limit(0.5), spin_at((i + 0.5) * h), half);
                    taken -= h * middle.torque * spin_at((i + 0.5) * h);
                    turnover += h * std::abs(middle.torque * spin_at((i + 0.5) * h));
                    windup += h * middle.windup_rate;
                }
            }
            ASSERT_LE(std::abs(windup - start), 1e-12) << "the cycle must close";
            ASSERT_GT(turnover, 0);
            EXPECT_GE(taken, -1e-6 * turnover) << "amplitude " << amplitude << ", trial " << trial;
        }
    }
}

// Nothing is stored in a released brake, so applying one cannot drive a wheel back: a wheel that turns with the
// brake off, then slowly back a little with the brake on, over and over.
TEST(Brake, NeverAddsEnergyWhenReleasedAndApplied) {
    for (const double spin : {0.3, 1.0, 3.0}) {
        double windup = 0, taken = 0;
        constexpr double h = 1e-5, released = 0.05, applied = 0.1;  // [s]
        for (int round = 0; round < 5; ++round) {
            taken = 0;
            const auto turn = [&](double command, double speed, double duration) {
                for (int i = 0; i < std::lround(duration / h); ++i) {
                    const auto out = brake.evaluate(brake.limit(command), speed, windup);
                    taken -= h * out.torque * speed;
                    windup += h * out.windup_rate;
                }
            };
            turn(0, spin, released);
            turn(1, -0.1 * spin, applied);
        }
        EXPECT_GE(taken, 0) << "J per round, at " << spin << " rad/s";
    }
}

}  // namespace
}  // namespace hamilcar
