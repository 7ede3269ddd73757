// The right-hand side, by the blocks of the paper's Fig. 10: State -> Velocity -> Momenta -> rate of State.
#pragma once

#include "hamilcar/block/measurement.hpp"

namespace hamilcar {

// Writes the rates of suspensions and trailers into the rate of a state.
template <class T, class S>
void write_suspension_rates(const Vehicle<T>& vehicle, const Velocity<T, S>& velocity, const Momenta<T>& momenta,
                            State<T>& rate) {
    T* values = rate.values.data();
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<T>& suspension = vehicle.suspensions[s];
        const SuspensionMomenta<T>& from = momenta.suspensions[s];
        const auto to = suspension.state(values);
        for (int j = 0; j < suspension.linkage.nV(); ++j) {
            to.independent[j] = velocity.suspensions[s].own.V_rate[j];
            to.momentum[j] = from.momentum_rate[j];
        }
        for (int i = 0; i < suspension.linkage.nW(); ++i) to.dependent[i] = from.W_rate[i];
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            const auto wheel = suspension.wheel_state(static_cast<int>(i), values);
            wheel.spin_momentum = from.spin_momentum_rate[i];
            wheel.brake_windup = from.windup_rate[i];
            for (int k = 0; k < suspension.wheels[i].tires; ++k) {
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

template <class T, class S>
void write_steering_rates(const SteeringSystem<T>& steering, const Velocity<T, S>& velocity, const Momenta<T>& momenta,
                          State<T>& rate) {
    const auto to = steering.state(rate.values.data());
    const typename SteeringSystem<T>::Output& from = momenta.steering;
    to.rack = velocity.rack.rate;
    to.rack_momentum = momenta.on_rack + from.on_rack;
    to.wheel = from.wheel_rate;
    to.wheel_momentum = from.on_wheel;
    to.rack_windup = from.rack_windup_rate;
    to.wheel_windup = from.wheel_windup_rate;
    to.assist = from.assist_rate;
}

// The rate of every number of the state, from the two blocks' outputs.
template <class T, class S>
void rate_of_state(const Model<T>& model, const State<T>& state, const Velocity<T, S>& velocity,
                   const Momenta<T>& momenta, State<T>& rate) {
    const Mat3<T>& R = velocity.R_GC;
    const Vec3<T> p = R * linear(velocity.momentum), r_rate = R * linear(velocity.chassis);
    const Vec3<T> F = R * linear(momenta.external), N = R * angular(momenta.external);
    const Vec3<T> w = angular(velocity.chassis);
    const ChassisRates<T> rates{r_rate, R * w, w, spatial<T>(p, R * angular(velocity.momentum)),
                                spatial<T>(F, N - r_rate.cross(p))};
    with_chart(model, [&](auto chart) {
        const Vector<T, 4> orientation = state.orientation();
        rate.orientation() = chart.orientation_rate(orientation, rates);
        rate.momentum() = chart.stored_momentum_rate(orientation, rates);  // (71)
    });
    rate.position() = r_rate;
    rate.work() = momenta.work_rate;
    write_suspension_rates(model.vehicle, velocity, momenta, rate);
    if (model.vehicle.powertrain.exists()) {
        write_powertrain_rates(model.vehicle.powertrain, momenta.powertrain, rate);
    }
    if (model.vehicle.steering.exists()) write_steering_rates(model.vehicle.steering, velocity, momenta, rate);
    for (std::size_t i = 0; i < model.vehicle.actuators.size(); ++i) {
        rate.values[static_cast<std::size_t>(model.vehicle.actuator_place) + i] = momenta.actuator_rates[i];
    }
    for (std::size_t i = 0; i < model.vehicle.axle_steers.size(); ++i) {
        model.vehicle.axle_steers[i].write_rates(velocity.axle_racks[i], rate.values.data());
    }
    write_brake_rates(model.vehicle.brakes, momenta.brakes, rate);
}

// What an evaluation gives besides the rates.
template <class T>
struct Evaluation {
    Health<T> health;
    std::array<std::array<T, max_equations>, max_suspensions>
        correction;                            // Newton corrections of W by suspension: -Phi_w^-1 Phi
    std::array<T, max_measurements> measured;  // of a car with controllers (measurement.hpp)
    Evaluation() {}
};

template <class T, class S>
void report_evaluation(const Model<T>& model, const Velocity<T, S>& velocity, Evaluation<T>& out) {
    out.health = velocity.health;
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
        out.correction[s] = velocity.suspensions[s].at.correction;
    }
}

// S is the scalar type for pairs of suspensions.
template <class S, class T>
void evaluate_rhs_by(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate,
                     Evaluation<T>& out) {
    const Velocity<T, S> velocity = velocity_block_of<S>(model, state, input);
    const Momenta<T> momenta = momenta_block_of(model, state, input, velocity);
    rate_of_state(model, state, velocity, momenta, rate);
    if (!model.energy_balance) rate.work() = T(0);
    report_evaluation(model, velocity, out);
    if (model.vehicle.is_measured) measure(model.vehicle, state, velocity, momenta, out.measured.data());
}

template <class T>
void evaluate_rhs(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate,
                  Evaluation<T>& out) {
    evaluate_rhs_by<T>(model, input, state, rate, out);
}

// Compiled once, in plain_blocks.cpp.
extern template void evaluate_rhs<double>(const Model<double>&, const Input<double>&, const State<double>&,
                                          State<double>&, Evaluation<double>&);

template <class T>
Evaluation<T> evaluate_rhs(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate) {
    Evaluation<T> out;
    evaluate_rhs(model, input, state, rate, out);
    return out;
}

}  // namespace hamilcar
