// The program of the paper's Fig. 10: State -> Velocity -> Momenta -> rate of State. Integration closes the ring.
#pragma once

#include "hamilcar/block/composed_rates.hpp"
#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// The rates of a spoke's numbers; of those that its linkage does not have, zero.
template <class Linkage, class S>
void write_rates(const SpokeMomenta<S>& from, const SpokeState<S>& to) {
    for (int j = 0; j < max_independent; ++j) {
        to.independent[j] = j < Linkage::nV ? from.V_rate[j] : S(0);
        to.momentum[j] = j < Linkage::nV ? from.momentum_rate[j] : S(0);
    }
    for (int j = 0; j < max_dependent; ++j) to.dependent[j] = j < Linkage::nW ? from.W_rate[j] : S(0);
    to.spin_momentum = from.spin_momentum_rate;
    to.deflection_x = from.deflection_x_rate;
    to.deflection_y = from.deflection_y_rate;
    to.brake_windup = from.windup_rate;
}

// The same for the spokes in a row, each where it stands.
template <class Linkage, class S, class T, class Row>
void write_row_rates(const SpokeMomenta<S>& from, const Row& row, State<T>& rate) {
    if constexpr (row_width<S, T> == 1) {
        write_rates<Linkage>(from, rate.spoke(row.index[0]));
    } else {
        RowState<S> numbers;
        write_rates<Linkage>(from, spoke_view(numbers.data()));
        scatter_row(numbers, row.index, row.count, rate);
    }
}

// The rate of every number of the state, from the two blocks' outputs.
template <class T, class S>
void rate_of_state(const Model<T>& model, const State<T>& state, const Velocity<T, S>& velocity,
                   const Momenta<T, S>& momenta, State<T>& rate) {
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
    model.vehicle.template for_each_row<S>([&](const auto& row, int i) {
        visit_spoke(row.spokes, velocity, i, [&](const auto&, const auto& suspension, const auto&) {
            using Linkage = typename std::decay_t<decltype(suspension)>::Linkage;
            write_row_rates<Linkage>(momenta.spokes[i], row, rate);
        });
    });
    if (model.vehicle.has_composed()) {
        write_composed_rates(model.vehicle, velocity.composed, momenta.composed, rate);
    }
    if (model.vehicle.powertrain.exists()) {
        write_powertrain_rates(model.vehicle.powertrain, momenta.powertrain, rate);
    }
}

// What a turn tells besides the rates.
template <class T>
struct RingTurn {
    Health<T> health;
    std::array<std::array<T, max_dependent>, max_spokes> closing;  // of W, spoke by spoke: -Phi_w^-1 Phi
    std::array<std::array<T, max_equations>, max_composed> composed_closing;
    RingTurn() {}
};

template <class T, class S>
void report_turn(const Model<T>& model, const Velocity<T, S>& velocity, RingTurn<T>& turn) {
    turn.health = velocity.health;
    model.vehicle.template for_each_row<S>([&](const auto& row, int i) {
        visit_spoke(row.spokes, velocity, i, [&](const auto&, const auto&, const auto& at) {
            for (int l = 0; l < row.count; ++l) {
                auto& closing = turn.closing[static_cast<std::size_t>(row.index[static_cast<std::size_t>(l)])];
                for (int j = 0; j < at.position.closing.size(); ++j)
                    closing[j] = at_place<T>(at.position.closing[j], l);
            }
        });
    });
    for (std::size_t s = 0; s < model.vehicle.composed.size(); ++s) {
        turn.composed_closing[s] = velocity.composed.spokes[s].at.closing;
    }
}

// One turn of the ring without Integration; a lean account leaves the work of the energy balance alone.
template <Account account, class T>
void turn_ring(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate, RingTurn<T>& turn) {
    using S = Abreast<T>;
    const Velocity<T, S> velocity = velocity_block_of<S>(model, state, input);
    const Momenta<T, S> momenta = momenta_block_of<account>(model, state, input, velocity);
    rate_of_state(model, state, velocity, momenta, rate);
    if constexpr (account == Account::lean) rate.work() = T(0);
    report_turn(model, velocity, turn);
}

// The right-hand side.
template <class T>
void evaluate(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate, RingTurn<T>& turn) {
    if (model.energy_balance) {
        turn_ring<Account::full>(model, input, state, rate, turn);
    } else {
        turn_ring<Account::lean>(model, input, state, rate, turn);
    }
}

// Compiled once, in plain_blocks.cpp.
extern template void evaluate<double>(const Model<double>&, const Input<double>&, const State<double>&, State<double>&,
                                      RingTurn<double>&);

template <class T>
RingTurn<T> evaluate(const Model<T>& model, const Input<T>& input, const State<T>& state, State<T>& rate) {
    RingTurn<T> turn;
    evaluate(model, input, state, rate, turn);
    return turn;
}

}  // namespace hamilcar
