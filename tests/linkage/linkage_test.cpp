// What makes a linkage right, for every suspension on the list: H, X, J, x and all their rates are derivatives of the
// assembled positions, in exact mode (closed loops) and in the paper's (open loops that close at alpha).
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <set>

#include "linkage/moving.hpp"

namespace hamilcar {
namespace {

using test::for_every_linkage;
using test::gain;
using test::step;

constexpr double by_difference = 1e-9;  // round-off over the step, 1e-12, times entries up to some hundreds

constexpr std::array times{0.0, 0.21, 0.55};

TEST(Linkage, EverySuspensionOfTheListIsTestedHere) {
    std::set<std::size_t> kinds;
    for (const CornerDescription& corner : test::paper_car().corners) kinds.insert(corner.suspension.index());
    EXPECT_EQ(kinds.size(), std::variant_size_v<Suspension<double>>) << "add a corner with the new suspension";
}

TEST(Linkage, StandsAtTheIdentityAndClosedAtDesign) {
    for_every_linkage([](const auto&, const auto& moving) {
        using M = std::decay_t<decltype(moving)>;
        const auto at = moving.position(moving.design(), M::Dependent::Zero(), {});
        EXPECT_LE(test::difference(at.pose, {Mat3<double>::Identity(), Vec3<double>::Zero()}), 1e-15);
        for (int i = 0; i < M::nW; ++i) EXPECT_NEAR(at.Phi[i], 0, 1e-15);
    });
}

TEST(Linkage, HIsTheDerivativeOfTheAssembledDependentCoordinates) {
    for_every_linkage([](const auto&, const auto& moving) {
        using M = std::decay_t<decltype(moving)>;
        for (const double t : times) {
            const auto V = moving.V(t);
            const auto at = moving.position(V, moving.closed(V, moving.rack(t)), moving.rack(t));
            for (int i = 0; i < M::nV; ++i) {
                const auto W = [&](double value) {
                    auto varied = V;
                    varied[i] = value;
                    return moving.closed(varied, moving.rack(t));
                };
                const typename M::Dependent expected = test::derivative(W, V[i], step);
                EXPECT_LE((at.H.col(i) - expected).norm(), by_difference);
            }
        }
    });
}

TEST(Linkage, XIsWhatAMovingRackDoesToTheClosedLoops) {
    for_every_linkage([](const auto&, const auto& moving) {
        using M = std::decay_t<decltype(moving)>;
        if constexpr (M::nW > 0) {
            for (const double t : times) {
                const auto V = moving.V(t);
                const auto rack = moving.rack(t);
                const auto W = [&](double displacement) { return moving.closed(V, {displacement, 0, 0}); };
                const typename M::Dependent expected = test::derivative(W, rack.displacement, step) * rack.rate;
                EXPECT_LE((moving.position(V, W(rack.displacement), rack).X - expected).norm(), by_difference);
                EXPECT_GT(expected.norm(), 0.1);
            }
        }
    });
}

// On open loops: Phi_w X + Phi_t + alpha Phi = 0 with Phi_w, Phi_t from differences; det Phi_w on the way.
TEST(Linkage, XOnOpenLoopsAddsTheStabilization) {
    for_every_linkage([](const auto&, const auto& moving) {
        using M = std::decay_t<decltype(moving)>;
        if constexpr (M::nW > 0) {
            for (const double t : times) {
                const auto V = moving.V(t);
                const auto rack = moving.rack(t);
                const typename M::Dependent W = moving.opened(t);
                Matrix<double, M::nW, M::nW> Phi_w;
                for (int i = 0; i < M::nW; ++i) {
                    const auto Phi = [&](double value) {
                        auto varied = W;
                        varied[i] = value;
                        return moving.position(V, varied, rack).Phi;
                    };
                    Phi_w.col(i) = test::derivative(Phi, W[i], step);
                }
                const auto Phi_at = [&](double displacement) {
                    return moving.position(V, W, {displacement, 0, 0}).Phi;
                };
                const typename M::Dependent Phi_t = test::derivative(Phi_at, rack.displacement, step) * rack.rate;
                const auto at = moving.position(V, W, rack, gain);
                EXPECT_GT(at.Phi.norm(), 1e-3) << "the loops must be open";
                EXPECT_LE((Phi_w * at.X + Phi_t + gain * at.Phi).norm(), by_difference);
                EXPECT_NEAR(at.determinant, Phi_w.determinant(), by_difference);
            }
        }
    });
}

// J V' + x is the carrier's motion; `rates` gives what J, x and W do along the way, rack acceleration included.
template <class M, class WAt>
void check_motion_and_rates(const M& moving, const WAt& W_at, double t, double alpha) {
    const auto at_time = [&](double at) { return moving.position(moving.V(at), W_at(at), moving.rack(at), alpha); };
    const auto at = at_time(t);
    const Spatial<double> motion = test::motion_of([&](double x) { return at_time(x).pose; }, t, step);
    EXPECT_LE((at.J * moving.V_rate(t) + at.x - motion).norm(), by_difference);

    const auto rates = moving.linkage().rates(at, moving.V_rate(t), moving.rack(t));
    const Spatial<double> drift_rate = moving.linkage().drift_rate(at, rates, moving.rack(t), alpha);
    if constexpr (M::nW > 0) {
        EXPECT_LE((rates.W - test::derivative(W_at, t, step)).norm(), by_difference);
    }
    const Matrix<double, 6, M::nV> J_rate = test::derivative([&](double x) { return at_time(x).J; }, t, step);
    const Spatial<double> x_rate = test::derivative([&](double x) { return at_time(x).x; }, t, step);
    EXPECT_LE((rates.J - J_rate).norm(), by_difference * (1 + J_rate.norm()));
    EXPECT_LE((drift_rate - x_rate).norm(), by_difference * (1 + x_rate.norm()));
    if constexpr (M::nW > 0) {
        EXPECT_GT(J_rate.norm(), 0.1) << "a rate that is there";
        EXPECT_GT(x_rate.norm(), 0.1);
    }
}

TEST(Linkage, RatesFollowTheClosedLoops) {
    for_every_linkage([](const auto&, const auto& moving) {
        const auto W_at = [&](double t) { return moving.closed(moving.V(t), moving.rack(t)); };
        for (const double t : times) check_motion_and_rates(moving, W_at, t, 0);
    });
}

TEST(Linkage, RatesFollowTheStabilizedLoops) {
    for_every_linkage([](const auto&, const auto& moving) {
        for (const double t : times) {
            const auto W_at = [&](double at) { return moving.stabilized(t, at); };
            check_motion_and_rates(moving, W_at, t, gain);
        }
    });
}

// Halving the distance to the solution quarters what one step leaves.
TEST(Linkage, NewtonStepConvergesQuadratically) {
    for_every_linkage([](const auto&, const auto& moving) {
        using M = std::decay_t<decltype(moving)>;
        if constexpr (M::nW > 0) {
            const auto V = moving.V(0.21);
            const auto rack = moving.rack(0.21);
            const typename M::Dependent solution = moving.closed(V, rack);
            const auto left_by = [&](double offset) {
                typename M::Dependent W = solution + offset * M::Dependent::Ones();
                moving.linkage().newton_step(V.data(), W.data(), rack);
                return (W - solution).norm();
            };
            for (const double offset : {2e-2, 1e-2, 5e-3}) {
                EXPECT_NEAR(std::log2(left_by(offset) / left_by(offset / 2)), 2, 0.1);
            }
        }
    });
}

TEST(Linkage, LinesChangeLengthAsTheirGradientAndDriftSay) {
    for_every_linkage([](const auto& suspension, const auto& moving) {
        const auto check = [&](const auto& line) {
            const auto line_at = [&](double t) {
                const auto V = moving.V(t);
                return line(moving.position(V, moving.closed(V, moving.rack(t)), moving.rack(t)), V.data());
            };
            for (const double t : times) {
                const double expected = test::derivative([&](double x) { return line_at(x).length; }, t, step);
                EXPECT_NEAR(line_at(t).rate(moving.V_rate(t)), expected, by_difference);
            }
        };
        check(suspension.spring_line);
        check(suspension.damper_line);
    });
}

}  // namespace
}  // namespace hamilcar
