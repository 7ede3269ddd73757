// A linkage of any shape, as tables: a tree of parts from the chassis outward, loops closed by cut joints between any two of
// them, and the choice of independent coordinates. B, Phi_q, H, X and all their rates are computed here.
//
// Every tree joint is a chain of coordinates that turn about or slide along one axis, and coordinate k carries frame k + 1.
// Every cut joint is a list of equations, distances and planes, and for both the row of Phi_q is one wrench (g ; P x g) on
// `part` and its reaction on `base`: the entry of coordinate k is the wrench's power on the column of B, counted where the
// coordinate moves one of the two and not the other. The motions of all frames per independent coordinate are accumulated
// outward, frame by frame: J (the paper's BH), the prescribed motion x (BX), and with the rates of the columns
//     Z = sum B' Y,   J' = Z + sum B Y',   Y = (1 ; H)
// so that (47) is  H' = -Phi_w^-1 (w'.(J_part - J_base) + w.(Z_part - Z_base))  and a spring's lever arm is w.(J_part - J_base).
#pragma once

#include "hamilcar/linkage/linkage_parts.hpp"
#include "hamilcar/linkage/rack_motion.hpp"
#include "hamilcar/math/rotation.hpp"
#include "hamilcar/math/small_solve.hpp"

namespace hamilcar {

template <class T>
struct Linkage {
    std::vector<LinkageCoordinate<T>> coordinates;
    std::vector<LoopEquation<T>> equations;
    std::vector<int> independent, dependent;  // coordinates
    std::vector<int> path;                    // for every frame: bit k is set if coordinate k moves it
    // The order in which Phi_w is eliminated: an equation and, as its pivot's column, an index into `dependent`.
    std::vector<int> pivot_equation, pivot_dependent;
    static constexpr auto members() {
        using L = Linkage;
        return std::tuple(&L::coordinates, &L::equations, &L::independent, &L::dependent, &L::path, &L::pivot_equation,
                          &L::pivot_dependent);
    }
    int nq() const { return static_cast<int>(coordinates.size()); }
    int nV() const { return static_cast<int>(independent.size()); }
    int nW() const { return static_cast<int>(dependent.size()); }

    // A point of the chassis on the first joint: about it the columns of that joint have no linear part.
    Vec3<T> anchor() const { return coordinates[0].slides ? Vec3<T>(Vec3<T>::Zero()) : coordinates[0].point; }

    // Frames, columns of B and equations at given coordinates.
    void find_loops(const T* V, const T* W, const RackMotion<T>& rack, LinkagePosition<T>& out) const {
        place(V, W, out);
        evaluate_loops(rack, out);
    }
    // 1 where the coordinate moves the equation's part alone, -1 where its base alone.
    int sign(int e, int k) const { return ((path[equations[e].part] >> k) & 1) - ((path[equations[e].base] >> k) & 1); }
    // Entry of Phi_q.  // (26), A.3
    T entry(const LinkagePosition<T>& at, int e, int k) const {
        const int s = sign(e, k);
        if (s == 0) return T(0);
        const T power = at.wrench[e].dot(at.B[k]);
        return s > 0 ? power : T(-power);
    }

    // Everything at given coordinates; X includes the stabilization term alpha Phi.
    void find_position(const T* V, const T* W, const RackMotion<T>& rack, const T& alpha,
                       LinkagePosition<T>& out) const {
        find_loops(V, W, rack, out);
        eliminate(rack, alpha, out);
        accumulate(out.B, out.Y, out.X, out.own);
        refer(out.own, out.motion);
        out.pace = T(1);
    }

    // One Newton step W <- W - Phi_w^-1 Phi on the closed loops.
    void newton_step(const T* V, T* W, const RackMotion<T>& rack) const {
        if (nW() == 0) return;
        LinkagePosition<T> at;
        find_loops(V, W, rack, at);
        eliminate(rack, T(0), at);
        for (int i = 0; i < nW(); ++i) W[i] += at.correction[i];
    }

    void find_rates(const LinkagePosition<T>& at, const std::array<T, max_freedoms>& V_rate, const RackMotion<T>& rack,
                    LinkageRates<T>& out) const {
        out.v[0].setZero();
        for (int k = 0; k < nq(); ++k) {
            T rate = at.X[k] * at.pace;
            for (int j = 0; j < nV(); ++j) rate += at.Y[k][j] * V_rate[j];  // (38), (40), (41)
            out.q[k] = rate;
            const Spatial<T>& v = out.v[coordinates[k].parent];
            out.v[k + 1] = v + at.B[k] * rate;  // (18)
            out.B[k] = cross_motion<T>(v, at.B[k]);
        }
        for (int e = 0; e < nW(); ++e) out.wrench[e] = wrench_rate(at, out, e, rack);
        accumulate(out.B, at.Y, at.X, out.own);
        std::array<std::array<T, max_freedoms>, max_coordinates> Y_rate;
        for (int j = 0; j < nV(); ++j) {
            std::array<T, max_equations> rhs;
            for (int e = 0; e < nW(); ++e) {
                const int part = equations[e].part, base = equations[e].base;
                rhs[e] = out.wrench[e].dot(at.own.J[part].col(j) - at.own.J[base].col(j)) +
                         at.wrench[e].dot(out.own.J[part].col(j) - out.own.J[base].col(j));
            }
            for (int k = 0; k < nV(); ++k) Y_rate[independent[k]][j] = T(0);
            for (int i = 0; i < nW(); ++i) Y_rate[dependent[i]][j] = -solved(at, i, rhs);  // (47)
        }
        std::array<Matrix<T, 6, max_freedoms>, max_frames> B_Y_rate;  // sum B Y'
        B_Y_rate[0].setZero(), out.motion.J[0].setZero();
        for (int k = 0; k < nq(); ++k) {
            for (int j = 0; j < nV(); ++j) {
                B_Y_rate[k + 1].col(j) = B_Y_rate[coordinates[k].parent].col(j) + at.B[k] * Y_rate[k][j];
                out.motion.J[k + 1].col(j) = referred(out.own.J[k + 1].col(j) + B_Y_rate[k + 1].col(j));
            }
        }
    }

    // Rate of the prescribed motion x of every frame relative to the chassis; only the energy balance needs it.
    void find_prescribed_rates(const LinkagePosition<T>& at, const LinkageRates<T>& rates, const RackMotion<T>& rack,
                               const T& alpha, std::array<Spatial<T>, max_frames>& out) const {
        std::array<T, max_equations> rhs;
        for (int e = 0; e < nW(); ++e) {
            const LoopEquation<T>& eq = equations[e];
            const Vec3<T> u = at.pose[eq.base].direction(eq.drive), u_rate = angular(rates.v[eq.base]).cross(u);
            const Vec3<T> g = at.gradient[e], g_rate = linear(rates.wrench[e]);
            rhs[e] = rates.wrench[e].dot(at.own.x[eq.part] - at.own.x[eq.base]) +
                     at.wrench[e].dot(rates.own.x[eq.part] - rates.own.x[eq.base]) - alpha * (alpha * at.Phi[e]) -
                     ((g_rate.dot(u) + g.dot(u_rate)) * rack.rate + g.dot(u) * rack.acceleration);
        }
        out[0].setZero();
        std::array<T, max_coordinates> X_rate;
        for (int k = 0; k < nV(); ++k) X_rate[independent[k]] = T(0);
        for (int i = 0; i < nW(); ++i) X_rate[dependent[i]] = -solved(at, i, rhs);
        for (int k = 0; k < nq(); ++k) {
            out[k + 1] = out[coordinates[k].parent] + rates.B[k] * at.X[k] + at.B[k] * X_rate[k];
        }
        for (int k = 0; k < nq(); ++k) out[k + 1] = referred(out[k + 1]);
    }

    // The line of force of a spring or a damper.  // (44)
    LineOfAction<T> line(const ForceLine<T>& where, const LinkagePosition<T>& at, const T* V, const T* W) const {
        LineOfAction<T> out;
        if (where.coordinate >= 0) {
            out = along(where.coordinate, at, V, W);
            out.length += where.at_design;
            return out;
        }
        const Vec3<T> p = at.pose[where.part].point(where.on_part);
        const Vec3<T> d = p - at.pose[where.base].point(where.on_base);
        const T square = d.squaredNorm();
        out.length = sqrt(square);
        along(Vec3<T>(d * over_root(T(1), square)), p, where.part, where.base, at.own, out);
        return out;
    }

    // Of a coordinate: zero at design.
    T value(int coordinate, const T* V, const T* W) const {
        T out(0);
        for (int i = 0; i < nV(); ++i) out = independent[i] == coordinate ? V[i] : out;
        for (int i = 0; i < nW(); ++i) out = dependent[i] == coordinate ? W[i] : out;
        return out;
    }

    // Along, or about, a coordinate.
    LineOfAction<T> along(int coordinate, const LinkagePosition<T>& at, const T* V, const T* W) const {
        LineOfAction<T> out;
        out.length = value(coordinate, V, W);
        out.gradient = at.Y[coordinate];
        out.prescribed_rate = at.X[coordinate];
        return out;
    }

    // How the motions about the anchor change the distance between part and base along n through p.
    void along(const Vec3<T>& n, const Vec3<T>& p, int part, int base, const FrameMotions<T>& motion,
               LineOfAction<T>& out) const {
        const Spatial<T> wrench = force_at<T>(Vec3<T>(p - anchor()), n);
        for (int j = 0; j < nV(); ++j) out.gradient[j] = wrench.dot(motion.J[part].col(j) - motion.J[base].col(j));
        out.prescribed_rate = wrench.dot(motion.x[part] - motion.x[base]);
    }

    T violation(int e, const LinkagePosition<T>& at) const {
        return equations[e].plane ? abs(at.Phi[e]) : abs(sqrt(at.span[e].squaredNorm()) - equations[e].length);
    }

private:
    void place(const T* V, const T* W, LinkagePosition<T>& out) const {
        std::array<T, max_coordinates> q;
        for (int i = 0; i < nV(); ++i) q[independent[i]] = V[i];
        for (int i = 0; i < nW(); ++i) q[dependent[i]] = W[i];
        out.pose[0] = {Mat3<T>::Identity(), Vec3<T>::Zero(), Vec3<T>::Zero()};
        std::array<Vec3<T>, max_coordinates> arm;  // of each joint's point, from the anchor
        for (int k = 0; k < nq(); ++k) {
            const LinkageCoordinate<T>& f = coordinates[k];
            const Placement<T>& parent = out.pose[f.parent];
            const Vec3<T> e = parent.direction(f.axis);
            if (f.slides) {
                out.pose[k + 1] = {parent.R, parent.at + e * q[k], parent.mark};
                out.B[k] = spatial<T>(e, Vec3<T>::Zero());  // (17), A.2
                continue;
            }
            const Vec3<T> at = f.same_point ? parent.at : parent.point(f.point);
            out.pose[k + 1] = {parent.R * axis_rotation(f.axis, q[k]), at, f.point};
            arm[k] = k == 0 ? Vec3<T>(Vec3<T>::Zero()) : f.same_point ? arm[f.parent - 1] : Vec3<T>(at - anchor());
            out.B[k] = spatial<T>(arm[k].cross(e), e);  // (14), A.2
        }
    }

    void evaluate_loops(const RackMotion<T>& rack, LinkagePosition<T>& out) const {
        for (int e = 0; e < static_cast<int>(equations.size()); ++e) {
            const LoopEquation<T>& eq = equations[e];
            const Placement<T>& base = out.pose[eq.base];
            const Vec3<T> P = out.pose[eq.part].point(eq.tip);
            const Vec3<T> d = P - base.point(Vec3<T>(eq.foot + eq.drive * rack.displacement));
            const Vec3<T> g = eq.plane ? base.direction(eq.axis) : Vec3<T>(T(2) * d);
            out.Phi[e] = eq.plane ? T(g.dot(d)) : T(d.squaredNorm() - eq.length * eq.length);  // (21), (23)
            out.arm[e] = P - anchor(), out.span[e] = d, out.gradient[e] = g;
            out.wrench[e] = force_at<T>(out.arm[e], g);  // (26), A.3
        }
    }

    T solved(const LinkagePosition<T>& at, int i, const std::array<T, max_equations>& right) const {
        T sum(0);
        for (int e = 0; e < nW(); ++e) sum += at.Phi_w_inverse(i, e) * right[e];
        return sum;
    }

    // Small matrices by cofactors, which need no pivots.
    void invert_dependent(LinkagePosition<T>& out) const {
        const auto invert = [&](auto size) {
            constexpr int n = size;
            Matrix<T, n, n> Phi_w;
            for (int r = 0; r < n; ++r) {
                for (int c = 0; c < n; ++c) Phi_w(r, c) = entry(out, r, dependent[c]);
            }
            const auto [matrix, determinant] = inverse<T>(Phi_w);
            out.Phi_w_inverse.template topLeftCorner<n, n>() = matrix;
            out.determinant = determinant;
        };
        if (nW() == 1) return invert(std::integral_constant<int, 1>());
        if (nW() == 3) return invert(std::integral_constant<int, 3>());
        Matrix<T, max_equations, max_equations> ordered;
        for (int r = 0; r < nW(); ++r) {
            for (int c = 0; c < nW(); ++c) {
                ordered(r, c) = entry(out, pivot_equation[r], dependent[pivot_dependent[c]]);
            }
        }
        out.determinant = invert_in_place<T, max_equations>(ordered, nW());
        for (int r = 0; r < nW(); ++r) {
            for (int c = 0; c < nW(); ++c) {
                out.Phi_w_inverse(pivot_dependent[c], pivot_equation[r]) = ordered(c, r);
            }
        }
    }

    void eliminate(const RackMotion<T>& rack, const T& alpha, LinkagePosition<T>& out) const {
        invert_dependent(out);
        for (int j = 0; j < nV(); ++j) {
            std::array<T, max_equations> Phi_v;
            for (int e = 0; e < nW(); ++e) Phi_v[e] = entry(out, e, independent[j]);
            for (int k = 0; k < nV(); ++k) out.Y[independent[k]][j] = T(k == j ? 1 : 0);
            for (int i = 0; i < nW(); ++i) out.Y[dependent[i]][j] = -solved(out, i, Phi_v);  // (39)
        }
        std::array<T, max_equations> driven;  // (27), (28)
        for (int e = 0; e < nW(); ++e) {
            const LoopEquation<T>& eq = equations[e];
            driven[e] = alpha * out.Phi[e] - out.gradient[e].dot(out.pose[eq.base].direction(eq.drive)) * rack.rate;
        }
        for (int k = 0; k < nV(); ++k) out.X[independent[k]] = T(0);
        for (int i = 0; i < nW(); ++i) {
            out.X[dependent[i]] = -solved(out, i, driven);
            out.correction[i] = -solved(out, i, out.Phi);
        }
    }

    // Refers a motion about the anchor to the chassis origin.
    Spatial<T> referred(const Spatial<T>& motion) const {
        return spatial<T>(linear(motion) - angular(motion).cross(anchor()), angular(motion));
    }
    void refer(const FrameMotions<T>& from, FrameMotions<T>& to) const {
        to.J[0].setZero(), to.x[0].setZero();
        for (int frame = 1; frame <= nq(); ++frame) {
            for (int j = 0; j < nV(); ++j) to.J[frame].col(j) = referred(from.J[frame].col(j));
            to.x[frame] = referred(from.x[frame]);
        }
    }

    // Sums the columns of B times the coordinates' rates, outward.
    void accumulate(const std::array<Spatial<T>, max_coordinates>& B,
                    const std::array<std::array<T, max_freedoms>, max_coordinates>& Y,
                    const std::array<T, max_coordinates>& X, FrameMotions<T>& out) const {
        out.J[0].setZero();
        out.x[0].setZero();
        for (int k = 0; k < nq(); ++k) {
            const int parent = coordinates[k].parent;
            for (int j = 0; j < nV(); ++j) out.J[k + 1].col(j) = out.J[parent].col(j) + B[k] * Y[k][j];
            out.x[k + 1] = out.x[parent] + B[k] * X[k];
        }
    }

    Spatial<T> wrench_rate(const LinkagePosition<T>& at, const LinkageRates<T>& rates, int e,
                           const RackMotion<T>& rack) const {
        const LoopEquation<T>& eq = equations[e];
        const Spatial<T>&v = rates.v[eq.part], &v_base = rates.v[eq.base];
        const Vec3<T> P = at.arm[e], P_rate = velocity_at<T>(v, P);
        Vec3<T> g_rate;
        if (eq.plane) {
            g_rate = angular(v_base).cross(at.gradient[e]);
        } else {
            const Vec3<T> foot = P - at.span[e];
            g_rate = T(2) * (P_rate - velocity_at<T>(v_base, foot) - at.pose[eq.base].direction(eq.drive) * rack.rate);
        }
        return spatial<T>(g_rate, P.cross(g_rate) + P_rate.cross(at.gradient[e]));
    }
};

}  // namespace hamilcar
