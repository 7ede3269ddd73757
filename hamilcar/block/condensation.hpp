// How a suspension's own rates are eliminated: what it adds to its unit's equation, and to that of a rack that moves on its own
// (suspension_velocity.hpp has the sums, docs/theory/steering.md the rack's).
#pragma once

#include "hamilcar/linkage/linkage.hpp"

namespace hamilcar {

// A suspension's own equation m V' + C^T v_u = k.
template <class T>
struct OwnEquation {
    Matrix<T, 6, max_freedoms> C;
    Matrix<T, max_freedoms, max_freedoms> m_inverse;
    std::array<T, max_freedoms> k, V_rate;
    std::array<T, max_freedoms> d;  // of a rack that moves on its own: m V' + C^T v_u + d rack' = k
    OwnEquation() {}

    void solve(int n, const Spatial<T>& v_u) {
        for (int i = 0; i < n; ++i) {
            V_rate[i] = T(0);
            for (int j = 0; j < n; ++j) V_rate[i] += m_inverse(i, j) * (k[j] - C.col(j).dot(v_u));
        }
    }
    void subtract_rack(int n, const T& rate) {
        for (int j = 0; j < n; ++j) k[j] -= d[j] * rate;
    }
};

// The inertia and momentum of a unit with everything condensed onto it, in its axes about its origin.
template <class T>
struct CondensedUnit {
    Matrix<T, 6, 6> K;
    Spatial<T> b;
    CondensedUnit() {}
};

// What suspensions add to the equation of a rack that moves on its own, c^T v_1 + inertia rack' = P_rack - momentum, and by c to that of
// the chassis (velocity.hpp).
template <class T>
struct RackCoupling {
    Spatial<T> c = Spatial<T>::Zero();
    T inertia{0}, momentum{0};
    void add(const RackCoupling& other) {
        c += other.c;
        inertia += other.inertia, momentum += other.momentum;
    }
};

// Eliminates a suspension's own rates: K and b of its bodies become what it adds to the unit's.
template <class T>
void condense(int n, const Matrix<T, max_freedoms, max_freedoms>& m, OwnEquation<T>& own, CondensedUnit<T>& out) {
    own.m_inverse = m;
    invert_positive_definite<T, max_freedoms>(own.m_inverse, n);
    for (int i = 0; i < n; ++i) {
        Spatial<T> Cm = own.C.col(0) * own.m_inverse(0, i);
        for (int j = 1; j < n; ++j) Cm += own.C.col(j) * own.m_inverse(j, i);
        out.K -= Cm * own.C.col(i).transpose();
        out.b += Cm * own.k[i];
    }
}

// The same for the rack, before that: C and d become c, d and k its inertia and momentum.
template <class T>
void condense_rack(int n, const Matrix<T, max_freedoms, max_freedoms>& m_inverse, const OwnEquation<T>& own,
                   RackCoupling<T>& out) {
    for (int i = 0; i < n; ++i) {
        T along(0);
        for (int j = 0; j < n; ++j) along += m_inverse(j, i) * own.d[j];
        out.c -= own.C.col(i) * along;
        out.inertia -= along * own.d[i];
        out.momentum += along * own.k[i];
    }
}

}  // namespace hamilcar
