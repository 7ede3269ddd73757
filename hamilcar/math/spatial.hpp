// Spatial vectors about one reference point O: the paper's "state" (hatted) vectors, linear part first (10).
//
// A motion is (velocity of the body-fixed point at O ; angular velocity), a force is (force ; moment about O).
// A body's spatial inertia needs ten numbers; applying it to a motion gives its momentum (linear ; angular about O).
#pragma once

#include <tuple>

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
using Spatial = Vector<T, 6>;

template <class T>
Spatial<T> spatial(const Vec3<T>& linear, const Vec3<T>& angular) {
    Spatial<T> s;
    for (int i = 0; i < 3; ++i) s[i] = linear[i], s[i + 3] = angular[i];
    return s;
}

template <class Derived>
auto linear(const Eigen::MatrixBase<Derived>& s) {
    return s.template head<3>();
}
template <class Derived>
auto angular(const Eigen::MatrixBase<Derived>& s) {
    return s.template tail<3>();
}

template <class Derived>
auto angular(Eigen::MatrixBase<Derived>& s) {
    return s.template tail<3>();
}

// Force f at point p: (f ; p x f).  // (55)
template <class T>
Spatial<T> force_at(const Vec3<T>& p, const Vec3<T>& f) {
    return spatial<T>(f, p.cross(f));
}

// Velocity that motion v gives to the point p.  // (10)
template <class T>
Vec3<T> velocity_at(const Spatial<T>& v, const Vec3<T>& p) {
    return linear(v) + angular(v).cross(p);
}

// v x m: rate of change of a motion m fixed in a body that moves with v.
template <class T>
Spatial<T> cross_motion(const Spatial<T>& v, const Spatial<T>& m) {
    return spatial<T>(angular(v).cross(linear(m)) + linear(v).cross(angular(m)), angular(v).cross(angular(m)));
}

// v x* f: rate of change of a force f fixed in a body that moves with v; the transpose relation is f.(v x m) = -(v x* f).m.
template <class T>
Spatial<T> cross_force(const Spatial<T>& v, const Spatial<T>& f) {
    return spatial<T>(angular(v).cross(linear(f)), linear(v).cross(linear(f)) + angular(v).cross(angular(f)));
}

// Symmetric 3x3: six numbers, products as matrix entries.
template <class T>
struct Symmetric3 {
    T xx, yy, zz, xy, yz, xz;
    static constexpr auto members() {
        using S = Symmetric3;
        return std::tuple(&S::xx, &S::yy, &S::zz, &S::xy, &S::yz, &S::xz);
    }

    Vec3<T> operator*(const Vec3<T>& v) const {
        return {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2],
                xz * v[0] + yz * v[1] + zz * v[2]};
    }
    // R S R^T
    Symmetric3 rotated(const Mat3<T>& R) const {
        Mat3<T> RS;
        for (int i = 0; i < 3; ++i) {
            RS(i, 0) = R(i, 0) * xx + R(i, 1) * xy + R(i, 2) * xz;
            RS(i, 1) = R(i, 0) * xy + R(i, 1) * yy + R(i, 2) * yz;
            RS(i, 2) = R(i, 0) * xz + R(i, 1) * yz + R(i, 2) * zz;
        }
        const auto entry = [&](int i, int j) { return RS(i, 0) * R(j, 0) + RS(i, 1) * R(j, 1) + RS(i, 2) * R(j, 2); };
        return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
    }
};

// A rigid body as given: mass [kg], center of mass [m], inertia about it [kg m^2], in its own axes.
template <class T>
struct RigidBody {
    T mass;
    Vec3<T> center;
    Symmetric3<T> inertia;
    static constexpr auto members() { return std::tuple(&RigidBody::mass, &RigidBody::center, &RigidBody::inertia); }
};

// Spatial inertia about O: Mhat of (56), (57).
template <class T>
struct SpatialInertia {
    T mass;
    Vec3<T> first_moment;   // mass x center [kg m]
    Symmetric3<T> inertia;  // about O [kg m^2]
    static constexpr auto members() {
        return std::tuple(&SpatialInertia::mass, &SpatialInertia::first_moment, &SpatialInertia::inertia);
    }

    // Body with center of mass c and inertia J about it, both already in the axes of O.
    static SpatialInertia about_origin(const T& mass, const Vec3<T>& c, const Symmetric3<T>& J) {
        const Vec3<T> mc = mass * c;
        const T mxx = mc[0] * c[0], myy = mc[1] * c[1], mzz = mc[2] * c[2];
        return {mass,
                mc,
                {J.xx + myy + mzz, J.yy + mxx + mzz, J.zz + mxx + myy,  //
                 J.xy - mc[0] * c[1], J.yz - mc[1] * c[2], J.xz - mc[0] * c[2]}};
    }

    Spatial<T> operator*(const Spatial<T>& v) const {
        const Vec3<T> w = angular(v), l = linear(v);
        return spatial<T>(mass * l + w.cross(first_moment), inertia * w + first_moment.cross(l));
    }

    // Adds the lower triangle of the 6x6 matrix form to K.
    void add_to_lower(Matrix<T, 6, 6>& K) const {
        for (int i = 0; i < 3; ++i) K(i, i) += mass;
        K(3, 1) -= first_moment[2], K(3, 2) += first_moment[1];
        K(4, 0) += first_moment[2], K(4, 2) -= first_moment[0];
        K(5, 0) -= first_moment[1], K(5, 1) += first_moment[0];
        K(3, 3) += inertia.xx, K(4, 4) += inertia.yy, K(5, 5) += inertia.zz;
        K(4, 3) += inertia.xy, K(5, 4) += inertia.yz, K(5, 3) += inertia.xz;
    }
};

}  // namespace hamilcar
