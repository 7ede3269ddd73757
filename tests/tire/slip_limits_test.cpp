// Tires with slip curves at their limits: values of the curves at known points, bounds of combined forces, and continuity
// whatever passes through zero.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tire/slip_models.hpp"

namespace hamilcar {
namespace {

using test::SlipModel;

// Worked by hand from the formulas of the Adams/Tire help for a Fiala tire.
TEST(FialaTire, GivesTheValuesComputedByHand) {
    FialaDescription d = test::worked_fiala();
    d.cornering_stiffness = 800 * 180 / std::numbers::pi;
    d.static_friction = 1, d.sliding_friction = 0.9, d.width = 0.235;
    const auto at = [](const FialaDescription& tire, double load, double kappa, double slope) {
        return test::curve(make_tire<double>(TireDescription(tire)), load, 1, {kappa, slope, 1, 10}).forces;
    };
    const auto pure = at(d, 3000, 0, std::tan(0.05));
    EXPECT_NEAR(pure.Fy, -1756.3820, 1e-4);
    EXPECT_NEAR(pure.Mz, 73.9539, 1e-4);
    EXPECT_EQ(pure.Fx, 0);
    // There Fx = 3194.5056 and Fy = -3372.1876 pass the friction; here both are scaled down to it.
    const double slope = std::tan(0.2), friction = 0.9 - 0.2 * std::hypot(0.2, slope);
    const auto both = at(test::worked_fiala(), 4000, 0.2, slope);
    EXPECT_NEAR(both.Fx / both.Fy, 3194.5056 / -3372.1876, 1e-7);
    EXPECT_NEAR(std::hypot(both.Fx, both.Fy), friction * 4000, 1e-6);
    EXPECT_EQ(both.Mz, 0);
}

// Parabolic pressure: F = mu Fz (1 - (1 - rho)^3), and full sliding beyond rho = 1.
TEST(BrushTire, GivesTheClosedFormAndItsLargestTrail) {
    const Tire<double> tire = make_tire<double>(TireDescription(test::worked_brush()));
    const auto side = [&](double slope) { return test::curve(tire, 4000, 1, {0, slope, 1, 10}).forces; };
    for (const double slope : {0.02, 0.1, 0.19}) {
        const double left = 1 - 60e3 * slope / (3 * 4000);
        EXPECT_NEAR(side(slope).Fy, -4000 * (1 - left * left * left), 1e-6);
    }
    EXPECT_NEAR(side(0.3).Fy, -4000, 1e-6);
    EXPECT_NEAR(side(0.3).Mz, 0, 1e-6);
    EXPECT_NEAR(-side(1e-4).Mz / side(1e-4).Fy, 0.075 / 3, 1e-4) << "a sixth of the contact length";
}

// Worked by hand from the closed form: mu Fz = 3000 N; K s = 60e3 kappa / (1 + kappa), -38e3 tan(alpha) / (1 + kappa).
TEST(DugoffTire, GivesTheValuesComputedByHand) {
    const Tire<double> tire = make_tire<double>(TireDescription(test::dugoff_tire()));
    const auto at = [&](double kappa, double slope) {
        return test::curve(tire, 3000, 1, {kappa, slope, 1, 10}).forces;
    };
    EXPECT_NEAR(at(0.02, 0).Fx, 1176.470588, 1e-5) << "below half the friction all of the contact sticks";
    EXPECT_NEAR(at(0.1, 0).Fx, 2587.5, 1e-6) << "lambda 0.275";
    EXPECT_NEAR(at(0, 0.1).Fy, -2407.894737, 1e-5) << "lambda 15 / 38";
    EXPECT_NEAR(at(0.1, 0.1).Fx, 2240.048028, 1e-5);
    EXPECT_NEAR(at(0.1, 0.1).Fy, -1418.697084, 1e-5);
}

// The curves pass the points that describe them: slope at zero, peak, full sliding, the two zeros of the trail.
TEST(TmeasyTire, PassesThePointsThatDescribeIt) {
    const auto d = test::truck_tire();
    const Tire<double> tire = make_tire<double>(TireDescription(d));
    for (const int i : {0, 1}) {
        const double load = (1 + i) * d.nominal_load;
        const auto along = [&](double s) {  // s = kappa / (1 + kappa)
            return test::curve(tire, load, 1, {s / (1 - s), 0, 1, 10}).forces.Fx;
        };
        const auto across = [&](double s) { return test::curve(tire, load, 1, {0, s, 1, 10}).forces; };
        const auto &x = d.longitudinal[i], &y = d.lateral[i];
        EXPECT_NEAR(along(1e-5) / 1e-5, x.stiffness, 2e-3 * x.stiffness);
        EXPECT_NEAR(along(x.peak_slip), x.peak_force, 1e-6 * x.peak_force);
        EXPECT_NEAR(along(0.99), x.sliding_force, 1e-6 * x.sliding_force) << "beyond the start of sliding";
        EXPECT_NEAR(across(1e-5).Fy / 1e-5, -y.stiffness, 2e-3 * y.stiffness);
        EXPECT_NEAR(across(y.peak_slip).Fy, -y.peak_force, 1e-6 * y.peak_force);
        EXPECT_NEAR(across(2 * y.sliding_slip).Fy, -y.sliding_force, 1e-6 * y.sliding_force);
        EXPECT_NEAR(across(d.trail_vanishes[i]).Mz, 0, 1e-9 * load);
        EXPECT_LT(across(0.5 * (d.trail_vanishes[i] + d.trail_ends[i])).Mz, 0) << "beyond, it turns the other way";
        EXPECT_EQ(across(2 * d.trail_ends[i]).Mz, 0);
    }
}

class SlipLimitsOf : public testing::TestWithParam<SlipModel> {
protected:
    const Tire<double> tire = make_tire<double>(GetParam().description);
};

// (Fx / D_x)^2 + (Fy / D_y)^2, its root's largest value over random slips and loads. The Magic Formula weights each force by
// itself and adds a side force of its own to a driven wheel, so it may exceed the ellipse; TMeasy takes the size of its force
// from an ellipse over the direction of slip, not of force. The excess of each is measured.
TEST_P(SlipLimitsOf, CombinedForcesStayNearTheEllipse) {
    std::mt19937 source(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    double largest = 0;
    for (int i = 0; i < 100000; ++i) {
        const double reach = std::pow(10, 1.5 * unit(source) - 1.3), phase = 7 * unit(source);
        const double kappa = std::max(reach * std::cos(phase), -1.0), slope = reach * std::sin(phase);
        const auto at = test::curve(tire, GetParam().load * (1 + 0.7 * unit(source)), 1, {kappa, slope, 1, 10});
        largest =
            std::max(largest, std::hypot(at.forces.Fx / at.limits.friction_x, at.forces.Fy / at.limits.friction_y));
    }
    EXPECT_LE(largest, GetParam().ellipse + 1e-9);
    EXPECT_GT(largest, 0.99) << "and they reach it";
    std::printf("largest share of the ellipse: %.4f\n", largest);
}

// Sums of harmonics: everything goes through zero now and then, and v_x alone at a slip of 90 degrees.
class Path {
public:
    Path(std::mt19937& source, double depth) : depth_(depth) {
        std::uniform_real_distribution<double> unit(-1, 1);
        for (auto& terms : terms_) {
            for (double& term : terms) term = unit(source);
        }
    }
    TireContact<double> operator()(double s) const {
        const auto at = [&](int i, double size) {
            double sum = 0;
            for (int n = 0; n < 3; ++n) {
                sum += terms_[i][2 * n] * std::cos((n + 1) * s) + terms_[i][2 * n + 1] * std::sin((n + 1) * s);
            }
            return size * sum;
        };
        return {
            .depth = std::abs(at(0, depth_)) - 0.2 * depth_,  // no speed of its own: the damper starts with the contact
            .depth_rate = 0,
            .v_sx = at(1, 0.5),
            .v_sy = at(2, 0.5),
            .v_x = at(3, 2),
            .camber = at(4, 0.05),
            .omega = at(5, 5),
            .friction = 0.6 + at(6, 0.1),
            .u = at(7, 0.01),
            .v = at(8, 0.01)};
    }

private:
    double depth_;
    std::array<std::array<double, 6>, 10> terms_;
};

// A jump is equally large over half a step; a continuous quantity changes by half as much.
TEST_P(SlipLimitsOf, IsContinuous) {
    std::mt19937 source(5);
    const double depth = test::loaded(tire, GetParam().load).depth;
    for (int trial = 0; trial < 4; ++trial) {
        const Path path(source, depth);
        const auto largest = [&](int steps) {
            std::array<double, 8> most{}, last{};
            for (int i = 0; i <= steps; ++i) {
                const auto f = test::force(tire, path(2 * std::numbers::pi * i / steps));
                const std::array now{f.Fx, f.Fy, f.Fz, f.Mx, f.Mz, f.rolling_moment, f.u_rate, f.v_rate};
                for (std::size_t k = 0; i > 0 && k < now.size(); ++k)
                    most[k] = std::max(most[k], std::abs(now[k] - last[k]));
                last = now;
            }
            return most;
        };
        const auto coarse = largest(100000), fine = largest(200000);
        for (std::size_t k = 0; k < coarse.size(); ++k) {
            EXPECT_LE(fine[k], 0.7 * coarse[k] + 1e-9) << "output " << k << ", trial " << trial;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, SlipLimitsOf, testing::ValuesIn(test::slip_models()),
                         [](const auto& model) { return model.param.name; });

}  // namespace
}  // namespace hamilcar
