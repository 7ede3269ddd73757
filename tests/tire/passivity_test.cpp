// Passivity: a tire returns at most the energy it stored. Over any closed cycle the contact force dissipates work, whatever the
// slip history. Load and road are constant here.
#include <gtest/gtest.h>

#include <numbers>

#include "tire/history.hpp"
#include "tire/rolling_tire.hpp"

namespace hamilcar {
namespace {

constexpr double load = 3059;

// A periodic contact; contact_at(t) has the given period and leaves out the deflections.
class Cycle {
public:
    template <class ContactAt>
    Cycle(const LinearTireDescription& tire, const ContactAt& contact_at, double period, int steps,
          Deflection<double> start)
        : end_(start) {
        const LinearTire<double> model(tire);
        const double h = period / steps;
        const auto power = [&](double t) {  // that slip puts into the contact
            TireContact<double> c = contact_at(t);
            c.u = end_.u, c.v = end_.v;
            const auto force = model.force(c);
            return -(force.Fx * c.v_sx + force.Fy * c.v_sy);
        };
        for (int i = 0; i < steps; ++i) {  // Simpson's rule over two half steps
            const double t = i * h, first = power(t);
            test::advance(model, contact_at, t, h / 2, end_);
            const double middle = power(t + h / 2);
            test::advance(model, contact_at, t + h / 2, h / 2, end_);
            const double last = power(t + h);
            work_ += h / 6 * (first + 4 * middle + last);
            turnover_ += h / 6 * (std::abs(first) + 4 * std::abs(middle) + std::abs(last));
        }
    }
    double work() const { return work_; }          // put in over the cycle [J]
    double turnover() const { return turnover_; }  // put in and taken out [J]
    Deflection<double> end() const { return end_; }

private:
    Deflection<double> end_;
    double work_ = 0, turnover_ = 0;
};

// A standing wheel whose contact moves once around an ellipse of transient slip: center and radius of k, either sense.
Cycle standing_round(const LinearTireDescription& tire, Deflection<double> start, double radius, double period,
                     double sense, int steps = 2000);
Cycle standing_round(const LinearTireDescription& tire, Vector<double, 2> center, double radius, double period,
                     double sense) {
    const double sx = tire.relaxation_longitudinal, sy = tire.relaxation_lateral;
    return standing_round(tire, {sx * (center[0] + radius), sy * center[1]}, radius, period, sense, 20000);
}

// The same velocities from any deflection.
Cycle standing_round(const LinearTireDescription& tire, Deflection<double> start, double radius, double period,
                     double sense, int steps) {
    const double sx = tire.relaxation_longitudinal, sy = tire.relaxation_lateral;
    const double w = sense * 2 * std::numbers::pi / period;
    const auto contact_at = [=](double t) {
        auto c = test::loaded(tire, load);
        c.v_sx = sx * radius * w * std::sin(w * t);  // u' = -v_sx: u = sx (center + radius cos w t)
        c.v_sy = -sy * radius * w * std::cos(w * t);
        return c;
    };
    return {tire, contact_at, period, steps, start};
}

// Slip at which each force alone reaches the friction limit.
double longitudinal_limit(const LinearTireDescription& tire) {
    return tire.friction / tire.longitudinal_stiffness;
}
double lateral_limit(const LinearTireDescription& tire) {
    const double x = load / tire.cornering_load;
    return tire.friction * (1 + x * x) / (2 * tire.cornering_reference / tire.cornering_load);
}

// Below both limits it is a spring: a slow cycle dissipates nothing and a fast one only the carcass damping.
TEST(TirePassivity, IsASpringAtAStandstillInsideTheLimit) {
    const auto tire = test::paper_tire();
    const double reach = longitudinal_limit(tire);
    for (const double sense : {1.0, -1.0}) {
        const Vector<double, 2> center(0.4 * reach, -0.3 * reach);
        const Cycle slow = standing_round(tire, center, 0.3 * reach, 100, sense);
        const Cycle fast = standing_round(tire, center, 0.3 * reach, 0.5, sense);
        // Fz c tau u'^2 / sigma along each axis, over a circle of k.
        const double speed = 2 * std::numbers::pi / 100 * 0.3 * reach;
        const double damped = load * tire.carcass_damping * speed * speed * 100 / 2 *
                              (tire.friction / reach * tire.relaxation_longitudinal +
                               tire.friction / lateral_limit(tire) * tire.relaxation_lateral);
        EXPECT_NEAR(slow.work(), damped, 1e-6 * damped);
        EXPECT_LT(slow.work(), 1e-3 * slow.turnover());
        EXPECT_NEAR(fast.work() / slow.work(), 200, 1e-3) << "damping is proportional to speed";
    }
}

// On an ellipse so large that it alternately sticks and slides: once the cycle is periodic, it dissipates work.
TEST(TirePassivity, AlternateStickingAndSlidingDissipates) {
    const auto tire = test::paper_tire();
    for (const double period : {0.1, 1.0, 10.0}) {
        for (const double radius : {0.06, 0.1, 0.3}) {
            for (const double sense : {1.0, -1.0}) {
                Deflection<double> start{0, 0};
                for (int i = 0; i < 20; ++i) start = standing_round(tire, start, radius, period, sense).end();
                const Cycle round = standing_round(tire, start, radius, period, sense);
                EXPECT_GT(round.work(), 0) << "period " << period << " s, radius " << radius << ", sense " << sense;
            }
        }
    }
}

struct Rolling {
    double speed;      // mean of v_x [m/s]
    double variation;  // of v_x [m/s]
    double slip;       // amplitude of the slip velocities [m/s]
};

class RandomHistories : public testing::TestWithParam<Rolling> {};

// Repeated until the deflections return to where they were; then no stored energy can be returned.
TEST_P(RandomHistories, DissipateOverACycle) {
    const auto [speed, variation, slip] = GetParam();
    const auto tire = test::paper_tire();
    std::mt19937 source(7);
    double least = 1, most = 0;
    for (int trial = 0; trial < 10; ++trial) {
        const double period = trial % 2 ? 2.0 : 0.4;
        const test::History<5> v_x(source, variation, speed), v_sx(source, slip, 0), v_sy(source, slip, 0.3 * slip);
        const auto contact_at = [&](double t) {
            const double phase = 2 * std::numbers::pi * t / period;
            auto c = test::loaded(tire, load);
            c.v_x = v_x(phase), c.v_sx = v_sx(phase), c.v_sy = v_sy(phase);
            return c;
        };
        constexpr int steps = 4000;
        Deflection<double> start{0, 0};
        double moved = 1;
        for (int round = 0; round < 300 && moved > 1e-9; ++round) {
            const auto end = Cycle(tire, contact_at, period, steps, start).end();
            moved = std::max(std::abs(end.u - start.u), std::abs(end.v - start.v));
            start = end;
        }
        ASSERT_LE(moved, 1e-9) << "the cycle must close";
        const Cycle cycle(tire, contact_at, period, steps, start);
        ASSERT_GT(cycle.turnover(), 0);
        EXPECT_GE(cycle.work(), -1e-6 * cycle.turnover()) << "trial " << trial;
        least = std::min(least, cycle.work() / cycle.turnover());
        most = std::max(most, cycle.work() / cycle.turnover());
    }
    std::printf("work over turnover: %.2e to %.3f\n", least, most);
}

INSTANTIATE_TEST_SUITE_P(Motions, RandomHistories,
                         testing::Values(Rolling{0, 0, 0.02}, Rolling{0, 0, 0.3}, Rolling{0, 0, 5},
                                         Rolling{0, 0.1, 0.05}, Rolling{0, 2, 0.5}, Rolling{1, 0, 0.1},
                                         Rolling{10, 0, 1}, Rolling{10, 5, 1}, Rolling{30, 0, 0.5},
                                         Rolling{30, 0, 10}));

}  // namespace
}  // namespace hamilcar
