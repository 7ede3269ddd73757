// Velocity block (paper, Fig. 10 and section 6.1 (4)): from positions and momenta to velocities.
//
// With h_j = Mhat_j (v_1 + J_j V_j' + x_j) + (0 ; e p_s) and P_V = J^T h each spoke eliminates its own V' and hands the
// hub an inertia and a momentum; one 6x6 solve gives the chassis velocity, each spoke reads off its rates:
//     m = J^T Mhat J,   k = P_V - J^T (Mhat x + (0 ; e p_s))
//     (Mhat_1 + sum[Mhat - Mhat J m^-1 J^T Mhat]) v_1 = h_total - sum[Mhat x + (0 ; e p_s) + Mhat J m^-1 k]
//     V' = m^-1 (k - J^T Mhat v_1)                                                          // (58), (59), A.5
// Everything is in chassis axes about the chassis origin, where spokes depend on their own coordinates alone.
#pragma once

#include "hamilcar/block/model.hpp"

namespace hamilcar {

template <class T, class S>
struct SpokeVelocity {
    using Linkage = typename S::Linkage;
    static constexpr int nV = Linkage::nV;
    typename Linkage::Position position;
    SpatialInertia<T> inertia;  // Mhat of the carrier
    Vec3<T> wheel_center;       // [m]
    Vec3<T> spin_axis;          // e
    Spatial<T> spin_momentum;   // (0 ; e p_s)
    Matrix<T, 6, nV> MJ;        // Mhat J
    Matrix<T, nV, nV> m_inverse;
    Vector<T, nV> k;
    Vector<T, nV> V_rate;
    Spatial<T> motion;  // v_1 + J V' + x
    SpokeVelocity() {}  // every number is written by the block
};

namespace detail {
template <class T, class List>
struct SpokeVelocities;
template <class T, class... S>
struct SpokeVelocities<T, std::variant<S...>> {
    using type = std::variant<SpokeVelocity<T, S>...>;
};
}  // namespace detail

template <class T>
using AnySpokeVelocity = typename detail::SpokeVelocities<T, Suspension<T>>::type;

// Flags of the mathematics, for whoever watches the run: never a throw inside a step.
template <class T>
struct Health {
    T violation{0};  // largest |Phi| of all cut equations [m or m^2]
    T mobility{1};   // smallest det Phi_w relative to design; 0 where a linkage locks, negative beyond

    void include(const Health& other) {
        violation = max(violation, other.violation);
        mobility = min(mobility, other.mobility);
    }
};

template <class T>
struct Velocity {
    Health<T> health;
    Mat3<T> R_GC;         // chassis to ground axes
    Spatial<T> momentum;  // (p ; L) in chassis axes
    Spatial<T> hub;       // v_1
    std::array<AnySpokeVelocity<T>, max_spokes> spokes;
    Velocity() {}
};

// Calls f(spoke, suspension, its velocities) with the types resolved, once for the spoke.
template <class T, class VelocityRef, class F>
decltype(auto) visit_spoke(const Vehicle<T>& vehicle, VelocityRef& velocity, int i, F&& f) {
    const Spoke<T>& spoke = vehicle.spokes[i];
    return std::visit(
        [&](const auto& suspension) -> decltype(auto) {
            using S = std::decay_t<decltype(suspension)>;
            return f(spoke, suspension, *std::get_if<SpokeVelocity<T, S>>(&velocity.spokes[i]));
        },
        spoke.suspension);
}

// Positions, inertia and condensed momentum of one spoke; adds its share to the hub's 6x6 system.
template <class T, class S>
void condense_spoke(const Spoke<T>& spoke, const S& suspension, const SpokeState<const T>& state,
                    const RackMotion<T>& rack, const T& gain, SpokeVelocity<T, S>& out, Matrix<T, 6, 6>& K,
                    Spatial<T>& rest) {
    constexpr int nV = S::Linkage::nV;
    out.position = suspension.linkage.position(state.independent, state.dependent, rack, gain);
    const auto& at = out.position;
    out.inertia = SpatialInertia<T>::about_origin(spoke.carrier.mass, at.pose.point(spoke.carrier.center),
                                                  spoke.carrier.inertia.rotated(at.pose.R));
    out.wheel_center = at.pose.point(spoke.wheel.center);
    out.spin_axis = at.pose.direction(spoke.wheel.axis);
    out.spin_momentum = spatial<T>(Vec3<T>::Zero(), out.spin_axis * state.spin_momentum);
    for (int j = 0; j < nV; ++j) out.MJ.col(j) = out.inertia * Spatial<T>(at.J.col(j));
    out.m_inverse = inverse<T>(Matrix<T, nV, nV>(at.J.transpose() * out.MJ)).matrix;  // (59), A.5

    Spatial<T> carried = out.spin_momentum;
    if constexpr (S::Linkage::nW > 0) carried += out.inertia * at.x;
    out.k = Eigen::Map<const Vector<T, nV>>(state.momentum) - at.J.transpose() * carried;  // (57)

    const Matrix<T, 6, nV> condensed = out.MJ * out.m_inverse;
    out.inertia.add_to_lower(K);
    for (int j = 0; j < 6; ++j) {
        for (int i = j; i < 6; ++i) K(i, j) -= condensed.row(i).dot(out.MJ.row(j));
    }
    rest -= carried + condensed * out.k;
}

template <class T>
Velocity<T> velocity_block(const Model<T>& model, const State<T>& state, const Input<T>& input) {
    Velocity<T> out;
    const Vehicle<T>& vehicle = model.vehicle;
    with_chart(model, [&](auto chart) {
        const Vector<T, 4> orientation = state.orientation();
        out.R_GC = chart.rotation(orientation);
        const Spatial<T> momentum = chart.momentum(orientation, state.momentum());
        out.momentum = spatial<T>(out.R_GC.transpose() * linear(momentum), out.R_GC.transpose() * angular(momentum));
    });
    Matrix<T, 6, 6> K = Matrix<T, 6, 6>::Zero();
    vehicle.chassis_inertia.add_to_lower(K);
    Spatial<T> rest = out.momentum;
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        std::visit(
            [&](const auto& suspension) {
                using S = std::decay_t<decltype(suspension)>;
                auto& spoke = out.spokes[i].template emplace<SpokeVelocity<T, S>>();
                condense_spoke(vehicle.spokes[i], suspension, state.spoke(i), input.rack, model.stabilization_gain,
                               spoke, K, rest);
                for (int j = 0; j < S::Linkage::nW; ++j) {
                    out.health.violation = max(out.health.violation, abs(spoke.position.Phi[j]));
                }
                out.health.mobility =
                    min(out.health.mobility, spoke.position.determinant * vehicle.spokes[i].inverse_design_determinant);
            },
            vehicle.spokes[i].suspension);
    }
    out.hub = solve_positive_definite<T, 6>(K, rest);  // (58)
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        visit_spoke(vehicle, out, i, [&](const auto&, const auto&, auto& spoke) {
            spoke.V_rate = spoke.m_inverse * (spoke.k - spoke.MJ.transpose() * out.hub);  // (58)
            spoke.motion = out.hub + spoke.position.J * spoke.V_rate + spoke.position.x;  // (18), (42)
        });
    }
    return out;
}

}  // namespace hamilcar
