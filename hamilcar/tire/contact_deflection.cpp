#include "hamilcar/tire/contact_deflection.hpp"

#include <cmath>

namespace hamilcar {

// Newton's method with finite differences and step halving; zero for a tire without contact deflections.
Deflection<double> contact_deflection(const Tire<double>& tire, const TireContact<double>& contact, double Fx,
                                      double Fy) {
    constexpr double probe = 1e-6, max_step = 0.02;  // [m]
    using Pair = Vector<double, 2>;
    const auto missing = [&](const Pair& at) {
        TireContact<double> c = contact;
        c.depth_rate = c.v_sx = c.v_sy = c.v_x = c.omega = 0;
        c.u = at[0], c.v = at[1];
        const auto force = std::visit([&](const auto& model) { return model.force(c); }, tire);
        return Pair(Fx - force.Fx, Fy - force.Fy);
    };
    Pair at(0, 0), left = missing(at);
    for (int i = 0; i < 40 && left.norm() > 1e-10 * (1 + std::hypot(Fx, Fy)); ++i) {
        Matrix<double, 2, 2> slope;
        for (int j = 0; j < 2; ++j) {
            const Pair aside = probe * Pair::Unit(j);
            slope.col(j) = (missing(at - aside) - missing(at + aside)) / (2 * probe);
        }
        const double det = slope(0, 0) * slope(1, 1) - slope(0, 1) * slope(1, 0);
        if (!(std::abs(det) > 1)) break;
        Pair step(slope(1, 1) * left[0] - slope(0, 1) * left[1], slope(0, 0) * left[1] - slope(1, 0) * left[0]);
        step /= det;
        step *= std::min(1.0, max_step / step.norm());
        Pair next = missing(at + step);
        for (int half = 0; half < 12 && !(next.norm() < left.norm()); ++half) step /= 2, next = missing(at + step);
        if (!(next.norm() < left.norm())) break;
        at += step, left = next;
    }
    return {at[0], at[1]};
}

}  // namespace hamilcar
