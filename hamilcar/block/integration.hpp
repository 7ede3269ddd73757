// Integration block (paper, section 6.1 (3)): q and P_a to the next step, then back onto what must hold exactly.
//
// In exact mode W is integrated with alpha = 0, which is a prediction, and a Newton step on Phi(V, W, t) = 0 puts it back
// on the constraints at the end of each step; in the paper's mode (27) does this job. The quaternion is brought back to
// unit length. Neither touches an independent coordinate or a momentum.
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
void normalize_orientation(State<T>& state) {
    const Vector<T, 4> q = state.orientation();
    state.orientation() = q * (T(1) / sqrt(q.squaredNorm()));
}

// One step; `input_at(t)` is the driver. Returns the worst health met on the way; of the adaptive method only at the start,
// since its rejected trials lead anywhere.
template <class T, class Driver>
Health<T> integration_block(const Model<T>& model, Integrator<State<T>>& integrator, const Driver& input_at, double t,
                            State<T>& state) {
    const bool trials = integrator.method().family == MethodFamily::embedded_runge_kutta;
    Health<T> health;
    const auto rate_at = [&](double time, const State<T>& at, State<T>& rate) {
        const Health<T> here = evaluate(model, input_at(time), at, rate);
        if (!trials || time == t) health.include(here);
    };
    integrator.advance(rate_at, t, state);
    if (model.constraints == ConstraintMode::exact) close_loops(model, input_at(t + integrator.step()).rack, state, 1);
    if (model.chart == ChassisChart::quaternion) normalize_orientation(state);
    return health;
}

}  // namespace hamilcar
