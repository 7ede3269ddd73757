// The program of the paper's Fig. 10: State -> Velocity -> Momenta -> rate of State. Integration closes the ring.
#pragma once

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// The rates of the numbers of the spokes in a row, in the order of the state.
template <class Linkage, class S>
HAMILCAR_CORE RowState<S> row_rate(const SpokeMomenta<S>& from) {
    RowState<S> numbers;
    numbers.fill(S(0));
    const SpokeState<S> to = spoke_view(numbers.data());
    for (int j = 0; j < Linkage::nV; ++j) {
        to.independent[j] = from.V_rate[j];
        to.momentum[j] = from.momentum_rate[j];
    }
    for (int j = 0; j < Linkage::nW; ++j) to.dependent[j] = from.W_rate[j];
    to.spin_momentum = from.spin_momentum_rate;
    to.deflection_x = from.deflection_x_rate;
    to.deflection_y = from.deflection_y_rate;
    to.brake_windup = from.windup_rate;
    return numbers;
}

// The rate of every number of the state, from the two blocks' outputs.
template <class T, class S>
HAMILCAR_CORE void rate_of_state(const Model<T>& model, const State<T>& state, const Velocity<T, S>& velocity,
                                 const Momenta<T, S>& momenta, State<T>& rate) {
    const Mat3<T>& R = velocity.R_GC;
    const Vec3<T> p = R * linear(velocity.momentum), r_rate = R * linear(velocity.hub);
    const Vec3<T> F = R * linear(momenta.external), N = R * angular(momenta.external);
    const Vec3<T> w = angular(velocity.hub);
    const ChassisRates<T> rates{r_rate, R * w, w, spatial<T>(p, R * angular(velocity.momentum)),
                                spatial<T>(F, N - r_rate.cross(p))};
    with_chart(model, [&](auto chart) HAMILCAR_INLINED {
        const Vector<T, 4> orientation = state.orientation();
        rate.orientation() = chart.orientation_rate(orientation, rates);
        rate.momentum() = chart.stored_momentum_rate(orientation, rates);  // (71)
    });
    rate.position() = r_rate;
    rate.work() = momenta.work_rate;
    model.vehicle.template for_each_row<S>([&](const auto& row, int i) HAMILCAR_INLINED {
        visit_spoke(row.spokes, velocity, i, [&](const auto&, const auto& suspension, const auto&) HAMILCAR_INLINED {
            using Linkage = typename std::decay_t<decltype(suspension)>::Linkage;
            scatter_row(row_rate<Linkage>(momenta.spokes[i]), row.index, row.count, rate);
        });
    });
}

// What a turn tells besides the rates.
template <class T>
struct RingTurn {
    Health<T> health;
    std::array<std::array<T, max_dependent>, max_spokes> closing;  // of W, spoke by spoke: -Phi_w^-1 Phi
    RingTurn() {}
};

template <class T, class S>
HAMILCAR_CORE RingTurn<T> turn_of(const Model<T>& model, const Velocity<T, S>& velocity) {
    RingTurn<T> turn;
    turn.health = velocity.health;
    model.vehicle.template for_each_row<S>([&](const auto& row, int i) HAMILCAR_INLINED {
        visit_spoke(row.spokes, velocity, i, [&](const auto&, const auto&, const auto& at) HAMILCAR_INLINED {
            for (int l = 0; l < row.count; ++l) {
                auto& closing = turn.closing[static_cast<std::size_t>(row.index[static_cast<std::size_t>(l)])];
                for (int j = 0; j < at.position.closing.size(); ++j)
                    closing[j] = at_place<T>(at.position.closing[j], l);
            }
        });
    });
    return turn;
}

// One turn of the ring without Integration; a lean account leaves the work of the energy balance alone.
template <Account account, class T>
[[gnu::flatten]] RingTurn<T> turn_ring(const Model<T>& model, const Input<T>& input, const State<T>& state,
                                       State<T>& rate) {
    using S = Abreast<T>;
    const Velocity<T, S> velocity = velocity_block_of<S>(model, state, input);
    const Momenta<T, S> momenta = momenta_block_of<account>(model, state, input, velocity);
    rate_of_state(model, state, velocity, momenta, rate);
    if constexpr (account == Account::lean) rate.work() = T(0);
    return turn_of(model, velocity);
}

// The right-hand side.
template <class T>
RingTurn<T> evaluate(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate) {
    return model.energy_balance ? turn_ring<Account::full>(model, input, state, rate)
                                : turn_ring<Account::lean>(model, input, state, rate);
}

}  // namespace hamilcar
