// A tire with slip curves dissipates work over any closed cycle: rolling, or moved back and forth along one direction at a
// standstill, with constant load and symmetric curves without camber. Moved around a closed curve at a standstill it can release
// some work, since forces at combined slip have no potential over the deflection. The amount is measured and bounded here.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tire/history.hpp"
#include "tire/slip_models.hpp"

namespace hamilcar {
namespace {

using test::SlipModel;

struct Motion {
    std::string name;
    double speed;      // mean of v_x [m/s]
    double variation;  // of v_x [m/s]
    double slip;       // amplitude of the slip velocities [m/s]
    bool along = true, across = true;
};

struct Work {
    double sum = 0, turnover = 0;  // that slip puts into the contact, and its size taken over [J]
    Deflection<double> end{};
};

template <class ContactAt>
Work once_round(const Tire<double>& tire, const ContactAt& contact_at, double period, Deflection<double> start) {
    constexpr int steps = 1000;
    Work work{.end = start};
    const double h = period / steps;
    const auto power = [&](double t) {
        TireContact<double> c = contact_at(t);
        c.u = work.end.u, c.v = work.end.v;
        const auto f = test::force(tire, c);
        return -(f.Fx * c.v_sx + f.Fy * c.v_sy);
    };
    double first = power(0);
    for (int i = 0; i < steps; ++i) {  // Simpson's rule over two half steps
        const double t = i * h;
        test::advance(tire, contact_at, t, h / 2, work.end);
        const double middle = power(t + h / 2);
        test::advance(tire, contact_at, t + h / 2, h / 2, work.end);
        const double last = power(t + h);
        work.sum += h / 6 * (first + 4 * middle + last);
        work.turnover += h / 6 * (std::abs(first) + 4 * std::abs(middle) + std::abs(last));
        first = last;
    }
    return work;
}

// The least work over turnover of random closed cycles.
double least_share(const SlipModel& model, const Motion& motion, int trials) {
    const Tire<double> tire = make_tire<double>(model.description);
    const TireContact<double> still = test::loaded(tire, model.load);
    std::mt19937 source(7);
    double least = 1;
    int closed = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const double period = trial % 2 ? 2.0 : 0.4;
        const test::History<3> v_x(source, motion.variation, motion.speed);
        const test::History<3> v_sx(source, motion.along ? motion.slip : 0, 0),
            v_sy(source, motion.across ? motion.slip : 0, 0);
        const auto contact_at = [&](double t) {
            const double phase = 2 * std::numbers::pi * t / period;
            auto c = still;
            c.v_x = v_x(phase), c.v_sx = v_sx(phase), c.v_sy = v_sy(phase);
            return c;
        };
        Work work;
        double moved = 1;
        for (int round = 0; round < 60 && moved > 1e-8; ++round) {
            const auto start = work.end;
            work = once_round(tire, contact_at, period, start);
            moved = std::max(std::abs(work.end.u - start.u), std::abs(work.end.v - start.v));
        }
        if (moved > 1e-8) continue;  // not yet periodic: its stored energy may still change
        ++closed;
        least = std::min(least, work.sum / work.turnover);
    }
    EXPECT_GE(2 * closed, trials) << "most cycles must close for a meaningful test";
    std::printf("%-8s %-18s least work over turnover %9.2e, %d of %d closed\n", model.name.c_str(), motion.name.c_str(),
                least, closed, trials);
    return least;
}

class SlipPassivity : public testing::TestWithParam<SlipModel> {};

TEST_P(SlipPassivity, RollingDissipates) {
    for (const Motion& motion :
         {Motion{"slow", 1, 0, 0.1}, Motion{"rolling", 10, 0, 1}, Motion{"changing speed", 10, 2, 1},
          Motion{"fast", 30, 0, 0.5}, Motion{"fast and sliding", 30, 0, 10}}) {
        EXPECT_GE(least_share(GetParam(), motion, 6), -1e-6) << motion.name;
    }
}

TEST_P(SlipPassivity, MotionAlongOneDirectionAtAStandstillDissipates) {
    for (const double slip : {0.02, 0.3, 3.0}) {
        EXPECT_GE(least_share(GetParam(), {"standing, along", 0, 0, slip, true, false}, 4), -1e-6);
        EXPECT_GE(least_share(GetParam(), {"standing, across", 0, 0, slip, false, true}, 4), -1e-6);
    }
}

// Moved once around an ellipse inside its limits, so slowly that carcass damping vanishes: center and size in shares of D / K.
double share_of_a_round(const SlipModel& model, std::mt19937& source) {
    const Tire<double> tire = make_tire<double>(model.description);
    const auto at = test::curve(tire, model.load, 1, {}).limits;
    const double reach_x = test::length(at.relaxation_x, 0) * at.friction_x / at.stiffness_x;
    const double reach_y = test::length(at.relaxation_y, 0) * at.friction_y / at.stiffness_y;
    std::uniform_real_distribution<double> unit(0, 1);
    const double away = 0.7 * unit(source), phase = 2 * std::numbers::pi * unit(source);
    const double x = away * std::cos(phase), y = away * std::sin(phase), size = (0.98 - away) * unit(source);
    constexpr double period = 1000;
    const double w = (source() % 2 ? 1 : -1) * 2 * std::numbers::pi / period;
    const TireContact<double> still = test::loaded(tire, model.load);
    const auto contact_at = [&](double t) {
        auto c = still;
        c.v_sx = reach_x * size * w * std::sin(w * t), c.v_sy = -reach_y * size * w * std::cos(w * t);
        return c;
    };
    const Work work = once_round(tire, contact_at, period, {reach_x * (x + size), reach_y * y});
    EXPECT_NEAR(work.end.u, reach_x * (x + size), 1e-9) << "it sticks, so the cycle closes";
    return work.sum / work.turnover;
}

// Only curves whose forces have a potential over the
// deflection release nothing; none of these do.
TEST_P(SlipPassivity, ClosedCurvesAtAStandstillReleaseNoMoreThanMeasured) {
    const auto [inside, beyond] = GetParam().released;
    std::mt19937 source(8);
    double least = 1;
    for (int i = 0; i < 200; ++i) least = std::min(least, share_of_a_round(GetParam(), source));
    std::printf("%-8s %-18s least work over turnover %9.2e\n", GetParam().name.c_str(), "round, sticking", least);
    EXPECT_GE(least, -inside);
    for (const double slip : {0.02, 0.05, 0.3}) {  // sticking and sliding in turn
        EXPECT_GE(least_share(GetParam(), {"standing, round", 0, 0, slip}, 6), -beyond) << slip;
    }
}

INSTANTIATE_TEST_SUITE_P(Models, SlipPassivity, testing::ValuesIn(test::slip_models()),
                         [](const auto& model) { return model.param.name; });

}  // namespace
}  // namespace hamilcar
