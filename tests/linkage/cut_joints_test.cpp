// What makes a cut joint a cut joint: Phi is zero where the parts meet, its gradient and the gradient's rate are
// derivatives of Phi, the rack enters as Phi_t = -g.u rack', and the opening is a length. A new one is one line below.
#include <gtest/gtest.h>

#include <numbers>

#include "hamilcar/linkage/cut_joints.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

constexpr double by_difference = 1e-11;  // Phi is quadratic: a fourth-order difference leaves round-off alone

template <class Cut>
struct Evaluated {
    Vector<double, Cut::equations> phi;
    Matrix<double, 3, Cut::equations> g;
};
template <class Cut>
Evaluated<Cut> evaluated(const Cut& cut, const Vec3<double>& P, double rack) {
    Evaluated<Cut> out;
    cut.evaluate(P, rack, out.phi.data(), Eigen::Ref<Matrix<double, 3, Cut::equations>>(out.g));
    return out;
}

// Points around the tip, closed and far from closed, with a rack displacement each.
struct Sample {
    Vec3<double> shift;
    double rack;
};
const std::array samples{Sample{{0, 0, 0}, 0}, Sample{{0.02, -0.05, 0.08}, 0.03}, Sample{{-0.4, 0.3, 0.2}, -0.07}};

template <class Cut>
void check_gradient(const Cut& cut) {
    for (const auto& [shift, rack] : samples) {
        const Vec3<double> P = cut.tip + shift;
        const auto at = evaluated(cut, P, rack);
        for (int axis = 0; axis < 3; ++axis) {
            const auto phi = [&, x = rack](double coordinate) {
                Vec3<double> moved = P;
                moved[axis] = coordinate;
                return evaluated(cut, moved, x).phi;
            };
            const Vector<double, Cut::equations> expected = test::derivative(phi, P[axis]);
            EXPECT_LE((at.g.row(axis).transpose() - expected).norm(), by_difference);
        }
        for (int i = 0; i < Cut::equations; ++i) EXPECT_GT(at.g.col(i).norm(), 0.1) << "an equation that binds nothing";
    }
}

template <class Cut>
void check_gradient_rate(const Cut& cut) {
    const Vec3<double> velocity(0.7, -0.4, 1.1), curvature(0.5, 0.9, -0.3);
    constexpr double rack_rate = 0.6;
    const auto P_at = [&](double t) { return Vec3<double>(cut.tip + velocity * t + curvature * t * t); };
    const auto g_at = [&](double t) { return evaluated(cut, P_at(t), rack_rate * t).g; };
    for (const double t : {0.0, 0.2}) {
        const auto rates = cut.gradient_rates(Vec3<double>(velocity + 2 * curvature * t), rack_rate);
        Matrix<double, 3, Cut::equations> g_rate;
        int i = 0;
        std::apply([&](const auto&... rate) { ((g_rate.col(i++) = as_vector<double>(rate)), ...); }, rates);
        ASSERT_EQ(i, Cut::equations);
        EXPECT_LE((g_rate - test::derivative(g_at, t)).norm(), by_difference);
    }
}

// dPhi/drack is -g.u for a driven joint (the paper prints +, (28)) and nothing for any other.
template <class Cut>
void check_drive(const Cut& cut) {
    for (const auto& [shift, rack] : samples) {
        const Vec3<double> P = cut.tip + shift;
        const auto phi = [&](double displacement) { return evaluated(cut, P, displacement).phi; };
        const Vector<double, Cut::equations> by_rack = test::derivative(phi, rack);
        if constexpr (Cut::driven) {
            const Vector<double, Cut::equations> expected = -evaluated(cut, P, rack).g.transpose() * cut.drive_axis;
            EXPECT_LE((by_rack - expected).norm(), by_difference);
            EXPECT_GT(by_rack.norm(), 0.1);
        } else {
            EXPECT_EQ(by_rack.norm(), 0);
        }
    }
}

template <class Cut>
void check_closed_at_design(const Cut& cut) {
    EXPECT_LE(evaluated(cut, cut.tip, 0).phi.cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LE(cut.opening(cut.tip, 0), 1e-15);
}

// All laws of a cut joint that is closed at design.
template <class Cut>
void check_cut_joint(const Cut& cut) {
    SCOPED_TRACE(Cut::name);
    check_closed_at_design(cut);
    check_gradient(cut);
    check_gradient_rate(cut);
    check_drive(cut);
}

const Vec3<double> foot(0.1, 0.3, 0.2), axis = Vec3<double>(0.96, 0.2, 0.1).normalized();
const Vec3<double> across = axis.cross(Vec3<double>::UnitZ()).normalized();
constexpr double arm_length = 0.35;
const RevoluteSpherical<double> arm{foot, axis, foot + arm_length* across, arm_length};

const Vec3<double> inner(0.1, 0.32, 0.21), outer(0.12, 0.7, 0.19);
const Distance<double> rod{inner, outer, Vec3<double>(0.1, 0.99, -0.05).normalized(), (outer - inner).norm()};

TEST(CutJoint, RevoluteSpherical) {
    check_cut_joint(arm);
}
TEST(CutJoint, Distance) {
    check_cut_joint(rod);
}

// The tip may move on a circle about the axis; the opening is the distance to it, up to second order in itself.
TEST(RevoluteSphericalOpening, IsTheDistanceToTheCircle) {
    for (const Vec3<double>& shift : {Vec3<double>(1e-3, 2e-3, -1e-3), Vec3<double>(-5e-3, 1e-3, 4e-3)}) {
        const Vec3<double> P = arm.tip + shift;
        double nearest = 1;
        for (int i = -20000; i <= 20000; ++i) {
            const double turn = 0.05 * i / 20000;
            const Vec3<double> at = foot + arm_length * (std::cos(turn) * across + std::sin(turn) * axis.cross(across));
            nearest = std::min(nearest, (P - at).norm());
        }
        EXPECT_NEAR(arm.opening(P, 0), nearest, shift.squaredNorm() / arm_length);
    }
    const Vec3<double> turned = foot + arm_length * (std::cos(0.8) * across + std::sin(0.8) * axis.cross(across));
    EXPECT_LE(arm.opening(turned, 0), 1e-15) << "a joint that has only turned is closed";
}

TEST(DistanceOpening, IsTheMissingOrSurplusLength) {
    const Vec3<double> along = (outer - inner).normalized();
    EXPECT_NEAR(rod.opening(outer + 3e-3 * along, 0), 3e-3, 1e-15);
    EXPECT_NEAR(rod.opening(outer - 3e-3 * along, 0), 3e-3, 1e-15);
    EXPECT_NEAR(rod.opening(outer + 0.02 * rod.drive_axis, 0.02), 0, 1e-15) << "carried along by the rack";
}

}  // namespace
}  // namespace hamilcar
