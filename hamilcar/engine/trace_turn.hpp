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
    using S = Paired<T>;

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
        const Momenta<T> momenta = momenta_block_of(model, state, driver, velocity);
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
        pair_up(model.vehicle);
        model.surface = from_.surface;
        model.chart = from_.chart;
        model.constraints = from_.constraints;
        model.energy_balance = from_.energy_balance;
        return model;
    }

    // Neighboring suspensions whose counts and choices are the same; of the others the two wheels of an axle.
    void pair_up(Vehicle<T>& vehicle) const {
        const std::vector<Suspension<double>>& suspensions = from_.vehicle.suspensions;
        for (std::size_t i = 0; i < suspensions.size(); ++i) {
            const bool has_twin =
                i + 1 < suspensions.size() && shape_of(alike(suspensions[i])) == shape_of(alike(suspensions[i + 1]));
            if (!has_twin) {
                pair_wheels(suspensions[i], vehicle.suspensions[i]);
                continue;
            }
            SuspensionPair<S>& pair = vehicle.pairs.emplace_back();
            gather(pair.both,
                   std::array<const Suspension<T>*, 2>{&vehicle.suspensions[i], &vehicle.suspensions[i + 1]});
            pair.first = static_cast<int>(i);
            pair.offset = {suspensions[i].offset, suspensions[i + 1].offset};
            pair.both.offset = 0;
            ++i;
        }
    }
    static void pair_wheels(const Suspension<double>& from, Suspension<T>& to) {
        if (from.wheels.size() != 2 || shape_of(alike(from.wheels[0])) != shape_of(alike(from.wheels[1]))) return;
        gather(to.both_wheels.emplace_back(), std::array<const SuspensionWheel<T>*, 2>{&to.wheels[0], &to.wheels[1]});
    }
    // Without what may differ.
    static Suspension<double> alike(Suspension<double> suspension) {
        suspension.offset = suspension.first_wheel = 0;
        return suspension;
    }
    static SuspensionWheel<double> alike(SuspensionWheel<double> wheel) {
        wheel.frame = wheel.reaction = wheel.offset = 0;
        return wheel;
    }
    template <class Part>
    static std::vector<int> shape_of(const Part& part) {
        struct Collect {
            std::vector<int> shape;
            double number(double value) { return value; }
            int whole(int value) { return shape.push_back(value), value; }
        } collect;
        Part copy;
        transcribe(copy, part, collect);
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
