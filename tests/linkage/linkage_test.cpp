// What makes a linkage right, for one of every recipe, every kind of tree joint behind every other and every kind of cut
// joint: columns, gradients, H, X, J, x and all their rates are derivatives of positions alone, with closed loops and with
// the paper's, which are open and close at alpha.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "linkage/kind_samples.hpp"
#include "linkage/moving.hpp"

namespace hamilcar {
namespace {

using test::gain;
using test::LinkageSample;
using test::MovingLinkage;
using test::step;
using Dependent = MovingLinkage::Dependent;
using Position = MovingLinkage::Position;

constexpr double by_difference = 1e-9;        // round-off over the step, 1e-12, times entries up to some hundreds
constexpr double by_wide_difference = 1e-11;  // at a step of 1e-3 without loops to close
constexpr std::array times{0.0, 0.21, 0.55};

// Relative to numbers of order one and beyond.
void expect_near(const Eigen::VectorXd& value, const Eigen::VectorXd& expected, const char* what) {
    EXPECT_LE((value - expected).norm(), by_difference * (1 + expected.norm())) << what;
}

class Linkages : public testing::TestWithParam<LinkageSample> {
protected:
    Linkages() : moving_(GetParam().linkage), linkage_(moving_.linkage()) {}

    bool is_driven() const {
        return std::ranges::any_of(GetParam().linkage.cuts, [](const auto& cut) { return cut.drive != Point{}; });
    }
    // Far from design, every loop open.
    std::array<double, max_coordinates> anywhere() const {
        std::array<double, max_coordinates> q{};
        for (int k = 0; k < linkage_.nq(); ++k) q[k] = 0.6 * std::sin(0.7 * k + 0.4);
        return q;
    }

    MovingLinkage moving_;
    const Linkage<double>& linkage_;
};

TEST_P(Linkages, StandAtTheIdentityAndClosedAtDesign) {
    const Position at = moving_.position({}, Dependent::Zero(), {});
    for (int frame = 0; frame <= linkage_.nq(); ++frame) {
        EXPECT_LE(test::difference(at.pose[frame].pose(), {Mat3<double>::Identity(), Vec3<double>::Zero()}), 1e-15);
    }
    for (int e = 0; e < linkage_.nW(); ++e) EXPECT_NEAR(at.Phi[e], 0, 1e-15);
}

TEST_P(Linkages, CloseOverTheTravel) {
    for (const double t : times) {
        const Position at = moving_.closed_position(moving_.V(t), moving_.rack(t));
        for (int e = 0; e < linkage_.nW(); ++e) EXPECT_NEAR(linkage_.violation(e, at), 0, 1e-14);
    }
}

// For each coordinate: the frames it carries move by its column of B, all others stay.
TEST_P(Linkages, ColumnsAreTheMotionsOfTheirCoordinates) {
    const auto q = anywhere();
    const Position at = moving_.loops(q, {});
    for (int k = 0; k < linkage_.nq(); ++k) {
        for (int frame = 1; frame <= linkage_.nq(); ++frame) {
            const auto pose_at = [&](double value) {
                auto varied = q;
                varied[k] = value;
                return moving_.loops(varied, {}).pose[frame].pose();
            };
            const Spatial<double> moved = test::motion_of(pose_at, q[k]);
            const Vec3<double> at_anchor = velocity_at<double>(moved, linkage_.anchor());
            const bool is_moved = (linkage_.path[frame] >> k) & 1;
            EXPECT_EQ(is_moved, moved.norm() > 0.9) << "a unit rate must show";
            const Spatial<double> column = is_moved ? at.B[k] : Spatial<double>::Zero();
            expect_near(column, spatial<double>(at_anchor, angular(moved)), "B");
        }
    }
}

TEST_P(Linkages, EntriesAreTheDerivativesOfPhi) {
    const auto q = anywhere();
    const auto rack = moving_.rack(0.55);
    const Position at = moving_.loops(q, rack);
    for (int e = 0; e < linkage_.nW(); ++e) {
        for (int k = 0; k < linkage_.nq(); ++k) {
            const auto Phi = [&](double value) {
                auto varied = q;
                varied[k] = value;
                return moving_.loops(varied, rack).Phi[e];
            };
            EXPECT_NEAR(linkage_.entry(at, e, k), test::derivative(Phi, q[k]), by_wide_difference);
        }
        const auto Phi = [&](double displacement) { return moving_.loops(q, {displacement, 0, 0}).Phi[e]; };
        const LoopEquation<double>& equation = linkage_.equations[e];
        const Vec3<double> u = at.pose[equation.base].direction(equation.drive);
        EXPECT_NEAR(-at.gradient[e].dot(u), test::derivative(Phi, rack.displacement), by_wide_difference);
        EXPECT_GT(at.gradient[e].norm(), 0.05) << "an equation that binds nothing";
    }
}

TEST_P(Linkages, HAndXAreDerivativesOfTheAssembledCoordinates) {
    for (const double t : times) {
        const auto V = moving_.V(t);
        const auto rack = moving_.rack(t);
        const Position at = moving_.closed_position(V, rack);
        const auto rows = [&](const auto& of_coordinate) {
            Dependent out = Dependent::Zero();
            for (int i = 0; i < linkage_.nW(); ++i) out[i] = of_coordinate(linkage_.dependent[i]);
            return out;
        };
        for (int j = 0; j < linkage_.nV(); ++j) {
            const auto W = [&](double value) {
                auto varied = V;
                varied[j] = value;
                return moving_.closed(varied, rack);
            };
            expect_near(rows([&](int k) { return at.Y[k][j]; }), test::derivative(W, V[j], step), "H");
        }
        const auto W = [&](double displacement) { return moving_.closed(V, {displacement, 0, 0}); };
        const Dependent expected = test::derivative(W, rack.displacement, step) * rack.rate;
        expect_near(rows([&](int k) { return at.X[k]; }), expected, "X");
        EXPECT_EQ(expected.norm() > 1e-3, is_driven());
    }
}

// On open loops: Phi_w X + Phi_t + alpha Phi = 0 with Phi_w, Phi_t from differences; det Phi_w on the way.
TEST_P(Linkages, XOnOpenLoopsIncludesTheStabilization) {
    const int n = linkage_.nW();
    if (n == 0) return;
    for (const double t : times) {
        const auto V = moving_.V(t);
        const auto rack = moving_.rack(t);
        const Dependent W = moving_.opened(t);
        const auto Phi_at = [&](const Dependent& dependent, double displacement) {
            return Eigen::VectorXd(
                Eigen::Map<const Eigen::VectorXd>(moving_.position(V, dependent, {displacement, 0, 0}).Phi.data(), n));
        };
        Eigen::MatrixXd Phi_w(n, n);
        Eigen::VectorXd X(n);
        const Position at = moving_.position(V, W, rack, gain);
        for (int i = 0; i < n; ++i) {
            const auto Phi = [&](double value) {
                Dependent varied = W;
                varied[i] = value;
                return Phi_at(varied, rack.displacement);
            };
            Phi_w.col(i) = test::derivative(Phi, W[i], step);
            X[i] = at.X[linkage_.dependent[i]];
        }
        const Eigen::VectorXd Phi = Phi_at(W, rack.displacement);
        const Eigen::VectorXd Phi_t =
            test::derivative([&](double x) { return Phi_at(W, x); }, rack.displacement, step) * rack.rate;
        EXPECT_GT(Phi.norm(), 1e-3) << "the loops must be open";
        expect_near(Phi_w * X, -Phi_t - gain * Phi, "X");
        EXPECT_NEAR(std::abs(at.determinant), std::abs(Phi_w.determinant()), by_difference);
    }
}

TEST_P(Linkages, MotionsAreTheDerivativesOfPoses) {
    for (const double t : times) {
        const auto V = moving_.V(t);
        const Position at = moving_.closed_position(V, moving_.rack(t));
        for (int frame = 1; frame <= linkage_.nq(); ++frame) {
            for (int j = 0; j < linkage_.nV(); ++j) {
                const auto pose_at = [&](double V_j) {
                    auto varied = V;
                    varied[j] = V_j;
                    return moving_.closed_position(varied, moving_.rack(t)).pose[frame].pose();
                };
                expect_near(at.motion.J[frame].col(j), test::motion_of(pose_at, V[j], step), "J");
            }
            const auto pose_at = [&](double s) {
                return moving_.closed_position(V, moving_.rack(s)).pose[frame].pose();
            };
            expect_near(at.motion.x[frame], test::motion_of(pose_at, t, step), "x");
        }
    }
}

// Concatenated, so that one difference quotient covers all of them.
template <class Part>
Eigen::VectorXd in_a_row(int count, int size, const Part& part) {
    Eigen::VectorXd out(count * size);
    for (int i = 0; i < count; ++i) out.segment(i * size, size) = part(i);
    return out;
}

// J V' + x is the motion of the frames; `find_rates` gives the rates of columns, wrenches, J, x and W along it, rack
// acceleration included.
template <class WAt>
void check_motion_and_rates(const MovingLinkage& moving, const WAt& W_at, double t, double alpha) {
    const Linkage<double>& linkage = moving.linkage();
    const int nq = linkage.nq(), nV = linkage.nV(), nW = linkage.nW();
    const auto rack = moving.rack(t);
    const auto V_rate = moving.V_rate(t);
    const auto at_time = [&](double s) { return moving.position(moving.V(s), W_at(s), moving.rack(s), alpha); };
    const auto rate_of = [&](const auto& seen) {
        return Eigen::VectorXd(test::derivative([&](double s) { return Eigen::VectorXd(seen(at_time(s))); }, t, step));
    };
    const Position at = at_time(t);
    LinkageRates<double> rates;
    linkage.find_rates(at, V_rate, rack, rates);
    std::array<Spatial<double>, max_frames> x_rate;
    linkage.find_prescribed_rates(at, rates, rack, alpha, x_rate);

    for (int frame = 1; frame <= nq; ++frame) {
        const auto pose_at = [&](double s) { return at_time(s).pose[frame].pose(); };
        const Spatial<double> v = test::motion_of(pose_at, t, step);
        expect_near(rates.v[frame], spatial<double>(velocity_at<double>(v, linkage.anchor()), angular(v)), "v");
        Spatial<double> sum = at.motion.x[frame];
        for (int j = 0; j < nV; ++j) sum += at.motion.J[frame].col(j) * V_rate[j];
        expect_near(sum, v, "J V' + x");
    }
    const Dependent W_rate = test::derivative(W_at, t, step);
    for (int i = 0; i < nW; ++i) EXPECT_NEAR(rates.q[linkage.dependent[i]], W_rate[i], by_difference);
    const auto columns = [&](const auto& of) { return in_a_row(nq, 6, [&](int k) { return of.B[k]; }); };
    const auto wrenches = [&](const auto& of) { return in_a_row(nW, 6, [&](int e) { return of.wrench[e]; }); };
    const auto motions = [&](const auto& of) {
        return in_a_row(nq * nV, 6, [&](int i) { return of.motion.J[1 + i / nV].col(i % nV); });
    };
    const auto drifts = [&](const auto& of) { return in_a_row(nq, 6, [&](int k) { return of[k + 1]; }); };
    const Eigen::VectorXd J_rate = rate_of(motions);
    expect_near(columns(rates), rate_of(columns), "B'");
    expect_near(wrenches(rates), rate_of(wrenches), "wrench'");
    expect_near(motions(rates), J_rate, "J'");
    expect_near(drifts(x_rate), rate_of([&](const Position& p) { return drifts(p.motion.x); }), "x'");
    EXPECT_TRUE(nW == 0 || J_rate.norm() > 1e-3) << "a rate that is there";
}

TEST_P(Linkages, RatesFollowTheClosedLoops) {
    const auto W_at = [&](double t) { return moving_.closed(moving_.V(t), moving_.rack(t)); };
    for (const double t : times) check_motion_and_rates(moving_, W_at, t, 0);
}

TEST_P(Linkages, RatesFollowTheStabilizedLoops) {
    if (linkage_.nW() == 0) return;
    for (const double t : times) {
        const auto W_at = [&](double s) { return moving_.stabilized(t, s); };
        check_motion_and_rates(moving_, W_at, t, gain);
    }
}

// Halving the distance to the solution quarters what one step leaves.
TEST_P(Linkages, NewtonStepConvergesQuadratically) {
    if (linkage_.nW() == 0) return;
    const auto V = moving_.V(0.21);
    const auto rack = moving_.rack(0.21);
    const Dependent solution = moving_.closed(V, rack);
    const auto left_by = [&](double offset) {
        Dependent W = solution + offset * Dependent::Ones();
        linkage_.newton_step(V.data(), W.data(), rack);
        return (W - solution).head(linkage_.nW()).norm();
    };
    for (const double offset : {2e-3, 1e-3, 5e-4}) {
        EXPECT_NEAR(std::log2(left_by(offset) / left_by(offset / 2)), 2, 0.1);
    }
}

// Between points of two parts, along or about coordinates, and the height of a point.
TEST_P(Linkages, LinesChangeLengthByGradientAndPrescribedRate) {
    const int last = linkage_.nq();
    const Vec3<double> outer(0.02, 0.62, 0.25), inner(-0.05, 0.4, 0.6);
    const std::array lines{
        ForceLine<double>{last, 0, -1, outer, inner, 0}, ForceLine<double>{last, 1, -1, outer, inner, 0},
        ForceLine<double>{1, 0, 0, inner, outer, 0.5}, ForceLine<double>{1, 0, last - 1, inner, outer, 0.5}};
    const auto at_time = [&](double t, auto&& see) {
        const auto V = moving_.V(t);
        const Dependent W = moving_.closed(V, moving_.rack(t));
        return see(moving_.position(V, W, moving_.rack(t)), V, W);
    };
    const auto check = [&](const auto& see) {
        for (const double t : times) {
            const LineOfAction<double> line = at_time(t, see);
            double rate = line.prescribed_rate;
            for (int j = 0; j < linkage_.nV(); ++j) rate += line.gradient[j] * moving_.V_rate(t)[j];
            const auto length = [&](double s) { return at_time(s, see).length; };
            EXPECT_NEAR(rate, test::derivative(length, t, step), by_difference);
        }
    };
    for (const ForceLine<double>& line : lines) {
        check([&](const Position& at, const auto& V, const Dependent& W) {
            return linkage_.line(line, at, V.data(), W.data());
        });
    }
    check([&](const Position& at, const auto&, const Dependent&) {
        LineOfAction<double> height;
        const Vec3<double> p = at.pose[last].point(outer);
        height.length = p[2];
        linkage_.along(Vec3<double>::UnitZ(), p, last, 0, at.own, height);
        return height;
    });
}

INSTANTIATE_TEST_SUITE_P(Recipes, Linkages, testing::ValuesIn(test::recipe_samples()),
                         [](const auto& one) { return one.param.name; });
INSTANTIATE_TEST_SUITE_P(Kinds, Linkages, testing::ValuesIn(test::kind_samples()),
                         [](const auto& one) { return one.param.name; });

TEST(Recipes, EveryRecipeHasASampleWithARegularPartition) {
    const std::vector<LinkageSample> samples = test::recipe_samples();
    for (const LinkageSample& sample : samples) {
        const PartitionResult verdict = choose_partition(sample.linkage, sample.wheels);
        EXPECT_EQ(verdict.problem, "") << sample.name;
        EXPECT_EQ(verdict.degrees_of_freedom, static_cast<int>(sample.wheels.size())) << sample.name;
    }
    for (const Recipe* recipe : recipes()) {
        EXPECT_TRUE(std::ranges::any_of(samples, [&](const auto& s) { return s.keyword == recipe->keyword; }))
            << recipe->keyword;
    }
}

}  // namespace
}  // namespace hamilcar
