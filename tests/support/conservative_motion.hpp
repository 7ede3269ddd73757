// The time that a conservative mechanism with one degree of freedom takes from one angle to another, without
// equations of motion: from T + U = E with T = M(q) q'^2 / 2 follows t = integral of sqrt(M / (2 (E - U))) dq. M
// comes from differences of the closed-form poses, the integral from Gauss's rule: no code is shared with the program
// under test.
#pragma once

#include "support/difference.hpp"
#include "support/mechanisms.hpp"

namespace hamilcar::test {

class ConservativeMotion {
public:
    // From an angle of the crank with a rate, [rad] and [rad/s].
    ConservativeMotion(const Mechanism& mechanism, double angle, double rate)
        : m_(mechanism), start_(angle), energy_(0.5 * inertia(angle) * rate * rate + potential(angle)) {}

    double energy() const { return energy_; }  // [J]
    double rate(double angle) const { return std::sqrt(2 * (energy_ - potential(angle)) / inertia(angle)); }
    // As long as the crank keeps turning forward [s].
    double time_to(double angle) const {
        constexpr std::array<double, 3> node{0, 0.5384693101056831, 0.9061798459386640},
            weight{0.5688888888888889, 0.4786286704993665,
                   0.2369268850561891};  // five points, Abramowitz & Stegun 25.4.30
        const int pieces = 1 + static_cast<int>(std::abs(angle - start_) / 0.02);
        const double half = (angle - start_) / pieces / 2;
        double sum = 0;
        for (int i = 0; i < pieces; ++i) {
            const double middle = start_ + (2 * i + 1) * half;
            sum += weight[0] / rate(middle);
            for (std::size_t k = 1; k < 3; ++k) {
                sum += weight[k] * (1 / rate(middle - half * node[k]) + 1 / rate(middle + half * node[k]));
            }
        }
        return sum * half;
    }

private:
    double potential(double angle) const {
        const Poses at = m_.poses(angle);
        double sum = 0;
        for (std::size_t i = 0; i < at.size(); ++i) sum -= mass(i) * m_.gravity.dot(at[i].point(center(i)));
        return sum;
    }
    // M(q): twice the kinetic energy at unit rate.
    double inertia(double angle) const {
        double sum = 0;
        for (std::size_t i = 0; i < m_.suspension.bodies.size(); ++i) {
            const BodyDescription& b = m_.suspension.bodies[i].body;
            const Mat3<double> R = m_.poses(angle).at(i).R;
            const Vec v = derivative([&](double q) { return Vec(m_.poses(q)[i].point(center(i))); }, angle);
            const Mat3<double> R_rate = derivative([&](double q) { return Mat3<double>(m_.poses(q)[i].R); }, angle);
            const Mat3<double> W = R.transpose() * R_rate;
            const Vec w(W(2, 1), W(0, 2), W(1, 0));  // in the body's axes at design
            Mat3<double> I;
            I << b.inertia[0], b.products[0], b.products[2], b.products[0], b.inertia[1], b.products[1], b.products[2],
                b.products[1], b.inertia[2];
            sum += b.mass * v.squaredNorm() + w.dot(I * w);
        }
        return sum;
    }
    double mass(std::size_t i) const { return m_.suspension.bodies[i].body.mass; }
    Vec center(std::size_t i) const {
        const Point& c = m_.suspension.bodies[i].body.center_of_mass;
        return {c[0], c[1], c[2]};
    }

    const Mechanism& m_;
    double start_, energy_;
};

}  // namespace hamilcar::test
