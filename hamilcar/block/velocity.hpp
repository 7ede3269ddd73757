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

// The momenta of all rotors, in the chassis's axes.
template <class T>
Vec3<T> rotor_momenta(const Powertrain<T>& powertrain, const State<T>& state) {
    Vec3<T> sum = Vec3<T>::Zero();
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        sum += powertrain.units[i].axis * powertrain.unit_state(i, state.values.data()).momentum;
    }
    return sum;
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
    CondensedUnit<T> rest = condense_suspensions(model, state, input.rack, out);
    if (vehicle.powertrain.exists()) angular(rest.b) += rotor_momenta(vehicle.powertrain, state);
    vehicle.chassis_inertia.add_to_lower(rest.K);
    out.chassis = solve_positive_definite<T>(rest.K, Spatial<T>(out.momentum - rest.b));  // (58)
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
