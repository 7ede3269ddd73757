// Linkages of any shape: what they say of motions and forces against differences of their poses alone, for one linkage of
// every recipe, and against the program that is compiled for a strut.
#include "hamilcar/linkage/compose.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "linkage/composed_samples.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

using test::ComposedSample;
constexpr double step = 1e-4;

// A linkage that moves as its independent coordinates and the rack are told, its loops closed.
class MovingComposed {
public:
    explicit MovingComposed(const LinkageDescription& d) : linkage_(compose(d)) {}
    const ComposedLinkage<double>& linkage() const { return linkage_; }

    std::array<double, max_freedoms> V(double t) const {
        std::array<double, max_freedoms> V{};
        for (int i = 0; i < linkage_.nV(); ++i) V[i] = 0.04 * std::sin(7 * t + 0.3 + i);
        return V;
    }
    std::array<double, max_freedoms> V_rate(double t) const {
        std::array<double, max_freedoms> rate{};
        for (int i = 0; i < linkage_.nV(); ++i) rate[i] = 0.28 * std::cos(7 * t + 0.3 + i);
        return rate;
    }
    static RackMotion<double> rack(double t) {
        return {0.02 * std::sin(5 * t - 0.4), 0.1 * std::cos(5 * t - 0.4), -0.5 * std::sin(5 * t - 0.4)};
    }
    ComposedPosition<double> at(const std::array<double, max_freedoms>& V, const RackMotion<double>& rack) const {
        std::array<double, max_equations> W{};
        for (int i = 0; i < 12; ++i) linkage_.newton_step(V.data(), W.data(), rack);
        ComposedPosition<double> out;
        linkage_.find_position(V.data(), W.data(), rack, 0.0, out);
        return out;
    }
    ComposedPosition<double> at(double t) const { return at(V(t), rack(t)); }

private:
    ComposedLinkage<double> linkage_;
};

// Motion of a frame whose pose is pose_at(x), per unit of x, about the hub's origin.
template <class PoseAt>
Spatial<double> motion_of(PoseAt&& pose_at, double x) {
    const Mat3<double> R = pose_at(x).R;
    const Mat3<double> R_rate = test::derivative([&](double s) { return Mat3<double>(pose_at(s).R); }, x, step);
    const Vec3<double> p_rate = test::derivative([&](double s) { return Vec3<double>(pose_at(s).p); }, x, step);
    const Mat3<double> W = R_rate * R.transpose();
    const Vec3<double> w = 0.5 * Vec3<double>(W(2, 1) - W(1, 2), W(0, 2) - W(2, 0), W(1, 0) - W(0, 1));
    return spatial<double>(p_rate - w.cross(pose_at(x).p), w);
}

class ComposedLinkages : public testing::TestWithParam<ComposedSample> {};

TEST_P(ComposedLinkages, ClosesItsLoopsOverTheTravel) {
    const MovingComposed moving(GetParam().linkage);
    const auto at = moving.at(0.2);
    for (int e = 0; e < moving.linkage().nW(); ++e) EXPECT_NEAR(moving.linkage().opening(e, at), 0, 1e-14);
}

TEST_P(ComposedLinkages, MotionsAreTheDerivativesOfPoses) {
    const MovingComposed moving(GetParam().linkage);
    const double t = 0.2;
    const auto at = moving.at(t);
    for (int frame = 1; frame <= moving.linkage().nq(); ++frame) {
        for (int j = 0; j < moving.linkage().nV(); ++j) {
            const Spatial<double> J = motion_of(
                [&](double V_j) {
                    auto V = moving.V(t);
                    V[j] = V_j;
                    return moving.at(V, moving.rack(t)).pose[frame];
                },
                moving.V(t)[j]);
            EXPECT_LT((at.motion.J[frame].col(j) - J).norm(), 2e-9) << "frame " << frame;
        }
        const Spatial<double> x =
            motion_of([&](double s) { return moving.at(moving.V(t), moving.rack(s)).pose[frame]; }, t);
        EXPECT_LT((at.motion.x[frame] - x).norm(), 2e-9) << "frame " << frame;
    }
}

TEST_P(ComposedLinkages, RatesAreTheDerivativesOfMotions) {
    const MovingComposed moving(GetParam().linkage);
    const ComposedLinkage<double>& linkage = moving.linkage();
    const double t = 0.2;
    const auto at = moving.at(t);
    ComposedRates<double> rates;
    linkage.find_rates(at, moving.V_rate(t), moving.rack(t), rates);
    std::array<Spatial<double>, max_frames> x_rate;
    linkage.find_drift_rates(at, rates, moving.rack(t), 0.0, x_rate);
    for (int frame = 1; frame <= linkage.nq(); ++frame) {
        const Spatial<double> v = motion_of([&](double s) { return moving.at(s).pose[frame]; }, t);
        EXPECT_LT((rates.v[frame] - v).norm(), 1e-8) << "frame " << frame;
        for (int j = 0; j < linkage.nV(); ++j) {
            const Spatial<double> J_rate = test::derivative(
                [&](double s) { return Spatial<double>(moving.at(s).motion.J[frame].col(j)); }, t, step);
            EXPECT_LT((rates.motion.J[frame].col(j) - J_rate).norm(), 1e-7) << "frame " << frame;
        }
        const Spatial<double> rate = test::derivative([&](double s) { return moving.at(s).motion.x[frame]; }, t, step);
        EXPECT_LT((x_rate[frame] - rate).norm(), 1e-7) << "frame " << frame;
    }
}

TEST_P(ComposedLinkages, PartitionOfTheRecipeIsRegular) {
    const MovingComposed moving(GetParam().linkage);
    std::vector<CarriedPoint> wheels = GetParam().wheels;
    const LinkageVerdict verdict = choose_partition(GetParam().linkage, wheels);
    EXPECT_EQ(verdict.problem, "");
    EXPECT_EQ(verdict.freedoms, static_cast<int>(wheels.size()));
}

TEST(Recipes, EveryRecipeHasASample) {
    for (const Recipe* recipe : recipes()) {
        const auto samples = test::composed_samples();
        EXPECT_TRUE(std::ranges::any_of(samples, [&](const auto& s) { return s.keyword == recipe->keyword; }))
            << recipe->keyword;
    }
}

INSTANTIATE_TEST_SUITE_P(Recipes, ComposedLinkages, testing::ValuesIn(test::composed_samples()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace hamilcar
