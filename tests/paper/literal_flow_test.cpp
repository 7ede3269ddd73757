// The literal equations of motion in time: Newton-Euler residual, conservation laws, the energy identity with prescribed motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "paper/literal_fixture.hpp"

namespace hamilcar::paper {
namespace {

// The integrated state (Z, V, W, P_a): q and the momenta, with Qhat a function of the position.
struct State {
    Coordinates q;
    Vector P_a;
};

struct Rate {
    Vector qdot, P_a_dot;
};

class Flow : public testing::Test {
protected:
    VehicleDescription description = reference_car();
    LiteralCar car{description};
    LiteralCar stabilized{description, 60};
    LiteralCar weightless = [this] {
        VehicleDescription without = description;
        without.gravity = 0;
        return LiteralCar(without);
    }();
    Rotors p_s{30, 28, -12, 31};

    Rate rate(const LiteralCar& literal, const State& s) const {
        const Vector adot = literal.adot(s.q, s.P_a, p_s);
        return {literal.qdot(s.q, adot), literal.P_a_dot(s.q, adot, literal.gravity(s.q), p_s)};
    }

    static State moved(const LiteralCar& literal, const State& s, const Rate& f, double t) {
        return {literal.moved(s.q, f.qdot, t), s.P_a + f.P_a_dot * t};
    }

    // One step of the classical Runge-Kutta method.
    State step(const LiteralCar& literal, const State& s, double h) const {
        const Rate k1 = rate(literal, s), k2 = rate(literal, moved(literal, s, k1, h / 2));
        const Rate k3 = rate(literal, moved(literal, s, k2, h / 2)), k4 = rate(literal, moved(literal, s, k3, h));
        const Rate mean{(k1.qdot + 2 * k2.qdot + 2 * k3.qdot + k4.qdot) / 6,
                        (k1.P_a_dot + 2 * k2.P_a_dot + 2 * k3.P_a_dot + k4.P_a_dot) / 6};
        return moved(literal, s, mean, h);
    }

    Vector Yhat(const LiteralCar& literal, const State& s) const {
        return literal.BH(s.q) * literal.adot(s.q, s.P_a, p_s) + literal.BX(s.q);  // (42)
    }

    // State-space momenta of the five bodies with their wheels.
    Vector momentum(const LiteralCar& literal, const State& s) const {
        return literal.Mhat(s.q) * Yhat(literal, s) + literal.rotor_momentum(s.q, p_s);
    }

    // Kinetic and potential energy; p_s is constant, and so is the energy of the spins.
    double energy(const LiteralCar& literal, const State& s) const {
        const Vector Y = Yhat(literal, s);
        double E = 0.5 * Y.dot(literal.Mhat(s.q) * Y);
        const auto pose = literal.poses(s.q);
        for (int j = 1; j <= 5; ++j) {
            E += literal.body(j).m * description.gravity * pose[static_cast<std::size_t>(j - 1)].r.z();
        }
        return E;
    }

    State start(const LiteralCar& literal, Coordinates q) const { return {q, literal.P_a(q, general_rates(), p_s)}; }
};

double total_mass(const LiteralCar& literal) {
    double m = 0;
    for (int j = 1; j <= 5; ++j) m += literal.body(j).m;
    return m;
}

// (60)-(65) with accelerations from differences along the solution: joints open, rack moving, wheels spinning.
TEST_F(Flow, SolvesTheProjectedNewtonEulerEquations) {
    const State s = start(stabilized, violated_position(stabilized));
    const Coordinates& q = s.q;
    const auto at = [&](double t) { return step(stabilized, s, t); };
    const auto Y = [&](double t) { return Vector(stabilized.DI(at(t).q) * Yhat(stabilized, at(t))); };
    const auto rotors = [&](double t) { return stabilized.rotor_momentum(at(t).q, p_s); };
    const Vector Q = stabilized.DI(q).inverse().transpose() * stabilized.gravity(q);
    const Vector residual =
        stabilized.M(q) * derivative(Y, 1e-3) + stabilized.M_dot_Y(q, Y(0)) + derivative(rotors, 1e-3) - Q;
    const Matrix DI_BH = stabilized.DI(q) * stabilized.BH(q);
    EXPECT_GT(residual.cwiseAbs().maxCoeff(), 100);                         // the joints do carry forces
    EXPECT_LT((DI_BH.transpose() * residual).cwiseAbs().maxCoeff(), 1e-5);  // (65)
}

TEST_F(Flow, MomentumRateInFreeFallIsTheWeight) {
    const State s = start(stabilized, violated_position(stabilized));
    const Vector P_a_dot = rate(stabilized, s).P_a_dot;
    EXPECT_NEAR(P_a_dot[0], 0, 1e-9);
    EXPECT_NEAR(P_a_dot[1], 0, 1e-9);
    EXPECT_NEAR(P_a_dot[2], -total_mass(car) * description.gravity, 1e-9);
}

TEST_F(Flow, ConservesEnergyInFreeFall) {
    Coordinates q = general_position(car);
    q.q17_dot = 0;
    const State first = start(car, q);
    const double E = energy(car, first);
    for (const auto& [h, limit] : {std::pair{4e-3, 2e-12}, {2e-3, 2e-13}, {1e-3, 5e-14}}) {
        State s = first;
        double worst = 0;
        for (int i = 0; i < std::lround(0.2 / h); ++i) {
            s = step(car, s, h);
            worst = std::max(worst, std::abs(energy(car, s) - E));
        }
        EXPECT_LT(worst, limit * E) << "h = " << h << " s";
    }
}

TEST_F(Flow, ConservesMomentaWithoutGravity) {
    Coordinates q = general_position(weightless);
    q.q17_dot = 0;
    State s = start(weightless, q);
    const auto total = [&](const State& state) {
        const Vector h = momentum(weightless, state);
        return Vector(h.segment<6>(0) + h.segment<6>(6) + h.segment<6>(12) + h.segment<6>(18) + h.segment<6>(24));
    };
    const Vector before = total(s);
    for (int i = 0; i < 200; ++i) s = step(weightless, s, 1e-3);
    EXPECT_LT((total(s) - before).norm(), 1e-12 * before.norm());
}

// d/dt (T + U - x.h) = -x.Q - x'.h with x = BX, for conservative forces; docs/theory/formulation.md derives it.
TEST_F(Flow, EnergyIdentityWithPrescribedMotion) {
    const State s = start(stabilized, violated_position(stabilized));
    const auto at = [&](double t) { return step(stabilized, s, t); };
    const auto x = [&](double t) { return stabilized.BX(at(t).q); };
    const auto balance = [&](double t) { return energy(stabilized, at(t)) - x(t).dot(momentum(stabilized, at(t))); };
    const Vector x_dot = derivative(x, 2e-4);
    const double expected = -x(0).dot(stabilized.gravity(s.q)) - x_dot.dot(momentum(stabilized, s));
    const double rate_of_energy = scalar_derivative([&](double t) { return energy(stabilized, at(t)); }, 2e-4);
    EXPECT_GT(std::abs(rate_of_energy), 100);  // the prescribed motion does work
    EXPECT_NEAR(scalar_derivative(balance, 2e-4), expected, 1e-8 * std::abs(rate_of_energy));
}

}  // namespace
}  // namespace hamilcar::paper
