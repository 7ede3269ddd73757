// Cut joints: the loops are opened here and closed by equations Phi = 0 between a point P carried by the spoke and the
// chassis (paper, section 3). All a cut joint states is Phi, its gradient g with respect to P's position, and the rate
// of g; for a column (l ; e) of B the Jacobian entry is g.(l + e x P), which is the whole of A.3.
//
// A cut joint provides: `equations`, `name`, `tip` (P at design), `driven` (whether the rack moves its chassis end along
// `drive_axis`), `evaluate(P, rack, phi, g)` and `gradient_rates(P_rate, rack_rate)`, a Zero where a gradient is constant.
#pragma once

#include <string_view>
#include <tuple>

#include "hamilcar/math/motion.hpp"

namespace hamilcar {

// A massless control arm: hinged to the chassis about an axis through `foot`, a ball at the tip.  // RS, (21), (22)
template <class T>
struct RevoluteSpherical {
    static constexpr int equations = 2;
    static constexpr bool driven = false;
    static constexpr std::string_view name = "revolute-spherical";
    Vec3<T> foot, axis;  // on the chassis; the foot is the axis point nearest to the tip at design
    Vec3<T> tip;         // on the carrier, at design
    T length;            // [m]
    static constexpr auto members() {
        return std::tuple(&RevoluteSpherical::foot, &RevoluteSpherical::axis, &RevoluteSpherical::tip,
                          &RevoluteSpherical::length);
    }

    template <class Phi, class Gradients>
    void evaluate(const Vec3<T>& P, const T&, Phi phi, Gradients g) const {
        const Vec3<T> d = P - foot;  // (22)
        phi[0] = axis.dot(d);        // (21)
        phi[1] = d.squaredNorm() - length * length;
        g.col(0) = axis;
        g.col(1) = T(2) * d;
    }
    std::tuple<Zero, Vec3<T>> gradient_rates(const Vec3<T>& P_rate, const T&) const { return {Zero{}, T(2) * P_rate}; }
    T opening(const Vec3<T>& P, const T&) const {
        const Vec3<T> d = P - foot;
        const T along = axis.dot(d), across = sqrt(d.squaredNorm()) - length;
        return sqrt(along * along + across * across);
    }
};

// A massless rod with two balls; its chassis end may sit on the rack.  // D, (23), (24)
template <class T>
struct Distance {
    static constexpr int equations = 1;
    static constexpr bool driven = true;
    static constexpr std::string_view name = "distance";
    Vec3<T> end;         // on the chassis, at rack displacement zero
    Vec3<T> tip;         // on the carrier, at design
    Vec3<T> drive_axis;  // of the rack, unit
    T length;            // [m]
    static constexpr auto members() {
        return std::tuple(&Distance::end, &Distance::tip, &Distance::drive_axis, &Distance::length);
    }

    template <class Phi, class Gradients>
    void evaluate(const Vec3<T>& P, const T& rack, Phi phi, Gradients g) const {
        const Vec3<T> d = P - end - drive_axis * rack;  // (24)
        phi[0] = d.squaredNorm() - length * length;     // (23)
        g.col(0) = T(2) * d;
    }
    std::tuple<Vec3<T>> gradient_rates(const Vec3<T>& P_rate, const T& rack_rate) const {
        return {T(2) * (P_rate - drive_axis * rack_rate)};
    }
    T opening(const Vec3<T>& P, const T& rack) const {
        return abs(sqrt((P - end - drive_axis * rack).squaredNorm()) - length);
    }
};

}  // namespace hamilcar
