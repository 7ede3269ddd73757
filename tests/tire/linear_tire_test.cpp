// The linear tire against an independent implementation of its law: the steady slip force with its friction limit, stiffnesses
// of Pacejka's set, relaxation by length, mirror symmetry, and a load that only pushes.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "hamilcar/tire/contact_deflection.hpp"
#include "support/difference.hpp"
#include "tire/rolling_tire.hpp"

namespace hamilcar {
namespace {

constexpr double front_load = 3059, rear_load = 2581;  // static, per wheel of the shipped car [N]
constexpr double degree = std::numbers::pi / 180;

// Slip stiffness per load: sideways it falls with load along the curve through its peak.
double lateral_stiffness(const LinearTireDescription& tire, double load) {
    const double x = load / tire.cornering_load;
    return 2 * tire.cornering_reference / tire.cornering_load / (1 + x * x);
}

// A wheel at a constant slip (kappa_x, kappa_y), the slip velocity over the rolling speed, against its motion.
TireContact<double> slipping(const LinearTireDescription& tire, double load, double speed, double kappa_x,
                             double kappa_y) {
    TireContact<double> c = test::loaded(tire, load);
    c.v_x = speed;
    c.omega = speed / tire.rolling_radius;
    c.v_sx = -kappa_x * std::abs(speed);
    c.v_sy = -kappa_y * std::abs(speed);
    return c;
}

TEST(LinearTire, SmallSteadySlipGivesStiffnessTimesSlip) {
    const auto tire = test::paper_tire();
    const double load = front_load, kappa = 1e-3, c_y = lateral_stiffness(tire, load);
    for (const double speed : {1.0, 15.0, 40.0, -3.0}) {
        for (const double sign : {1.0, -1.0}) {
            const auto along = test::settled(tire, slipping(tire, load, speed, sign * kappa, 0));
            EXPECT_NEAR(along.Fx, sign * 20 * load * kappa, 1e-9 * load);
            EXPECT_NEAR(along.Fy, 0, 1e-9 * load);
            const auto across = test::settled(tire, slipping(tire, load, speed, 0, sign * kappa));
            EXPECT_NEAR(across.Fy, sign * c_y * load * kappa, 1e-9 * load);
            EXPECT_NEAR(across.Fx, 0, 1e-9 * load);
        }
    }
}

// Those of Pacejka's 205/60 R 15 (Tyre and Vehicle Dynamics, 2006, Table A3.1), which it approximates, at the car's static loads:
// 664 N/deg in front, 579 N/deg at the rear.
TEST(LinearTire, HasTheCorneringStiffnessOfPacejkasSet) {
    const auto tire = test::paper_tire();
    for (const auto& [load, stiffness] : {std::pair{front_load, 664.0}, std::pair{rear_load, 579.0}}) {
        const auto side_force = [&, W = load](double angle) {
            return test::settled(tire, slipping(tire, W, 20, 0, -std::tan(angle))).Fy;
        };
        EXPECT_NEAR(-test::derivative(side_force, 0.0) * degree, stiffness, 0.5);
    }
}

// In steady slip the force is C kappa inside the friction circle and as large as friction allows outside, its direction
// between that of C kappa and that of the slip.
TEST(LinearTire, CombinedSteadySlipFollowsTheFrictionCircle) {
    const auto tire = test::paper_tire();
    for (const double load : {front_load, 6000.0}) {
        const double c_y = lateral_stiffness(tire, load);
        for (const double road : {1.0, 0.4}) {
            const double limit = tire.friction * road * load;
            for (const double slip : {0.01, 0.03, 0.06, 0.09, 0.2, 1.0}) {
                for (int i = 0; i < 12; ++i) {
                    const double x = slip * std::cos(0.1 + i * std::numbers::pi / 6),
                                 y = slip * std::sin(0.1 + i * std::numbers::pi / 6);
                    auto contact = slipping(tire, load, i % 2 ? 25 : -4, x, y);
                    contact.friction = road;
                    const auto force = test::settled(tire, contact);
                    const double elastic_x = 20 * load * x, elastic_y = c_y * load * y;
                    if (std::hypot(elastic_x, elastic_y) <= limit) {
                        EXPECT_NEAR(force.Fx, elastic_x, 1e-9 * load) << slip << " " << i;
                        EXPECT_NEAR(force.Fy, elastic_y, 1e-9 * load) << slip << " " << i;
                        continue;
                    }
                    EXPECT_NEAR(std::hypot(force.Fx, force.Fy), limit, 1e-9 * load) << slip << " " << i;
                    const double against_slip = force.Fx * y - force.Fy * x;  // turned toward C kappa or not at all
                    const double against_elastic = force.Fx * elastic_y - force.Fy * elastic_x;
                    EXPECT_GE(force.Fx * x + force.Fy * y, 0);
                    EXPECT_LE(against_slip * against_elastic, 1e-12 * limit * limit) << slip << " " << i;
                }
            }
        }
    }
}

TEST(LinearTire, ForceOnALockedWheelOpposesItsSlidingVelocity) {
    const auto tire = test::paper_tire();
    for (const double angle : {0.0, 0.4, 1.2, 2.5, -2.0}) {
        auto contact = test::loaded(tire, front_load);
        contact.v_x = contact.v_sx = 12 * std::cos(angle);
        contact.v_sy = 12 * std::sin(angle);
        const auto force = test::settled(tire, contact);
        EXPECT_NEAR(force.Fx, -front_load * tire.friction * std::cos(angle), 1e-9 * front_load);
        EXPECT_NEAR(force.Fy, -front_load * tire.friction * std::sin(angle), 1e-9 * front_load);
    }
}

TireContact<double> random_contact(std::mt19937& source) {
    std::uniform_real_distribution<double> unit(-1, 1);
    return {.depth = 0.03 * unit(source),
            .depth_rate = 2 * unit(source),
            .v_sx = 30 * unit(source),
            .v_sy = 30 * unit(source),
            .v_x = 40 * unit(source),
            .omega = 150 * unit(source),
            .friction = 0.6 + 0.5 * unit(source),
            .u = 0.05 * unit(source),
            .v = 0.05 * unit(source)};
}

TEST(LinearTire, NeverLeavesTheFrictionCircleAndOnlyPushes) {
    const auto tire = test::paper_tire();
    const LinearTire<double> model(tire);
    std::mt19937 source(1);
    int touching = 0, at_limit = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto contact = random_contact(source);
        const auto force = model.force(contact);
        const double limit = tire.friction * contact.friction * force.Fz, tangential = std::hypot(force.Fx, force.Fy);
        ASSERT_LE(tangential, limit * (1 + 1e-14));
        ASSERT_GE(force.Fz, 0);
        if (force.Fz == 0) {
            ASSERT_EQ(tangential, 0);
            ASSERT_EQ(force.rolling_moment, 0);
        }
        ASSERT_TRUE(contact.depth > 0 || force.Fz == 0) << "no force without contact";
        touching += force.Fz > 0;
        at_limit += force.Fz > 0 && tangential > 0.999 * limit;
    }
    EXPECT_GT(touching, 8000);
    EXPECT_GT(at_limit, 4000);
    EXPECT_LT(at_limit, touching);
}

TEST(LinearTire, IsSymmetricToMirroringAndToTheDirectionOfRolling) {
    const LinearTire<double> model(test::paper_tire());
    std::mt19937 source(2);
    for (int i = 0; i < 1000; ++i) {
        const auto contact = random_contact(source);
        const auto force = model.force(contact);
        auto side = contact;
        side.v_sy = -side.v_sy, side.v = -side.v;
        const auto mirrored = model.force(side);
        EXPECT_EQ(mirrored.Fx, force.Fx);
        EXPECT_EQ(mirrored.Fy, -force.Fy);
        EXPECT_EQ(mirrored.Fz, force.Fz);
        EXPECT_EQ(mirrored.u_rate, force.u_rate);
        EXPECT_EQ(mirrored.v_rate, -force.v_rate);
        EXPECT_EQ(mirrored.rolling_moment, force.rolling_moment);
        auto back = contact;
        back.v_sx = -back.v_sx, back.u = -back.u, back.v_x = -back.v_x, back.omega = -back.omega;
        const auto reversed = model.force(back);
        EXPECT_EQ(reversed.Fx, -force.Fx);
        EXPECT_EQ(reversed.Fy, force.Fy);
        EXPECT_EQ(reversed.u_rate, -force.u_rate);
        EXPECT_EQ(reversed.v_rate, force.v_rate);
        EXPECT_EQ(reversed.rolling_moment, -force.rolling_moment);
    }
}

TEST(LinearTire, VerticalSpringIsTheGradientOfItsPotentialAndItsDamperResists) {
    const auto tire = test::paper_tire();
    const LinearTire<double> model(tire);
    for (const double depth : {-0.01, 0.002, 0.017, 0.04}) {
        auto contact = test::loaded(tire, 0);
        contact.depth = depth;
        const double gradient = test::derivative([&](double at) { return model.potential(at); }, depth, 1e-4);
        EXPECT_NEAR(model.force(contact).elastic, gradient, 1e-6) << "round-off of 144 J over 1e-4 m";
        EXPECT_EQ(model.force(contact).Fz, model.force(contact).elastic) << "at rest";
        for (const double rate : {-0.5, 0.5}) {
            contact.depth_rate = rate;
            const auto force = model.force(contact);
            const double damping = depth > 0 ? tire.vertical_damping * rate : 0;
            EXPECT_NEAR(force.Fz - force.elastic, damping, 1e-9);
        }
    }
}

TEST(LinearTire, BalancesForcesAtRestWithTheComputedDeflections) {
    const auto tire = test::paper_tire();
    const LinearTire<double> model(tire);
    for (const auto& [x, y] : {std::pair{0.3, 0.0}, std::pair{0.0, -0.5}, std::pair{-0.2, 0.4}}) {
        auto contact = test::loaded(tire, front_load);
        const auto deflection =
            contact_deflection(Tire<double>(model), test::loaded(tire, front_load), x * front_load, y * front_load);
        contact.u = deflection.u, contact.v = deflection.v;
        const auto force = model.force(contact);
        EXPECT_NEAR(force.Fx, x * front_load, 1e-9);
        EXPECT_NEAR(force.Fy, y * front_load, 1e-9);
        EXPECT_EQ(force.u_rate, 0) << "no slow sliding";
        EXPECT_EQ(force.v_rate, 0);
    }
}

// After a step of slip the missing force falls by e per relaxation length rolled, at any speed.
TEST(LinearTire, RelaxesByRollingDistance) {
    const auto tire = test::paper_tire();
    for (const double speed : {2.0, 20.0, -10.0}) {
        for (const bool lateral : {true, false}) {
            const double sigma = lateral ? tire.relaxation_lateral : tire.relaxation_longitudinal;
            const auto contact = slipping(tire, front_load, speed, lateral ? 0 : 0.01, lateral ? 0.01 : 0);
            const auto component = [&](const TireForce<double>& force) { return lateral ? force.Fy : force.Fx; };
            const double final_force = component(test::settled(tire, contact));
            Deflection<double> d{0, 0};
            const auto missing = [&] {
                auto at = contact;
                at.u = d.u, at.v = d.v;
                return final_force - component(LinearTire<double>(tire).force(at));
            };
            const double before = missing(), h = sigma / std::abs(speed) / 100;
            for (int i = 0; i < 100; ++i) {
                test::advance(
                    LinearTire<double>(tire), [&](double) { return contact; }, i * h, h, d);
            }
            EXPECT_NEAR(before / missing(), std::numbers::e, 1e-7) << "100 Runge-Kutta steps: 1e-8";
        }
    }
}

// Beyond the onset of sliding the excess deflection relaxes at 20 m/s per relaxation length, toward the limit.
TEST(LinearTire, SlidingRelaxesTheExcessDeflection) {
    const auto tire = test::paper_tire();
    const double limit = tire.friction / lateral_stiffness(tire, front_load);
    auto contact = test::loaded(tire, front_load);
    for (const double surplus : {0.0, 0.01, 0.5}) {
        contact.v = tire.relaxation_lateral * (limit + surplus);
        EXPECT_NEAR(LinearTire<double>(tire).force(contact).v_rate, -20 * surplus, 1e-12);
    }
}

TEST(LinearTire, RollingResistanceOpposesTheSpin) {
    const auto tire = test::paper_tire();
    auto contact = test::loaded(tire, front_load);
    contact.omega = 70;
    const double full = tire.rolling_resistance * front_load * tire.rolling_radius;
    EXPECT_NEAR(LinearTire<double>(tire).force(contact).rolling_moment, -full, 1e-3 * full);
    contact.omega = 0;
    EXPECT_EQ(LinearTire<double>(tire).force(contact).rolling_moment, 0) << "no moment on a standing wheel";
}

}  // namespace
}  // namespace hamilcar
