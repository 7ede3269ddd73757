// Where the rates of composed suspensions and trailers stand in the rate of a state.
#pragma once

#include "hamilcar/block/composed_momenta.hpp"

namespace hamilcar {

// The rates of their numbers.
template <class T, class S>
void write_composed_rates(const Vehicle<T>& vehicle, const ComposedVelocities<T, S>& velocity,
                          const ComposedMomentaOfAll<T>& momenta, State<T>& rate) {
    T* values = rate.values.data();
    for (std::size_t s = 0; s < vehicle.composed.size(); ++s) {
        const ComposedSpoke<T>& spoke = vehicle.composed[s];
        const ComposedMomenta<T>& from = momenta.spokes[s];
        const auto to = spoke.state(values);
        for (int j = 0; j < spoke.linkage.nV(); ++j) {
            to.independent[j] = velocity.spokes[s].own.V_rate[j];
            to.momentum[j] = from.momentum_rate[j];
        }
        for (int i = 0; i < spoke.linkage.nW(); ++i) to.dependent[i] = from.W_rate[i];
        for (std::size_t i = 0; i < spoke.wheels.size(); ++i) {
            const auto wheel = spoke.wheel_state(static_cast<int>(i), values);
            wheel.spin_momentum = from.spin_momentum_rate[i];
            wheel.brake_windup = from.windup_rate[i];
            for (int k = 0; k < spoke.wheels[i].tires; ++k) {
                wheel.deflection[2 * k] = from.wheels[i].tires[static_cast<std::size_t>(k)].tire.u_rate;
                wheel.deflection[2 * k + 1] = from.wheels[i].tires[static_cast<std::size_t>(k)].tire.v_rate;
            }
        }
    }
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        const int n = trailer.freedoms();
        for (int j = 0; j < n; ++j) {
            values[trailer.offset + j] = velocity.trailers[i].own.V_rate[j];
            values[trailer.offset + n + j] = momenta.trailers[i].momentum_rate[j];
        }
    }
}

}  // namespace hamilcar
