// The program of the paper's Fig. 10: State -> Velocity -> Momenta -> rate of State. Integration closes the ring.
#pragma once

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// The rate of every number of the state, from the two blocks' outputs.
template <class T>
void rate_of_state(const Model<T>& model, const State<T>& state, const Velocity<T>& velocity, const Momenta<T>& momenta,
                   State<T>& rate) {
    const Mat3<T>& R = velocity.R_GC;
    const Vec3<T> p = R * linear(velocity.momentum), r_rate = R * linear(velocity.hub);
    const Vec3<T> F = R * linear(momenta.external), N = R * angular(momenta.external);
    const Vec3<T> w = angular(velocity.hub);
    const ChassisRates<T> rates{r_rate, R * w, w, spatial<T>(p, R * angular(velocity.momentum)),
                                spatial<T>(F, N - r_rate.cross(p))};
    with_chart(model, [&](auto chart) {
        const Vector<T, 4> orientation = state.orientation();
        rate.orientation() = chart.orientation_rate(orientation, rates);
        rate.momentum() = chart.stored_momentum_rate(orientation, rates);  // (71)
    });
    rate.position() = r_rate;
    rate.work() = momenta.work_rate;
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        const SpokeMomenta<T>& from = momenta.spokes[i];
        SpokeState<T> to = rate.spoke(i);
        visit_spoke(model.vehicle, velocity, i, [&](const auto&, const auto& suspension, const auto&) {
            using Linkage = typename std::decay_t<decltype(suspension)>::Linkage;
            for (int j = 0; j < Linkage::nV; ++j) {
                to.independent[j] = from.V_rate[j];
                to.momentum[j] = from.momentum_rate[j];
            }
            for (int j = 0; j < Linkage::nW; ++j) to.dependent[j] = from.W_rate[j];
        });
        to.spin_momentum = from.spin_momentum_rate;
        to.deflection_x = from.deflection_x_rate;
        to.deflection_y = from.deflection_y_rate;
        to.brake_windup = from.windup_rate;
    }
}

// The right-hand side: one turn of the ring without Integration.
template <class T>
Health<T> evaluate(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate) {
    const Velocity<T> velocity = velocity_block(model, state, input);
    const Momenta<T> momenta = momenta_block(model, state, input, velocity);
    rate_of_state(model, state, velocity, momenta, rate);
    return velocity.health;
}

}  // namespace hamilcar
