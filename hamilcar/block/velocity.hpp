// Velocity block (paper, Fig. 10 and section 6.1 (4)): from positions and momenta to velocities.
//
// With h_j = Mhat_j (v_1 + J_j V_j' + x_j) + (0 ; e p_s) and P_V = J^T h each spoke eliminates its own V' and hands the
// hub an inertia and a momentum; one 6x6 solve gives the chassis velocity, each spoke reads off its rates:
//     m = J^T Mhat J,   k = P_V - J^T (Mhat x + (0 ; e p_s))
//     (Mhat_1 + sum[Mhat - Mhat J m^-1 J^T Mhat]) v_1 = h_total - sum[Mhat x + (0 ; e p_s) + Mhat J m^-1 k]
//     V' = m^-1 (k - J^T Mhat v_1)                                                          // (58), (59), A.5
// Everything is in chassis axes about the chassis origin, where spokes depend on their own coordinates alone.
#pragma once

#include "hamilcar/block/composed_velocity.hpp"
#include "hamilcar/vehicle/place_sum.hpp"

namespace hamilcar {

template <class T, class Kind>
struct SpokeVelocity {
    using Linkage = typename Kind::Linkage;
    static constexpr int nV = Linkage::nV;
    typename Linkage::Position position;
    SpatialInertia<T> inertia;  // Mhat of the carrier
    Vec3<T> wheel_center;       // [m]
    Vec3<T> spin_axis;          // e
    Vec3<T> spin_momentum;      // e p_s
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

// S is the number that carries the spokes: T itself for one spoke after the other, Abreast<T> for a row at a time.
template <class T, class S = T>
struct Velocity {
    Health<T> health;
    Mat3<T> R_GC;         // chassis to ground axes
    Spatial<T> momentum;  // (p ; L) in chassis axes
    Spatial<T> hub;       // v_1
    StaticVector<AnySpokeVelocity<S>, max_spokes> spokes;
    ComposedVelocities<T, S> composed;  // and trailers
    Velocity() {}
};

// Calls f(spoke, suspension, its velocities) with the types resolved, once for the spoke or the spokes abreast.
template <class S, class VelocityRef, class F>
decltype(auto) visit_spoke(const Spoke<S>& spoke, VelocityRef& velocity, int i, F&& f) {
    return dispatch(spoke.suspension, [&](const auto& suspension) -> decltype(auto) {
        using Kind = std::decay_t<decltype(suspension)>;
        return f(spoke, suspension, *std::get_if<SpokeVelocity<S, Kind>>(&velocity.spokes[i]));
    });
}
template <class T, class VelocityRef, class F>
decltype(auto) visit_spoke(const Vehicle<T>& vehicle, VelocityRef& velocity, int i, F&& f) {
    return visit_spoke(vehicle.spokes[i], velocity, i, f);
}

// Positions, inertia and condensed momentum of one spoke.
template <class S, class Kind>
CondensedSpoke<S> condense_spoke(const Spoke<S>& spoke, const Kind& suspension, const SpokeState<const S>& state,
                                 const RackMotion<S>& rack, const S& gain, SpokeVelocity<S, Kind>& out) {
    constexpr int nV = Kind::Linkage::nV;
    suspension.linkage.find_position(state.independent, state.dependent, rack, gain, out.position);
    const auto& at = out.position;
    out.inertia = SpatialInertia<S>::about_origin(spoke.carrier.mass, at.pose.point(spoke.carrier.center),
                                                  spoke.carrier.inertia.rotated(at.pose.R));
    out.wheel_center = at.pose.point(spoke.wheel.center);
    out.spin_axis = at.pose.direction(spoke.wheel.axis);
    out.spin_momentum = out.spin_axis * state.spin_momentum;
    for (int j = 0; j < nV; ++j) out.MJ.col(j) = out.inertia * Spatial<S>(at.J.col(j));
    out.m_inverse = inverse<S>(Matrix<S, nV, nV>(at.J.transpose() * out.MJ)).matrix;  // (59), A.5

    Spatial<S> carried = spatial<S>(Vec3<S>::Zero(), out.spin_momentum);
    if constexpr (Kind::Linkage::Position::drifts) {
        carried = out.inertia * at.x;
        angular(carried) += out.spin_momentum;
    }
    for (int j = 0; j < nV; ++j) out.k[j] = state.momentum[j] - at.J.col(j).dot(carried);  // (57)

    const Matrix<S, 6, nV> condensed = out.MJ * out.m_inverse;
    Matrix<S, 6, 6> K;
    for_each_lower([&](int i, int j, std::size_t) { K(i, j) = -condensed.row(i).dot(out.MJ.row(j)); });
    out.inertia.add_to_lower(K);
    CondensedSpoke<S> share;
    for_each_lower([&](int i, int j, std::size_t k) { share[k] = K(i, j); });
    for (std::size_t j = 0; j < 6; ++j) share[21 + j] = carried[j] + condensed.row(j).dot(out.k);
    return share;
}

// Largest |Phi| and smallest mobility of the spokes in a row.
template <class T, class S, class Kind>
Health<T> inspect_spoke(const Spoke<S>& spoke, const SpokeVelocity<S, Kind>& at, int count) {
    S violation(0);
    for (int j = 0; j < Kind::Linkage::nW; ++j) violation = max(violation, abs(at.position.Phi[j]));
    const S mobility = at.position.determinant * spoke.inverse_design_determinant;
    Health<T> health;
    for (int i = 0; i < count; ++i) health.include({at_place<T>(violation, i), at_place<T>(mobility, i)});
    return health;
}

// The momenta of all rotors, in the chassis's axes.
template <class T>
Vec3<T> rotor_momenta(const Powertrain<T>& powertrain, const State<T>& state) {
    Vec3<T> sum = Vec3<T>::Zero();
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        sum += powertrain.units[i].axis * powertrain.unit_state(i, state.values.data()).momentum;
    }
    return sum;
}

// The 6x6 system of the hub with all spokes condensed.  // (58)
template <class T>
Spatial<T> solve_hub(const SpatialInertia<T>& chassis, const Spatial<T>& momentum, const CondensedSpoke<T>& spokes) {
    Matrix<T, 6, 6> K;
    for_each_lower([&](int i, int j, std::size_t k) { K(i, j) = spokes[k]; });
    chassis.add_to_lower(K);
    Spatial<T> rest;
    for (std::size_t j = 0; j < 6; ++j) rest[j] = momentum[j] - spokes[21 + j];
    return solve_positive_definite<T>(K, rest);
}

template <class S, class T>
Velocity<T, S> velocity_block_of(const Model<T>& model, const State<T>& state, const Input<T>& input) {
    Velocity<T, S> out;
    const Vehicle<T>& vehicle = model.vehicle;
    with_chart(model, [&](auto chart) {
        const Vector<T, 4> orientation = state.orientation();
        out.R_GC = chart.rotation(orientation);
        const Spatial<T> momentum = chart.momentum(orientation, state.momentum());
        out.momentum = spatial<T>(out.R_GC.transpose() * linear(momentum), out.R_GC.transpose() * angular(momentum));
    });
    PlaceSum<T, S, std::tuple_size_v<CondensedSpoke<S>>> condensed;
    const RackMotion<S> rack = abreast<S>(input.rack);
    vehicle.template for_each_row<S>([&](const auto& row, int) {
        const auto numbers = gather_row<S>(state, row.index);
        dispatch(row.spokes.suspension, [&](const auto& suspension) {
            using Kind = std::decay_t<decltype(suspension)>;
            auto& spoke =
                std::get<SpokeVelocity<S, Kind>>(out.spokes.emplace_back(std::in_place_type<SpokeVelocity<S, Kind>>));
            condensed.add(condense_spoke<S>(row.spokes, suspension, spoke_view(numbers), rack,
                                            S(model.stabilization_gain), spoke),
                          row);
            out.health.include(inspect_spoke<T>(row.spokes, spoke, row.count));
        });
    });
    CondensedSpoke<T> total = condensed.total();
    if (vehicle.has_composed()) {
        const CondensedSpoke<T> rest = condense_composed(model, state, input.rack, out.composed, out.health);
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += rest[i];
    }
    if (vehicle.powertrain.exists()) {
        const Vec3<T> rotors = rotor_momenta(vehicle.powertrain, state);
        for (std::size_t k = 0; k < 3; ++k) total[21 + 3 + k] += rotors[static_cast<Eigen::Index>(k)];
    }
    out.hub = solve_hub(vehicle.chassis_inertia, out.momentum, total);
    const Spatial<S> hub = abreast<S>(out.hub);
    vehicle.template for_each_row<S>([&](const auto& row, int i) {
        visit_spoke(row.spokes, out, i, [&](const auto&, const auto&, auto& spoke) {
            spoke.V_rate = spoke.m_inverse * (spoke.k - spoke.MJ.transpose() * hub);  // (58)
            spoke.motion = hub + spoke.position.J * spoke.V_rate;                     // (18), (42)
            if constexpr (std::decay_t<decltype(spoke.position)>::drifts) spoke.motion += spoke.position.x;
        });
    });
    if (vehicle.has_composed()) move_composed(vehicle, out.hub, out.composed);
    return out;
}

// Spoke after spoke, for whoever looks at them.
template <class T>
Velocity<T> velocity_block(const Model<T>& model, const State<T>& state, const Input<T>& input) {
    return velocity_block_of<T>(model, state, input);
}

// Compiled once, in plain_blocks.cpp: everybody asks for it.
extern template Velocity<double> velocity_block<double>(const Model<double>&, const State<double>&,
                                                        const Input<double>&);

}  // namespace hamilcar
