// A linkage is a list of tree joints from the chassis to the carrier, a list of cut joints between carrier and chassis,
// and the choice of independent coordinates. B, Phi_q, H, X and all their rates are written here, once, from the parts.
//
// For a column (l ; e) of B and a gradient g at point P, Phi_q = G^T B with the force column G = (g ; P x g). With
// J = B_V + B_W H (the paper's BH) and the drift x = B_W X (BX) the carrier moves, relative to the chassis, by
// J V' + x. Differentiating G^T J = 0 gives the rate of H without ever forming the rate of Phi_q:
//     H' = -Phi_w^-1 (G'^T J + G^T (B_V' + B_W' H))                                        // (47)
// and the rate of X the same way, with the drift as one more column.
#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "hamilcar/linkage/cut_joints.hpp"
#include "hamilcar/linkage/tree_joints.hpp"
#include "hamilcar/math/small_solve.hpp"

namespace hamilcar {

// The rack: the paper's beta(t) = q17 with its rates [m, m/s, m/s^2].
template <class T>
struct RackMotion {
    T displacement{0}, rate{0}, acceleration{0};
};

template <int... I>
struct Coordinates {
    static constexpr int count = sizeof...(I);
    static constexpr std::array<int, sizeof...(I)> index{I...};
};

// Where the carrier is and how it can move; everything the Velocity block needs from the linkage.
template <class T, int nq, int nV, int nW>
struct LinkagePosition {
    Pose<T> pose;
    Matrix<T, 6, nq> B;     // columns of the tree joints  // (14), (17), (18), A.2
    Vector<T, nW> Phi;      // constraint equations  // (25)
    Matrix<T, 6, nW> G;     // (g ; P x g), Phi_q = G^T B  // (26), A.3
    Matrix<T, 3, nW> tips;  // P of each equation
    Matrix<T, nW, nW> Phi_w_inverse;
    T determinant;        // of Phi_w: zero where the linkage locks
    Matrix<T, nW, nV> H;  // (39)
    Vector<T, nW> X;      // (39)
    Matrix<T, 6, nV> J;   // B_V + B_W H  // (43)
    Spatial<T> x;         // B_W X  // (43)
    LinkagePosition() {}  // leaves the numbers unset: every one is written by `position`
};

// Rates of J and x seen from the chassis.
template <class T, int nV>
struct LinkageRates {
    Matrix<T, 6, nV> J;
    Spatial<T> x;
    LinkageRates() {}
};

template <class T, class JointList, class CutList, class IndependentList, class DependentList>
struct Linkage;

template <class T, class... Joints, class... Cuts, class Independent, class Dependent>
struct Linkage<T, std::tuple<Joints...>, std::tuple<Cuts...>, Independent, Dependent> {
    static constexpr int nq = (Joints::coordinates + ... + 0);
    static constexpr int nV = Independent::count;
    static constexpr int nW = Dependent::count;
    static constexpr int equations = (Cuts::equations + ... + 0);
    static_assert(nV + nW == nq && nW == equations);
    using Position = LinkagePosition<T, nq, nV, nW>;
    using Rates = LinkageRates<T, nV>;

    std::tuple<Joints...> joints;
    std::tuple<Cuts...> cuts;

    static constexpr auto independent_indices() { return Independent::index; }
    static constexpr auto dependent_indices() { return Dependent::index; }

    static std::array<T, nq> coordinates(const T* V, const T* W) {
        std::array<T, nq> q;
        for (int i = 0; i < nV; ++i) q[Independent::index[i]] = V[i];
        for (int i = 0; i < nW; ++i) q[Dependent::index[i]] = W[i];
        return q;
    }

    // Everything at given coordinates; X includes the stabilization term alpha Phi.
    Position position(const T* V, const T* W, const RackMotion<T>& rack, const T& alpha) const {
        Position out;
        place_tree(coordinates(V, W), out);
        if constexpr (nW == 0) {
            out.J = out.B;
            out.x.setZero();
            out.determinant = T(1);
        } else {
            close_loops(rack, out);
            eliminate(rack, alpha, out);
        }
        return out;
    }

    // One Newton step W <- W - Phi_w^-1 Phi on the closed loops.
    void newton_step(const T* V, T* W, const RackMotion<T>& rack) const {
        if constexpr (nW > 0) {
            const Vector<T, nW> correction = newton_correction(V, W, rack);
            for (int i = 0; i < nW; ++i) W[i] -= correction[i];
        }
    }

    // Rates of J and x seen from the chassis, once V' is known; W_rate is written too: W' = H V' + X.  // (38), (47)
    Rates rates(const Position& at, const Vector<T, nV>& V_rate, Vector<T, nW>& W_rate, const RackMotion<T>& rack,
                const T& alpha) const {
        Rates out;
        std::array<T, nq> q_rate;
        if constexpr (nW > 0) W_rate = at.H * V_rate + at.X;                     // (38)
        for (int i = 0; i < nV; ++i) q_rate[Independent::index[i]] = V_rate[i];  // (40), (41)
        for (int i = 0; i < nW; ++i) q_rate[Dependent::index[i]] = W_rate[i];
        Matrix<T, 6, nq> B_rate;
        const Spatial<T> v = carry_tree(at.B, q_rate, B_rate);
        if constexpr (nW == 0) {
            out.J = B_rate;
            out.x.setZero();
        } else {
            const Matrix<T, 6, nW> B_W = pick<Dependent>(at.B), B_W_rate = pick<Dependent>(B_rate);
            const Matrix<T, 6, nW> G_rate = gradient_rates(at, v, rack);
            const Matrix<T, 6, nV> Y = pick<Independent>(B_rate) + B_W_rate * at.H;
            const Matrix<T, nW, nV> H_rate =
                -at.Phi_w_inverse * (G_rate.transpose() * at.J + at.G.transpose() * Y);  // (47)
            out.J = Y + B_W * H_rate;
            const Spatial<T> y = B_W_rate * at.X;
            const Vector<T, nW> drive_rate = driven_rate_of_rate(at, G_rate, rack) - alpha * (alpha * at.Phi);
            const Vector<T, nW> X_rate =
                -at.Phi_w_inverse * (G_rate.transpose() * at.x + at.G.transpose() * y + drive_rate);
            out.x = y + B_W * X_rate;
        }
        return out;
    }

    // Visits the cut joints in the order of their equations: visit(cut joint, its first equation).
    template <class Visitor>
    void visit_cuts(Visitor&& visit) const {
        std::apply(
            [&](const auto&... cut) {
                [[maybe_unused]] int row = 0;
                ((visit(cut, row), row += std::decay_t<decltype(cut)>::equations), ...);
            },
            cuts);
    }

private:
    template <class Picked, int Rows>
    static Matrix<T, Rows, Picked::count> pick(const Matrix<T, Rows, nq>& from) {
        Matrix<T, Rows, Picked::count> to;
        for (int i = 0; i < Picked::count; ++i) to.col(i) = from.col(Picked::index[i]);
        return to;
    }

    template <std::size_t I = 0, int first = 0, class Parent>
    Pose<T> place_from(const Parent& parent, const std::array<T, nq>& q, Matrix<T, 6, nq>& B) const {
        using Joint = std::tuple_element_t<I, std::tuple<Joints...>>;
        const Pose<T> child = std::get<I>(joints).place(parent, q.data() + first, B, first);
        if constexpr (I + 1 == sizeof...(Joints)) {
            return child;
        } else {
            return place_from<I + 1, first + Joint::coordinates>(child, q, B);
        }
    }
    void place_tree(const std::array<T, nq>& q, Position& out) const {
        out.pose = place_from(ChassisFrame<T>{}, q, out.B);
    }

    template <std::size_t I = 0, int first = 0, class Motion>
    Spatial<T> carry_from(const Motion& v, const Matrix<T, 6, nq>& B, const std::array<T, nq>& rate,
                          Matrix<T, 6, nq>& B_rate) const {
        using Joint = std::tuple_element_t<I, std::tuple<Joints...>>;
        const Spatial<T> child = std::get<I>(joints).carry(v, B, rate.data() + first, first, B_rate);
        if constexpr (I + 1 == sizeof...(Joints)) {
            return child;
        } else {
            return carry_from<I + 1, first + Joint::coordinates>(child, B, rate, B_rate);
        }
    }
    Spatial<T> carry_tree(const Matrix<T, 6, nq>& B, const std::array<T, nq>& rate, Matrix<T, 6, nq>& B_rate) const {
        return carry_from(AtRest<T>{}, B, rate, B_rate);
    }

    void close_loops(const RackMotion<T>& rack, Position& out) const {
        visit_cuts([&](const auto& cut, int row) {
            constexpr int n = std::decay_t<decltype(cut)>::equations;
            const Vec3<T> P = out.pose.point(cut.tip);
            Matrix<T, 3, n> g;
            cut.evaluate(P, rack.displacement, out.Phi.data() + row, Eigen::Ref<Matrix<T, 3, n>>(g));  // (25)
            for (int i = 0; i < n; ++i) {
                out.tips.col(row + i) = P;
                out.G.col(row + i) = force_at<T>(P, g.col(i));  // (26), A.3
            }
        });
    }

    void eliminate(const RackMotion<T>& rack, const T& alpha, Position& out) const {
        const Matrix<T, 6, nW> B_W = pick<Dependent>(out.B);
        const Matrix<T, 6, nV> B_V = pick<Independent>(out.B);
        const auto inverted = inverse<T>(Matrix<T, nW, nW>(out.G.transpose() * B_W));
        out.Phi_w_inverse = inverted.matrix;
        out.determinant = inverted.determinant;
        out.H = -(out.Phi_w_inverse * (out.G.transpose() * B_V));                   // (39)
        out.X = -(out.Phi_w_inverse * (driven_rate(out, rack) + alpha * out.Phi));  // (27), (39)
        out.J = B_V + B_W * out.H;                                                  // (43)
        out.x = B_W * out.X;                                                        // (43)
    }

    Vector<T, nW> newton_correction(const T* V, const T* W, const RackMotion<T>& rack) const {
        Position at;
        place_tree(coordinates(V, W), at);
        close_loops(rack, at);
        return inverse<T>(Matrix<T, nW, nW>(at.G.transpose() * pick<Dependent>(at.B))).matrix * at.Phi;
    }

    // Phi_t = -g.u rack'; the paper prints the opposite sign.
    Vector<T, nW> driven_rate(const Position& at, const RackMotion<T>& rack) const {
        Vector<T, nW> Phi_t = Vector<T, nW>::Zero();
        visit_cuts([&](const auto& cut, int row) {
            if constexpr (std::decay_t<decltype(cut)>::driven)
                Phi_t[row] = -linear(at.G.col(row)).dot(cut.drive_axis) * rack.rate;  // (28)
        });
        return Phi_t;
    }

    Vector<T, nW> driven_rate_of_rate(const Position& at, const Matrix<T, 6, nW>& G_rate,
                                      const RackMotion<T>& rack) const {
        Vector<T, nW> rate = Vector<T, nW>::Zero();
        visit_cuts([&](const auto& cut, int row) {
            if constexpr (std::decay_t<decltype(cut)>::driven)
                rate[row] = -linear(G_rate.col(row)).dot(cut.drive_axis) * rack.rate -
                            linear(at.G.col(row)).dot(cut.drive_axis) * rack.acceleration;
        });
        return rate;
    }

    // (g' ; P' x g + P x g')
    Matrix<T, 6, nW> gradient_rates(const Position& at, const Spatial<T>& v, const RackMotion<T>& rack) const {
        Matrix<T, 6, nW> G_rate;
        visit_cuts([&](const auto& cut, int row) {
            constexpr int n = std::decay_t<decltype(cut)>::equations;
            const Vec3<T> P = at.tips.col(row);
            const Vec3<T> P_rate = velocity_at<T>(v, P);
            Matrix<T, 3, n> g_rate;
            cut.gradient_rate(P_rate, rack.rate, Eigen::Ref<Matrix<T, 3, n>>(g_rate));
            for (int i = 0; i < n; ++i) {
                const Vec3<T> g = linear(at.G.col(row + i)), dg = g_rate.col(i);
                G_rate.col(row + i) = spatial<T>(dg, P_rate.cross(g) + P.cross(dg));
            }
        });
        return G_rate;
    }
};

}  // namespace hamilcar
