// Charts: coordinates for the chassis's orientation and momentum. Both describe the same physics, the total linear
// momentum p and the total angular momentum L about the moving chassis origin, in ground axes:
//     p' = F,   L' = N_O - r' x p
//
// Quaternion: (p, L) themselves with a unit quaternion; no singularity, linear invariants kept exactly.
// Bryant: the paper's Z = (r, q14, q15, q16) with P_Z = B_1^T (p, L) = (p ; D^T L), singular at q15 = 90 degrees.
#pragma once

#include "hamilcar/math/rotation.hpp"
#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

// The physical rates, which a chart converts to those of its coordinates.
template <class T>
struct ChassisRates {
    Vec3<T> velocity;          // of the chassis origin, ground axes
    Vec3<T> angular_velocity;  // ground axes
    Vec3<T> angular_velocity_chassis;
    Spatial<T> momentum;       // (p ; L)
    Spatial<T> momentum_rate;  // (p' ; L')
};

template <class T>
struct QuaternionChart {
    static Mat3<T> rotation(const Vector<T, 4>& orientation) { return quaternion_rotation<T>(orientation); }
    static Spatial<T> momentum(const Vector<T, 4>&, const Spatial<T>& stored) { return stored; }
    static Spatial<T> stored_momentum(const Vector<T, 4>&, const Spatial<T>& momentum) { return momentum; }
    static Vector<T, 4> orientation_rate(const Vector<T, 4>& orientation, const ChassisRates<T>& rates) {
        return quaternion_rate<T>(orientation, rates.angular_velocity_chassis);
    }
    static Spatial<T> stored_momentum_rate(const Vector<T, 4>&, const ChassisRates<T>& rates) {
        return rates.momentum_rate;
    }
};

template <class T>
struct BryantChart {
    static BryantAngles<T> angles(const Vector<T, 4>& orientation) {
        return BryantAngles<T>(Vec3<T>(orientation.template head<3>()));
    }
    static Mat3<T> rotation(const Vector<T, 4>& orientation) { return bryant_rotation(angles(orientation)); }  // (1)

    static Spatial<T> stored_momentum(const Vector<T, 4>& orientation, const Spatial<T>& momentum) {
        const Mat3<T> D = bryant_rate_matrix(angles(orientation));
        return spatial<T>(linear(momentum), D.transpose() * angular(momentum));  // P_Z = B_1^T (p ; L)  // (54), (57)
    }
    // L = D^-T P, written out: D's determinant is cos q15.
    static Spatial<T> momentum(const Vector<T, 4>& orientation, const Spatial<T>& stored) {
        const auto q = angles(orientation);
        const T b = (stored[5] - q.y.sine * stored[3]) / q.y.cosine;
        return spatial<T>(linear(stored), Vec3<T>(stored[3], q.x.cosine * stored[4] - q.x.sine * b,
                                                  q.x.sine * stored[4] + q.x.cosine * b));
    }
    static Vector<T, 4> orientation_rate(const Vector<T, 4>& orientation, const ChassisRates<T>& rates) {
        const auto q = angles(orientation);
        const Vec3<T>& w = rates.angular_velocity;
        const T third = (q.x.cosine * w[2] - q.x.sine * w[1]) / q.y.cosine;
        return {w[0] - q.y.sine * third, q.x.cosine * w[1] + q.x.sine * w[2], third, T(0)};  // D^-1 omega  // (9)
    }
    // (D^T L)' = D^T L' + D'^T L
    static Spatial<T> stored_momentum_rate(const Vector<T, 4>& orientation, const ChassisRates<T>& rates) {
        const auto q = angles(orientation);
        const Vector<T, 4> rate = orientation_rate(orientation, rates);
        const Vec3<T> L = angular(rates.momentum), L_rate = angular(rates.momentum_rate);
        const auto& [s1, c1] = q.x;
        const auto& [s2, c2] = q.y;
        Mat3<T> D_rate;
        D_rate << T(0), T(0), c2 * rate[1],                              //
            T(0), -s1 * rate[0], s1 * s2 * rate[1] - c1 * c2 * rate[0],  //
            T(0), c1 * rate[0], -s1 * c2 * rate[0] - c1 * s2 * rate[1];
        const Mat3<T> D = bryant_rate_matrix(q);
        return spatial<T>(linear(rates.momentum_rate), D.transpose() * L_rate + D_rate.transpose() * L);
    }
};

// Orientation and momentum as the state stores them, and their rates.
template <class Chart, class T>
concept OrientationChart = requires(const Vector<T, 4>& orientation, const Spatial<T>& momentum,
                                    const ChassisRates<T>& rates) {
    { Chart::rotation(orientation) } -> std::convertible_to<Mat3<T>>;  // R_GC
    { Chart::momentum(orientation, momentum) } -> std::convertible_to<Spatial<T>>;
    { Chart::stored_momentum(orientation, momentum) } -> std::convertible_to<Spatial<T>>;
    { Chart::orientation_rate(orientation, rates) } -> std::convertible_to<Vector<T, 4>>;
    { Chart::stored_momentum_rate(orientation, rates) } -> std::convertible_to<Spatial<T>>;
};
static_assert(OrientationChart<QuaternionChart<double>, double> && OrientationChart<BryantChart<double>, double>);

}  // namespace hamilcar
