// Curves by other routes than the models' own formulas: bristle by bristle, and read off what a description says.
#include <gtest/gtest.h>

#include <cmath>

#include "tire/slip_models.hpp"

namespace hamilcar {
namespace {

// A row of bristles under a parabolic pressure, each as far deflected as it has traveled since it touched the road, but never
// beyond its friction. Bristle slips s_x, s_y are over the rolling speed.
SlipForces<double> bristles(const BrushDescription& d, double load, double s_x, double s_y) {
    const double share = load / d.nominal_load, a = 0.5 * d.contact_length * std::sqrt(share);
    const double c_x = d.longitudinal_stiffness * share / (2 * a * a),
                 c_y = d.cornering_stiffness * share / (2 * a * a);
    SlipForces<double> sum{};
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        const double x = a * (1 - 2 * (i + 0.5) / count), width = 2 * a / count;  // from the leading edge backward
        const double limit = 0.75 * d.friction * load / a * (1 - x * x / (a * a));
        const double q_x = c_x * s_x * (a - x), q_y = -c_y * s_y * (a - x);
        const double kept = std::min(1.0, limit / std::hypot(q_x, q_y));
        sum.Fx += kept * q_x * width, sum.Fy += kept * q_y * width, sum.Mz += kept * q_y * x * width;
    }
    return sum;
}

TEST(Brush, IsARowOfBristles) {
    const BrushDescription d = test::worked_brush();
    const Tire<double> tire = make_tire<double>(d);
    for (const double load : {1500.0, 4000.0, 7000.0}) {
        for (const auto& [kappa, slope] :
             {std::pair{0.02, 0.0}, {0.05, -0.03}, {-0.08, 0.06}, {0.0, 0.1}, {0.3, 0.2}}) {
            const auto is = test::curve(tire, load, 1, {kappa, slope, 1, 20}).forces;
            const auto should = bristles(d, load, kappa / (1 + kappa), slope / (1 + kappa));
            EXPECT_NEAR(is.Fx, should.Fx, 1e-5 * load) << load << " " << kappa << " " << slope;
            EXPECT_NEAR(is.Fy, should.Fy, 1e-5 * load) << load << " " << kappa << " " << slope;
            EXPECT_NEAR(is.Mz, should.Mz, 1e-6 * load) << load << " " << kappa << " " << slope;
        }
    }
}

// At the slips that the description names, straight and at both of its loads. A braked wheel's slip over the rolling speed is
// -kappa / (1 + kappa).
TEST(Tmeasy, HasItsPeaksAndItsSliding) {
    const TmeasyDescription d = test::truck_tire();
    const Tire<double> tire = make_tire<double>(d);
    for (const std::size_t i : {0u, 1u}) {
        const double load = d.nominal_load * static_cast<double>(i + 1);
        const auto braked = [&](double s) { return test::curve(tire, load, 1, {-s / (1 + s), 0, 1, 20}).forces.Fx; };
        const auto cornering = [&](double s) { return test::curve(tire, load, 1, {0, -s, 1, 20}).forces.Fy; };
        const TmeasyCurve &x = d.longitudinal[i], &y = d.lateral[i];
        EXPECT_NEAR(braked(x.peak_slip), -x.peak_force, 1e-6 * load);
        EXPECT_NEAR(braked(x.sliding_slip), -x.sliding_force, 1e-6 * load);
        EXPECT_NEAR(braked(2 * x.sliding_slip), -x.sliding_force, 1e-6 * load);
        EXPECT_NEAR(cornering(y.peak_slip), y.peak_force, 1e-6 * load);
        EXPECT_NEAR(cornering(y.sliding_slip), y.sliding_force, 1e-6 * load);
        EXPECT_NEAR(cornering(1.5 * y.sliding_slip), y.sliding_force, 1e-6 * load);
    }
}

// Sliding begins so soon behind the peak that two parabolas do not fit between them.
TEST(Tmeasy, FallsToItsSlidingWhereThatComesEarly) {
    TmeasyDescription d = test::truck_tire();
    for (TmeasyCurve& y : d.lateral) y.sliding_slip = 1.1 * y.peak_slip, y.sliding_force = 0.8 * y.peak_force;
    d.trail_ends = {0.9, 0.9};
    const Tire<double> tire = make_tire<double>(d);
    const auto at = [&](double s) { return test::curve(tire, d.nominal_load, 1, {0, -s, 1, 20}).forces.Fy; };
    const TmeasyCurve& y = d.lateral[0];
    EXPECT_NEAR(at(y.peak_slip), y.peak_force, 1e-6 * y.peak_force);
    EXPECT_NEAR(at(0.5 * (y.peak_slip + y.sliding_slip)), 0.9 * y.peak_force, 1e-6 * y.peak_force);
    EXPECT_NEAR(at(y.sliding_slip), y.sliding_force, 1e-6 * y.peak_force);
}

// The trail is given over the contact's length, which grows with the root of the load; at next to no slip the moment is their
// product with the side force.
TEST(Tmeasy, TrailGrowsWithTheContactLength) {
    const TmeasyDescription d = test::truck_tire();
    const Tire<double> tire = make_tire<double>(d);
    for (const std::size_t i : {0u, 1u}) {
        const double load = d.nominal_load * static_cast<double>(i + 1);
        const auto F = test::curve(tire, load, 1, {0, -1e-5, 1, 20}).forces;
        const double length = 2 * std::sqrt(2 * d.casing.radius * load / d.casing.vertical_stiffness);
        EXPECT_NEAR(-F.Mz / F.Fy, d.trail[i] * length, 1e-4 * length);
    }
}

TEST(SlipTire, StiffensAndStoresWhatItsForceDoes) {
    FialaDescription d = test::worked_fiala();
    d.casing.vertical_growth = 2e6;
    const Tire<double> tire = make_tire<double>(d);
    double work = 0;
    constexpr int count = 2000;
    constexpr double depth = 0.03, step = depth / count;
    const auto elastic = [&](double at) {
        TireContact<double> c{};
        c.depth = at, c.friction = 1;
        return test::force(tire, c).elastic;
    };
    for (int i = 0; i < count; ++i) work += step * elastic((i + 0.5) * step);
    EXPECT_NEAR(elastic(depth), 200e3 * depth + 2e6 * depth * depth, 1e-9);
    EXPECT_NEAR(std::visit([&](const auto& model) { return model.potential(depth); }, tire), work, 1e-6 * work);
}

// 1 % of the load as a force at the rolling radius, against the spin, forward and backward.
TEST(SlipTire, RollingResistanceIsAgainstTheSpin) {
    const FialaDescription d = test::worked_fiala();
    const Tire<double> tire = make_tire<double>(d);
    for (const double omega : {-60.0, 60.0}) {
        TireContact<double> c = test::loaded(tire, 4000);
        c.v_x = omega * d.casing.rolling_radius, c.omega = omega;
        EXPECT_NEAR(test::force(tire, c).rolling_moment, (omega > 0 ? -1 : 1) * 0.01 * 4000 * d.casing.rolling_radius,
                    0.01);
    }
}

}  // namespace
}  // namespace hamilcar
