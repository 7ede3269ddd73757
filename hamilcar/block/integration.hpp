// Integration block (paper, section 6.1 (3)): q and P_a to the next step, then back onto what must hold exactly.
//
// In exact mode W is integrated with alpha = 0, and each step takes back in full what its first turn of the ring found
// open: a Newton step on Phi(V, W, t) = 0 with matrices that the Velocity block has anyway, so that no more than one step's
// own error of integration ever stands open. In the paper's mode (27) does this job, at the rate alpha. The quaternion is
// brought back to unit length. Neither touches an independent coordinate or a momentum.
#pragma once

#include "hamilcar/block/ring.hpp"
#include "hamilcar/integrator/integrator.hpp"

namespace hamilcar {

// W from Phi(V, W, t) = 0 by warm-started Newton steps.
template <class T>
void close_loops(const Model<T>& model, const RackMotion<T>& rack, State<T>& state, int newton_steps) {
    for (const Suspension<T>& suspension : model.vehicle.suspensions) {
        const SuspensionState<T> at = suspension.state(state.values.data());
        for (int n = 0; n < newton_steps; ++n) suspension.linkage.newton_step(at.independent, at.dependent, rack);
    }
}

extern template void close_loops<double>(const Model<double>&, const RackMotion<double>&, State<double>&, int);

template <class T>
void add_closing(const Model<T>& model, const RingTurn<T>& turn, State<T>& state) {
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
        const Suspension<T>& suspension = model.vehicle.suspensions[s];
        T* dependent = suspension.state(state.values.data()).dependent;
        for (int j = 0; j < suspension.linkage.nW(); ++j) {
            dependent[j] += turn.closing[s][static_cast<std::size_t>(j)];
        }
    }
}

// One Newton step on |q|^2 = 1: a step's drift is so small that it leaves nothing.
template <class T>
T normalizing_factor(const T& x, const T& y, const T& z, const T& w) {
    return T(1.5) - T(0.5) * ((x * x + y * y) + (z * z + w * w));
}
template <class T>
Vector<T, 4> normalized(const Vector<T, 4>& q) {
    return q * normalizing_factor<T>(q[0], q[1], q[2], q[3]);
}

// The ring as it is written, for any number.
template <class T>
struct PlainRing {
    using Report = RingTurn<T>;
    const Model<T>& model;

    void turn(const Input<T>& input, const State<T>& state, State<T>& rate, Report& report) const {
        evaluate(model, input, state, rate, report);
    }
    static void include_health(const Report& further, Report& worst) { worst.health.include(further.health); }
    void finish(const Report& first, State<T>& to) const {
        if (model.constraints == ConstraintMode::exact) add_closing(model, first, to);
        if (model.chart == ChassisChart::quaternion) to.orientation() = normalized<T>(to.orientation());
    }
};

// One step by any ring that has the four functions above, from a state to another or in place; `input_at(t)` is the driver.
// `first` is what the first turn tells, with the worst health met on the way; of the adaptive method only that at the start,
// since its rejected trials lead anywhere. `further` is scratch.
template <class Ring, class State, class Driver>
void integrate(const Ring& ring, Integrator<State>& integrator, const Driver& input_at, double t, const State& from,
               State& to, typename Ring::Report& first, typename Ring::Report& further) {
    const bool trials = integrator.method().family == MethodFamily::embedded_runge_kutta;
    int turns = 0;
    const auto rate_at = [&](double time, const State& at, State& rate) {
        ring.turn(input_at(time), at, rate, turns == 0 ? first : further);
        if (turns > 0 && !trials) Ring::include_health(further, first);
        ++turns;
    };
    integrator.advance(rate_at, t, from, to);
    ring.finish(first, to);
}

// By the plain ring.
template <class T, class Driver>
Health<T> integration_block(const Model<T>& model, Integrator<State<T>>& integrator, const Driver& input_at, double t,
                            State<T>& state) {
    RingTurn<T> first, further;
    integrate(PlainRing<T>{model}, integrator, input_at, t, state, state, first, further);
    return first.health;
}

}  // namespace hamilcar
