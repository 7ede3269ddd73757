// Velocity block (paper, Fig. 10 and section 6.1 (4)): from positions and momenta to velocities.
//
// Each suspension eliminates its own V' and adds an inertia and a momentum to the chassis (suspension_velocity.hpp); one 6x6
// solve gives the chassis's velocity, from which the rates of each suspension follow:
//     (Mhat_1 + sum[Mhat - Mhat J m^-1 J^T Mhat]) v_1 = h_total - sum[Mhat x + (0 ; e p_s) + Mhat J m^-1 k]
//     V' = m^-1 (k - J^T Mhat v_1)                                                          // (58), (59), A.5
// Everything is in chassis axes about the chassis origin, where suspensions depend on their own coordinates alone.
#pragma once

#include "hamilcar/block/suspension_velocity.hpp"

namespace hamilcar {

// The momenta of all rotors and of gearboxes with an inertia, in the chassis's axes.
template <class T>
Vec3<T> rotor_momenta(const Powertrain<T>& powertrain, const State<T>& state) {
    Vec3<T> sum = Vec3<T>::Zero();
    for (const PowerUnit<T>& unit : powertrain.units) {
        if (!unit.rotor_is_free) continue;
        const auto at = unit.state(state.values.data());
        sum += unit.axis * at.momentum;
        if (unit.shafts.exist()) sum += unit.axis * at.shafts[0];
    }
    return sum;
}

// A rack that moves on its own (docs/theory/steering.md): with what the suspensions add to both equations,
//     K v_1 + c rack' = b',   c^T v_1 + (inertia + m_rack) rack' = P_rack - momentum
// where `out.chassis` is K^-1 b' so far.
template <class T, class S>
void free_rack(const Vehicle<T>& vehicle, const State<T>& state, const Matrix<T, 6, 6>& K,
               const RackCoupling<T>& coupling, Velocity<T, S>& out) {
    const Spatial<T> y = solve_positive_definite<T>(K, coupling.c);
    const T inertia = vehicle.steering.rack_mass + coupling.inertia - coupling.c.dot(y);
    const T momentum = vehicle.steering.state(state.values.data()).rack_momentum - coupling.momentum;
    const T rate = (momentum - coupling.c.dot(out.chassis)) / inertia;
    out.chassis -= y * rate;
    out.rack.rate = rate;
    move_rack(vehicle, rate, out);
}

// The rack as prescribed; one that moves on its own stands where the state says, and moves by one unit until its rate is known.
template <class T>
RackMotion<T> rack_of(const Vehicle<T>& vehicle, const State<T>& state, const Input<T>& input) {
    if (!vehicle.steering.exists()) return input.rack;
    return {vehicle.steering.state(state.values.data()).rack, T(1), T(0)};
}

// S is the scalar type for pairs of suspensions: Paired<T>, or T itself to evaluate them one after the other.
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
    const bool rack_is_free = vehicle.steering.exists();
    RackCoupling<T> coupling;
    out.rack = rack_of(vehicle, state, input);
    for (std::size_t i = 0; i < vehicle.axle_steers.size(); ++i) {
        out.axle_racks[i] = vehicle.axle_steers[i].motion(state.values.data(), input.commands);
    }
    CondensedUnit<T> rest = condense_suspensions(model, state, out, rack_is_free ? &coupling : nullptr);
    if (vehicle.powertrain.exists()) angular(rest.b) += rotor_momenta(vehicle.powertrain, state);
    vehicle.chassis_inertia.add_to_lower(rest.K);
    out.chassis = solve_positive_definite<T>(rest.K, Spatial<T>(out.momentum - rest.b));  // (58)
    if (rack_is_free) free_rack(vehicle, state, rest.K, coupling, out);
    move_suspensions(vehicle, out);
    return out;
}

// One suspension after the other, with all of their results.
template <class T>
Velocity<T> velocity_block(const Model<T>& model, const State<T>& state, const Input<T>& input) {
    return velocity_block_of<T>(model, state, input);
}

// Compiled once, in plain_blocks.cpp.
extern template Velocity<double> velocity_block<double>(const Model<double>&, const State<double>&,
                                                        const Input<double>&);

}  // namespace hamilcar
