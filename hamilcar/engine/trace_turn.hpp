// The recording itself, for numbers of one precision: included by a source for each.
#pragma once

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/turn_trace.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

template <class E>
class TurnRecorder {
public:
    using T = Traced<E>;
    using S = Abreast<T>;

    TurnRecorder(const Model<double>& model, const CommonCar& common, TurnTrace& to)
        : from_(model), common_(common), to_(to), tracing_(to.graph) {}

    // For transcribe_model: constants, and parameters that the program is given.
    T number(double value) {
        const auto place = seen_++;
        if (common_.differs.empty() || !common_.differs[place]) return T(value);
        to_.parameters.push_back(static_cast<int>(place));
        return input(turn_parameters, static_cast<int>(to_.parameters.size()) - 1);
    }
    int whole(int own) { return common_.shape.empty() ? own : common_.shape[shape_seen_++]; }

    void record() {
        const Model<T> model = traced_model();
        State<T> state, rate;
        for (int i = 0; i < size(); ++i) state.values[static_cast<std::size_t>(i)] = input(turn_state, i);
        const Input<T> driver = traced_input();
        RingTurn<T> turn;

        to_.graph.set_block(program::Block::velocity);
        const Velocity<T, S> velocity = velocity_block_of<S>(model, state, driver);
        to_.graph.set_block(program::Block::momenta);
        const Momenta<T, S> momenta = momenta_block_of<Account::full>(model, state, driver, velocity);
        to_.graph.set_block(program::Block::integration);
        rate_of_state(model, state, velocity, momenta, rate);
        if (!model.energy_balance) rate.work() = T(0);
        report_turn(model, velocity, turn);

        for (int i = 0; i < size(); ++i) output(turn_rate, i, rate.values[static_cast<std::size_t>(i)]);
        output(turn_report, TurnReport::violation, turn.health.violation);
        output(turn_report, TurnReport::mobility, turn.health.mobility);
        if (model.constraints == ConstraintMode::exact) report_closing(model, turn);
    }

private:
    int size() const { return from_.vehicle.state_size; }
    T input(int array, int place) { return T::of(to_.graph.input(array, place)); }
    void output(int array, int place, const T& number) { to_.graph.output(array, place, number.id()); }

    Model<T> traced_model() {
        Model<T> model;
        transcribe_model(model, from_, *this);
        model.vehicle.rows = in_rows<S>(model.vehicle.spokes, model.vehicle.places);
        pair_up(model.vehicle);
        model.surface = from_.surface;
        model.chart = from_.chart;
        model.constraints = from_.constraints;
        model.energy_balance = from_.energy_balance;
        return model;
    }

    // Neighboring composed spokes whose counts and choices are the same.
    void pair_up(Vehicle<T>& vehicle) const {
        const std::vector<ComposedSpoke<double>>& spokes = from_.vehicle.composed;
        for (std::size_t i = 0; i + 1 < spokes.size(); ++i) {
            if (shape_of(spokes[i]) != shape_of(spokes[i + 1])) continue;
            ComposedPair<S>& pair = vehicle.pairs.emplace_back();
            gather(pair.spokes, std::array<const ComposedSpoke<T>*, 2>{&vehicle.composed[i], &vehicle.composed[i + 1]});
            pair.first = static_cast<int>(i);
            pair.offset = {spokes[i].offset, spokes[i + 1].offset};
            pair.spokes.offset = 0;
            ++i;
        }
    }
    static std::vector<int> shape_of(ComposedSpoke<double> spoke) {
        struct Collect {
            std::vector<int> shape;
            double number(double value) { return value; }
            int whole(int value) { return shape.push_back(value), value; }
        } collect;
        spoke.offset = spoke.first_wheel = 0;  // they may differ
        ComposedSpoke<double> copy;
        transcribe(copy, spoke, collect);
        return collect.shape;
    }

    Input<T> traced_input() {
        const auto at = [&](int place) { return input(turn_input, place); };
        using I = TurnInput;
        return {.rack = {at(I::rack), at(I::rack_rate), at(I::rack_acceleration)},
                .drive_torque = at(I::drive_torque),
                .brake = at(I::brake),
                .throttle = at(I::throttle),
                .clutch = at(I::clutch),
                .gear = at(I::gear),
                .wind_x = at(I::wind_x),
                .wind_y = at(I::wind_y)};
    }

    // add_closing finds out itself where each number belongs: it is given numbers that say which they are.
    void report_closing(const Model<T>& model, const RingTurn<T>& turn) {
        State<T> before;
        for (T& number : before.values) number = T(0);
        State<T> closing = before;
        add_closing(model, turn, closing);
        for (int i = 0; i < size(); ++i) {
            const T& number = closing.values[static_cast<std::size_t>(i)];
            if (number.id() == before.values[static_cast<std::size_t>(i)].id()) continue;
            output(turn_report, TurnReport::closing + static_cast<int>(to_.closing_places.size()), number);
            to_.closing_places.push_back(i);
        }
    }

    const Model<double>& from_;
    const CommonCar& common_;
    TurnTrace& to_;
    Tracing tracing_;
    std::size_t seen_ = 0, shape_seen_ = 0;
};

}  // namespace hamilcar
