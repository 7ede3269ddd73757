// A linkage is a list of tree joints from the chassis to the carrier, a list of cut joints between carrier and chassis,
// and the choice of independent coordinates. B, Phi_q, H, X and all their rates are written here, once, from the parts.
//
// For a column (l ; e) of B and a gradient g at point P, Phi_q = g.(l + e x r), r = P seen from the anchor. With
// J = B_V + B_W H (the paper's BH) and the drift x = B_W X (BX) the carrier moves, relative to the chassis, by
// J V' + x, and P by P_J V' + P_x. Differentiating g.P_J = 0 gives the rate of H without ever forming the rate of Phi_q:
//     H' = -Phi_w^-1 (g'.P_J + g.(omega_J x P' + P_Y)),   Y = B_V' + B_W' H                // (47)
// and the rate of X the same way, with the drift as one more column.
#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "hamilcar/linkage/cut_joints.hpp"
#include "hamilcar/linkage/rack_motion.hpp"
#include "hamilcar/linkage/tree.hpp"
#include "hamilcar/math/small_solve.hpp"

namespace hamilcar {

template <int... I>
struct Coordinates {
    static constexpr int count = sizeof...(I);
    static constexpr std::array<int, sizeof...(I)> index{I...};
};

// Where the carrier is and how it can move; everything the Velocity block needs from the linkage. Columns and arms are
// about the anchor, J and x about the chassis origin.
template <class T, class Columns, int nV, int nW, int cuts>
struct LinkagePosition {
    static constexpr bool drifts = nW > 0;  // whether x can be other than zero
    Pose<T> pose;
    Columns B;                       // of the tree joints  // (14), (17), (18), A.2
    Vector<T, nW> Phi;               // constraint equations  // (25)
    Matrix<T, 3, nW> gradients;      // of Phi with respect to P  // (26), A.3
    std::array<Vec3<T>, cuts> arms;  // r of each cut joint
    Matrix<T, nW, nW> Phi_w_inverse;
    T determinant;          // of Phi_w: zero where the linkage locks
    Matrix<T, nW, nV> H;    // (39)
    Vector<T, nW> X;        // (39)
    Vector<T, nW> closing;  // of W: -Phi_w^-1 Phi
    Matrix<T, 6, nV> J;     // B_V + B_W H  // (43)
    Spatial<T> x;           // B_W X  // (43)
    LinkagePosition() {}    // leaves the numbers unset: every one is written by `position`
};

template <class T, class JointList, class CutList, class IndependentList, class DependentList>
struct Linkage;

template <class T, class... Joints, class... Cuts, class Independent, class Dependent>
struct Linkage<T, std::tuple<Joints...>, std::tuple<Cuts...>, Independent, Dependent> {
    static constexpr int nq = (Joints::coordinates + ... + 0);
    static constexpr int nV = Independent::count;
    static constexpr int nW = Dependent::count;
    static constexpr int equations = (Cuts::equations + ... + 0);
    static constexpr int cut_count = sizeof...(Cuts);
    static_assert(nV + nW == nq && nW == equations);

    std::tuple<Joints...> joints;
    std::tuple<Cuts...> cuts;
    static constexpr auto members() { return std::tuple(&Linkage::joints, &Linkage::cuts); }

    static constexpr auto independent_indices() { return Independent::index; }
    static constexpr auto dependent_indices() { return Dependent::index; }

    // The point of the first joint: its columns turn about it. A linkage that starts with a translation has no such point.
    Vec3<T> anchor() const {
        if constexpr (requires { std::get<0>(joints).point; }) {
            return std::get<0>(joints).point;
        } else {
            return Vec3<T>::Zero();
        }
    }

    using Outward = OutwardOrder<Joints...>;
    using Columns = typename TreeColumns<T, Joints...>::type;
    using Position = LinkagePosition<T, Columns, nV, nW, cut_count>;
    using ColumnRates = typename decltype(carry_tree<Outward>(Rest(), Columns(), (const T*)nullptr))::second_type;

    // Rates seen from the chassis, once V' is known.
    struct Rates {
        Vector<T, nW> W;                      // W' = H V' + X  // (38)
        Matrix<T, 6, nV> J;                   // about the chassis origin
        ColumnRates B;                        // in the order outward
        std::array<Vec3<T>, cut_count> tips;  // P'
        Rates() {}
    };

    // Everything at given coordinates; X includes the stabilization term alpha Phi.
    Position position(const T* V, const T* W, const RackMotion<T>& rack, const T& alpha) const {
        Position out;
        find_position(V, W, rack, alpha, out);
        return out;
    }
    // The same, written where it is kept.
    void find_position(const T* V, const T* W, const RackMotion<T>& rack, const T& alpha, Position& out) const {
        out.pose = place_tree(joints, ChassisFrame<T>{}, coordinates(V, W).data(), anchor(), out.B);
        if constexpr (nW == 0) {
            out.determinant = T(1);
            out.x.setZero();
        } else {
            evaluate_cuts(rack, out);
            eliminate(rack, alpha, out);
            out.x = referred<T>(drift(out), anchor());
        }
        for_each_independent([&](auto index) {
            constexpr int j = index;
            out.J.col(j) = referred<T>(column_of_J<j>(out), anchor());
        });
    }

    // One Newton step W <- W - Phi_w^-1 Phi on the closed loops.
    void newton_step(const T* V, T* W, const RackMotion<T>& rack) const {
        if constexpr (nW > 0) {
            Position at;
            at.pose = place_tree(joints, ChassisFrame<T>{}, coordinates(V, W).data(), anchor(), at.B);
            evaluate_cuts(rack, at);
            const Vector<T, nW> correction = inverse<T>(Phi_columns<Dependent>(at)).matrix * at.Phi;
            for (int i = 0; i < nW; ++i) W[i] -= correction[i];
        }
    }

    Rates rates(const Position& at, const Vector<T, nV>& V_rate, const RackMotion<T>& rack) const {
        Rates out;
        if constexpr (nW > 0) out.W = at.H * V_rate + at.X;  // (38)
        std::array<T, nq> q_rate;
        for (int i = 0; i < nV; ++i) q_rate[Independent::index[i]] = V_rate[i];  // (40), (41)
        for (int i = 0; i < nW; ++i) q_rate[Dependent::index[i]] = out.W[i];
        const auto [v, B_rate] = carry_tree<Outward>(Rest{}, at.B, q_rate.data());
        out.B = B_rate;
        for (std::size_t i = 0; i < out.tips.size(); ++i) out.tips[i] = as_vector<T>(velocity_of(v, at.arms[i]));
        for_each_independent([&](auto index) {
            constexpr int j = index;
            const auto H = [&](int i) { return at.H(i, j); };
            const auto Y =
                sum(std::get<Outward::place[Independent::index[j]]>(out.B), combined<OutwardDependent>(out.B, H));
            if constexpr (nW == 0) {
                out.J.col(j) = referred<T>(Y, anchor());
            } else {
                const Vector<T, nW> H_rate = -(at.Phi_w_inverse * bend(at, out, column_of_J<j>(at), Y, rack));  // (47)
                const auto J_rate = sum(Y, combined<Dependent>(at.B, [&](int i) { return H_rate[i]; }));
                out.J.col(j) = referred<T>(J_rate, anchor());
            }
        });
        return out;
    }

    // Rate of the drift x about the chassis origin, seen from the chassis; only the energy balance asks for it.
    Spatial<T> drift_rate(const Position& at, const Rates& rates, const RackMotion<T>& rack, const T& alpha) const {
        if constexpr (nW == 0) {
            return Spatial<T>::Zero();
        } else {
            const auto y = combined<OutwardDependent>(rates.B, [&](int i) { return at.X[i]; });
            Vector<T, nW> drive_rate = bend(at, rates, drift(at), y, rack) - alpha * (alpha * at.Phi);
            visit_cuts([&](const auto& cut, int row, std::size_t i) {
                if constexpr (std::decay_t<decltype(cut)>::driven) {
                    const auto [g_rate] = cut.gradient_rates(rates.tips[i], rack.rate);
                    const Vec3<T> g = at.gradients.col(row);
                    drive_rate[row] -= cut.drive_axis.dot(g_rate * rack.rate + g * rack.acceleration);
                }
            });
            const Vector<T, nW> X_rate = -(at.Phi_w_inverse * drive_rate);
            return referred<T>(sum(y, combined<Dependent>(at.B, [&](int i) { return X_rate[i]; })), anchor());
        }
    }

    // Visits the cut joints in order: visit(cut joint, its first equation, its number).
    template <class Visitor>
    void visit_cuts(Visitor&& visit) const {
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            [[maybe_unused]] int row = 0;
            ((visit(std::get<i>(cuts), row, i), row += std::tuple_element_t<i, decltype(cuts)>::equations), ...);
        }
        (std::make_index_sequence<std::tuple_size_v<decltype(cuts)>>());
    }

private:
    // Where the rates of the dependent columns stand.
    struct OutwardDependent {
        static constexpr int count = nW;
        static constexpr std::array<int, nW> index = [] {
            std::array<int, nW> at{};
            for (std::size_t i = 0; i < at.size(); ++i) {
                at[i] = Outward::place[static_cast<std::size_t>(Dependent::index[i])];
            }
            return at;
        }();
    };

    template <class F>
    static void for_each_independent(F&& f) {
        [&]<int... j>(std::integer_sequence<int, j...>) {
            (f(std::integral_constant<int, j>{}), ...);
        }
        (std::make_integer_sequence<int, nV>());
    }

    static std::array<T, nq> coordinates(const T* V, const T* W) {
        std::array<T, nq> q;
        for (int i = 0; i < nV; ++i) q[Independent::index[i]] = V[i];
        for (int i = 0; i < nW; ++i) q[Dependent::index[i]] = W[i];
        return q;
    }

    // Columns of J and x about the anchor.  // (43)
    template <int j>
    static auto column_of_J(const Position& at) {
        return sum(std::get<Independent::index[j]>(at.B), combined<Dependent>(at.B, [&](int i) { return at.H(i, j); }));
    }
    static auto drift(const Position& at) {
        return combined<Dependent>(at.B, [&](int i) { return at.X[i]; });
    }

    // Phi, its gradients and the arms they act on.
    void evaluate_cuts(const RackMotion<T>& rack, Position& out) const {
        visit_cuts([&](const auto& cut, int row, std::size_t i) {
            constexpr int n = std::decay_t<decltype(cut)>::equations;
            const Vec3<T> P = out.pose.point(cut.tip);
            out.arms[i] = P - anchor();
            Matrix<T, 3, n> g;
            cut.evaluate(P, rack.displacement, out.Phi.data() + row, Eigen::Ref<Matrix<T, 3, n>>(g));  // (25)
            for (int k = 0; k < n; ++k) out.gradients.col(row + k) = g.col(k);
        });
    }

    // The picked columns of Phi_q: g.l + (r x g).e  // (26), A.3
    template <class Picked>
    Matrix<T, nW, Picked::count> Phi_columns(const Position& at) const {
        Matrix<T, nW, Picked::count> out;
        visit_cuts([&](const auto& cut, int row, std::size_t i) {
            for (int k = row; k < row + std::decay_t<decltype(cut)>::equations; ++k) {
                const Vec3<T> g = at.gradients.col(k), moment = at.arms[i].cross(g);
                [&]<std::size_t... j>(std::index_sequence<j...>) {
                    ((out(k, j) = add(dot(g, std::get<Picked::index[j]>(at.B).linear),
                                      dot(moment, std::get<Picked::index[j]>(at.B).angular))),
                     ...);
                }
                (std::make_index_sequence<Picked::count>());
            }
        });
        return out;
    }

    void eliminate(const RackMotion<T>& rack, const T& alpha, Position& out) const {
        const auto inverted = inverse<T>(Phi_columns<Dependent>(out));
        out.Phi_w_inverse = inverted.matrix;
        out.determinant = inverted.determinant;
        out.H = -(out.Phi_w_inverse * Phi_columns<Independent>(out));               // (39)
        out.X = -(out.Phi_w_inverse * (driven_rate(out, rack) + alpha * out.Phi));  // (27), (39)
        out.closing = -(out.Phi_w_inverse * out.Phi);
    }

    // Phi_t = -g.u rack'; the paper prints the opposite sign.
    Vector<T, nW> driven_rate(const Position& at, const RackMotion<T>& rack) const {
        Vector<T, nW> Phi_t = Vector<T, nW>::Zero();
        visit_cuts([&](const auto& cut, int row, int) {
            if constexpr (std::decay_t<decltype(cut)>::driven)
                Phi_t[row] = -Vec3<T>(at.gradients.col(row)).dot(cut.drive_axis) * rack.rate;  // (28)
        });
        return Phi_t;
    }

    // g'.P_J + g.(omega_J x P' + P_Y) of all equations, for a motion J whose columns alone change at the rate Y.
    template <class J, class Y>
    Vector<T, nW> bend(const Position& at, const Rates& rates, const J& motion, const Y& rate,
                       const RackMotion<T>& rack) const {
        Vector<T, nW> out;
        visit_cuts([&](const auto& cut, int row, std::size_t i) {
            const Vec3<T>&r = at.arms[i], &P_rate = rates.tips[i];
            const auto P_J = velocity_of(motion, r);
            const auto bent = add(cross(motion.angular, P_rate), velocity_of(rate, r));
            const auto g_rates = cut.gradient_rates(P_rate, rack.rate);
            [&]<std::size_t... k>(std::index_sequence<k...>) {
                ((out[row + static_cast<int>(k)] = add(dot(Vec3<T>(at.gradients.col(row + static_cast<int>(k))), bent),
                                                       dot(std::get<k>(g_rates), P_J))),
                 ...);
            }
            (std::make_index_sequence<std::decay_t<decltype(cut)>::equations>());
        });
        return out;
    }
};

}  // namespace hamilcar
