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
    using S = Abreast<T>;
    const RackMotion<S> rack_of_row = abreast<S>(rack);
    model.vehicle.template for_each_row<S>([&](const auto& row, int) HAMILCAR_INLINED {
        dispatch(row.spokes.suspension, [&](const auto& suspension) HAMILCAR_INLINED {
            if constexpr (std::decay_t<decltype(suspension)>::Linkage::nW > 0) {
                RowState<S> numbers = gather_row<S>(state, row.index);
                const SpokeState<S> spoke = spoke_view(numbers.data());
                for (int n = 0; n < newton_steps; ++n) {
                    suspension.linkage.newton_step(spoke.independent, spoke.dependent, rack_of_row);
                }
                scatter_row(numbers, row.index, row.count, state);
            }
        });
    });
}

template <class T>
HAMILCAR_CORE void add_closing(const Model<T>& model, const RingTurn<T>& turn, State<T>& state) {
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        const auto& closing = turn.closing[static_cast<std::size_t>(i)];
        dispatch(model.vehicle.spokes[static_cast<std::size_t>(i)].suspension, [&](const auto& suspension) {
            for (int j = 0; j < std::decay_t<decltype(suspension)>::Linkage::nW; ++j) {
                state.spoke(i).dependent[j] += closing[static_cast<std::size_t>(j)];
            }
        });
    }
}

// One Newton step on |q|^2 = 1: a step's drift is so small that it leaves nothing.
template <class T>
HAMILCAR_CORE void normalize_orientation(State<T>& state) {
    const Vector<T, 4> q = state.orientation();
    state.orientation() = q * (T(1.5) - T(0.5) * q.squaredNorm());
}

// One step; `input_at(t)` is the driver. Returns the worst health met on the way; of the adaptive method only at the start,
// since its rejected trials lead anywhere.
template <class T, class Driver>
Health<T> integration_block(const Model<T>& model, Integrator<State<T>>& integrator, const Driver& input_at, double t,
                            State<T>& state) {
    const bool trials = integrator.method().family == MethodFamily::embedded_runge_kutta;
    RingTurn<T> start;
    bool started = false;
    const auto rate_at = [&](double time, const State<T>& at, State<T>& rate) {
        const RingTurn<T> turn = evaluate(model, input_at(time), at, rate);
        if (!started) {
            start = turn;
        } else if (!trials) {
            start.health.include(turn.health);
        }
        started = true;
    };
    integrator.advance(rate_at, t, state);
    if (model.constraints == ConstraintMode::exact) add_closing(model, start, state);
    if (model.chart == ChassisChart::quaternion) normalize_orientation(state);
    return start.health;
}

}  // namespace hamilcar
