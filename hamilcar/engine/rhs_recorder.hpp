// Records the right-hand side.
#pragma once

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/rhs_trace.hpp"
#include "hamilcar/engine/traced_sample.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

class RhsRecorder {
public:
    using T = Traced<>;
    using S = Paired<T>;

    RhsRecorder(const Model<double>& model, const CommonCar& common, RhsTrace& to)
        : from_(model), common_(common), to_(to), tracing_(to.graph) {}

    // For transcribe_model: a constant, or a parameter of the program.
    T number(double value) {
        const auto index = seen_++;
        if (common_.differs.empty() || !common_.differs[index]) return T(value);
        to_.parameters.push_back(static_cast<int>(index));
        return input(rhs_parameters, static_cast<int>(to_.parameters.size()) - 1);
    }
    int whole(int own) { return common_.shape.empty() ? own : common_.shape[shape_seen_++]; }

    void record() {
        const Model<T> model = traced_model(Pairs::yes);
        State<T> state, rate;
        for (int i = 0; i < size(); ++i) state.values[static_cast<std::size_t>(i)] = input(rhs_state, i);
        const Input<T> driver = traced_input();
        Evaluation<T> evaluation;

        to_.graph.set_block(program::Block::velocity);
        const Velocity<T, S> velocity = velocity_block_of<S>(model, state, driver);
        to_.graph.set_block(program::Block::momenta);
        const Momenta<T> momenta = momenta_block_of(model, state, driver, velocity);
        to_.graph.set_block(program::Block::integration);
        rate_of_state(model, state, velocity, momenta, rate);
        if (!model.energy_balance) rate.work() = T(0);
        report_evaluation(model, velocity, evaluation);

        for (int i = 0; i < size(); ++i) output(rhs_rate, i, rate.values[static_cast<std::size_t>(i)]);
        output(rhs_report, RhsReport::violation, evaluation.health.violation);
        output(rhs_report, RhsReport::mobility, evaluation.health.mobility);
        if (model.constraints == ConstraintMode::exact) report_correction(model, evaluation);
        if (model.vehicle.is_measured) report_measurement(model.vehicle, state, velocity, momenta);
    }

    // What `readers` find, in the array of the rates; suspensions one by one, whose results readers know.
    void record(const TracedReaders& readers) {
        const Model<T> model = traced_model(Pairs::no);
        State<T> state;
        for (int i = 0; i < size(); ++i) state.values[static_cast<std::size_t>(i)] = input(rhs_state, i);
        TracedSample sample{model, state, traced_input(), {}, {}};
        sample.velocity = velocity_block_of<S>(model, state, sample.input);
        sample.momenta = momenta_block_of(model, state, sample.input, sample.velocity);
        for (std::size_t i = 0; i < readers.size(); ++i) output(rhs_rate, static_cast<int>(i), readers[i](sample));
    }

private:
    enum class Pairs { no, yes };
    int size() const { return from_.vehicle.state_size; }
    T input(int array, int index) { return T::of(to_.graph.input(array, index)); }
    void output(int array, int index, const T& number) { to_.graph.output(array, index, number.id()); }

    Model<T> traced_model(Pairs pairs) {
        Model<T> model;
        transcribe_model(model, from_, *this);
        if (pairs == Pairs::yes) pair_up(model.vehicle);
        model.surface = from_.surface;
        model.chart = from_.chart;
        model.constraints = from_.constraints;
        model.energy_balance = from_.energy_balance;
        return model;
    }

    // Pairs neighboring suspensions of the same structure; of the others, the two wheels of an axle.
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
    // Without what may differ between the two of a pair.
    static Suspension<double> alike(Suspension<double> suspension) {
        suspension.offset = suspension.first_wheel = 0;
        for (auto& damper : suspension.dampers) damper.actuator = std::min(damper.actuator, 0);
        return suspension;
    }
    static SuspensionWheel<double> alike(SuspensionWheel<double> wheel) {
        wheel.frame = wheel.reaction = wheel.offset = wheel.bar_arm = 0;
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
        const auto at = [&](int index) { return input(rhs_input, index); };
        using I = RhsInput;
        return {.rack = {at(I::rack), at(I::rack_rate), at(I::rack_acceleration)},
                .drive_torque = at(I::drive_torque),
                .brake = at(I::brake),
                .throttle = at(I::throttle),
                .clutch = at(I::clutch),
                .gear = at(I::gear),
                .wind_x = at(I::wind_x),
                .wind_y = at(I::wind_y),
                .hands_hold = at(I::hands_hold),
                .hands_torque = at(I::hands_torque),
                .parking_brake = at(I::parking_brake),
                .commands = traced_commands()};
    }
    const T* traced_commands() {
        for (int i = 0; i < from_.vehicle.commands; ++i) commands_.push_back(input(rhs_input, RhsInput::size + i));
        return commands_.empty() ? nullptr : commands_.data();
    }

    void report_measurement(const Vehicle<T>& vehicle, const State<T>& state, const Velocity<T, S>& velocity,
                            const Momenta<T>& momenta) {
        std::array<T, max_measurements> measured;
        measure(vehicle, state, velocity, momenta, measured.data());
        to_.measured = MeasurementPlaces(vehicle).size;
        const int first = RhsReport::correction + static_cast<int>(to_.correction_indices.size());
        for (int i = 0; i < to_.measured; ++i) output(rhs_report, first + i, measured[static_cast<std::size_t>(i)]);
    }

    // Applies add_correction to traced numbers to find out where each correction belongs.
    void report_correction(const Model<T>& model, const Evaluation<T>& evaluation) {
        State<T> before;
        for (T& number : before.values) number = T(0);
        State<T> correction = before;
        add_correction(model, evaluation, correction);
        for (int i = 0; i < size(); ++i) {
            const T& number = correction.values[static_cast<std::size_t>(i)];
            if (number.id() == before.values[static_cast<std::size_t>(i)].id()) continue;
            output(rhs_report, RhsReport::correction + static_cast<int>(to_.correction_indices.size()), number);
            to_.correction_indices.push_back(i);
        }
    }

    const Model<double>& from_;
    const CommonCar& common_;
    RhsTrace& to_;
    Tracing tracing_;
    std::size_t seen_ = 0, shape_seen_ = 0;
    std::vector<T> commands_;
};

}  // namespace hamilcar
