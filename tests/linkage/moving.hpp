// Linkages to test on: every corner of the shipped car, and a carrier that hangs by a ball on a swinging arm, whose
// dependent columns move with the independent coordinate as no shipped suspension's do. Each with a motion of its own.
#pragma once

#include <gtest/gtest.h>

#include "linkage/motion.hpp"
#include "support/car.hpp"

namespace hamilcar::test {

inline constexpr double step = 1e-4;  // of differences [s, m, rad]
inline constexpr double gain = 40;    // alpha of the open loops [1/s]

// An arm hinged to the chassis carries a ball; an upper arm and a tie rod hold the carrier upright.
template <class T>
struct BallOnArm {
    using Linkage =
        hamilcar::Linkage<T, std::tuple<Revolute<T>, BryantSpherical<T>>, std::tuple<RevoluteSpherical<T>, Distance<T>>,
                          Coordinates<0>, Coordinates<1, 2, 3>>;
    Linkage linkage;
    PointLine<T> spring_line{{0.02, 0.5, 0.75}, {0, 0.62, 0.22}}, damper_line{{-0.1, 0.48, 0.7}, {-0.05, 0.66, 0.2}};
    std::array<double, 1> design{0};

    BallOnArm() {
        const Vec3<T> hinge(-0.05, 0.3, 0.2), ball(0.01, 0.68, 0.17), foot(0.03, 0.42, 0.5), top(0.02, 0.65, 0.52);
        const Vec3<T> upper = Vec3<T>(0.98, 0.15, -0.1).normalized(), inner(0.13, 0.33, 0.25), outer(0.12, 0.69, 0.22);
        linkage.joints = {Revolute<T>{hinge, Vec3<T>(0.97, -0.2, 0.05).normalized()}, BryantSpherical<T>{ball}};
        const Vec3<T> nearest = foot + upper * upper.dot(top - foot);
        linkage.cuts = {RevoluteSpherical<T>{nearest, upper, top, (top - nearest).norm()},
                        Distance<T>{inner, outer, Vec3<T>::UnitY(), (outer - inner).norm()}};
    }
};

// A linkage with a motion of its own: independent coordinates and rack are given functions of time.
template <class S>
class Moving {
public:
    using Linkage = typename S::Linkage;
    static constexpr int nV = Linkage::nV, nW = Linkage::nW;
    using Independent = Vector<double, nV>;
    using Dependent = Vector<double, nW>;

    explicit Moving(const S& suspension) : suspension_(suspension) {}
    const Linkage& linkage() const { return suspension_.linkage; }
    Independent design() const { return Eigen::Map<const Independent>(suspension_.design.data()); }
    Independent V(double t) const {
        Independent V = design();
        for (int i = 0; i < nV; ++i) V[i] += 0.06 * std::sin(7 * t + 0.3 + i);
        return V;
    }
    Independent V_rate(double t) const {
        Independent rate;
        for (int i = 0; i < nV; ++i) rate[i] = 0.42 * std::cos(7 * t + 0.3 + i);
        return rate;
    }
    RackMotion<double> rack(double t) const {
        return {0.03 * std::sin(5 * t - 0.4), 0.15 * std::cos(5 * t - 0.4), -0.75 * std::sin(5 * t - 0.4)};
    }
    auto position(const Independent& V, const Dependent& W, const RackMotion<double>& rack, double alpha = 0) const {
        return linkage().position(V.data(), W.data(), rack, alpha);
    }
    // W on the closed loops.
    Dependent closed(const Independent& V, const RackMotion<double>& rack) const {
        Dependent W = Dependent::Zero();
        for (int i = 0; i < 12; ++i) linkage().newton_step(V.data(), W.data(), rack);
        return W;
    }
    Dependent opened(double t) const {
        Dependent W = closed(V(t), rack(t));
        for (int i = 0; i < nW; ++i) W[i] += 0.02 * std::cos(2.0 * i + 1);
        return W;
    }
    // W at t on the flow W' = H V' + X that starts open at t0: Runge-Kutta steps a quarter of the difference's.
    Dependent stabilized(double t0, double t) const {
        const auto rate = [&](double at, const Dependent& W) {
            const auto p = position(V(at), W, rack(at), gain);
            return Dependent(p.H * V_rate(at) + p.X);
        };
        const double h = (t - t0) / 8;
        Dependent W = opened(t0);
        for (int i = 0; i < 8; ++i) {
            const double at = t0 + i * h;
            const Dependent k1 = rate(at, W), k2 = rate(at + h / 2, W + h / 2 * k1),
                            k3 = rate(at + h / 2, W + h / 2 * k2), k4 = rate(at + h, W + h * k3);
            W += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        return W;
    }

private:
    S suspension_;
};

// Calls check(suspension, moving) for every one of them.
template <class Check>
void for_every_linkage(Check&& check) {
    for (const CornerDescription& corner : test::paper_car().corners) {
        SCOPED_TRACE(corner.name);
        std::visit([&](const auto& s) { check(s, Moving<std::decay_t<decltype(s)>>(s)); },
                   make_suspension<double>(corner.suspension));
    }
    SCOPED_TRACE("ball on an arm");
    check(BallOnArm<double>{}, Moving(BallOnArm<double>{}));
}

}  // namespace hamilcar::test
