// Integration block (paper, section 6.1 (3)): advances q and P_a by a step, then projects onto what must hold exactly.
//
// In exact mode W is integrated with alpha = 0, and each step removes in full the constraint violation that its first
// evaluation of the right-hand side found: a Newton step on Phi(V, W, t) = 0 with matrices that the Velocity block has
// anyway, so that the violation never exceeds the integration error of one step. In the paper's mode (27) does this, at the
// rate alpha. The quaternion is normalized. Neither changes an independent coordinate or a momentum.
#pragma once

#include "hamilcar/block/rhs.hpp"
#include "hamilcar/integrator/integrator.hpp"

namespace hamilcar {

// W from Phi(V, W, t) = 0 by warm-started Newton steps.
template <class T>
void close_loops(const Model<T>& model, const RackMotion<T>& rack, State<T>& state, int newton_steps) {
    for (const Suspension<T>& suspension : model.vehicle.suspensions) {
        const SuspensionState<T> at = suspension.state(state.values.data());
        const RackMotion<T> own = rack_at(model.vehicle, suspension, rack, state.values.data());
        for (int n = 0; n < newton_steps; ++n) suspension.linkage.newton_step(at.independent, at.dependent, own);
    }
}

extern template void close_loops<double>(const Model<double>&, const RackMotion<double>&, State<double>&, int);

template <class T>
void add_correction(const Model<T>& model, const Evaluation<T>& evaluation, State<T>& state) {
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
        const Suspension<T>& suspension = model.vehicle.suspensions[s];
        T* dependent = suspension.state(state.values.data()).dependent;
        for (int j = 0; j < suspension.linkage.nW(); ++j) {
            dependent[j] += evaluation.correction[s][static_cast<std::size_t>(j)];
        }
    }
}

// One Newton step on |q|^2 = 1: a step's error is so small that nothing is left of it.
template <class T>
T normalizing_factor(const T& x, const T& y, const T& z, const T& w) {
    return T(1.5) - T(0.5) * ((x * x + y * y) + (z * z + w * w));
}
template <class T>
Vector<T, 4> normalized(const Vector<T, 4>& q) {
    return q * normalizing_factor<T>(q[0], q[1], q[2], q[3]);
}

// The right-hand side as it is written, for any scalar type.
template <class T>
struct PlainRhs {
    using Report = Evaluation<T>;
    const Model<T>& model;

    void evaluate(const Input<T>& input, const State<T>& state, State<T>& rate, Report& report) const {
        evaluate_rhs(model, input, state, rate, report);
    }
    static void include_health(const Report& further, Report& worst) { worst.health.include(further.health); }
    void finish(const Report& first, State<T>& to) const {
        if (model.constraints == ConstraintMode::exact) add_correction(model, first, to);
        if (model.chart == ChassisChart::quaternion) to.orientation() = normalized<T>(to.orientation());
    }
};

// One step with any right-hand side that has the functions above, from one state to another or in place; `input_at(t)` gives
// the inputs. `first` becomes the report of the first evaluation with the worst health of all; with the adaptive method only
// the health at the start, since its rejected trials may go anywhere. `further` is scratch.
template <class Rhs, class State, class Driver>
void integrate(const Rhs& rhs, Integrator<State>& integrator, const Driver& input_at, double t, const State& from,
               State& to, typename Rhs::Report& first, typename Rhs::Report& further) {
    const bool trials = integrator.method().family == MethodFamily::embedded_runge_kutta;
    int evaluations = 0;
    const auto rate_at = [&](double time, const State& at, State& rate) {
        rhs.evaluate(input_at(time), at, rate, evaluations == 0 ? first : further);
        if (evaluations > 0 && !trials) Rhs::include_health(further, first);
        ++evaluations;
    };
    integrator.advance(rate_at, t, from, to);
    rhs.finish(first, to);
}

// One step with the plain right-hand side, in place.
template <class T, class Driver>
Health<T> integration_block(const Model<T>& model, Integrator<State<T>>& integrator, const Driver& input_at, double t,
                            State<T>& state) {
    Evaluation<T> first, further;
    integrate(PlainRhs<T>{model}, integrator, input_at, t, state, state, first, further);
    return first.health;
}

}  // namespace hamilcar
