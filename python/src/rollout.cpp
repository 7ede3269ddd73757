// Rollouts with their derivatives, as arrays.
#include "hamilcar/batch/rollout.hpp"

#include <fmt/format.h>

#include <thread>

#include "controls.hpp"
#include "hamilcar/vehicle/state_layout.hpp"
#include "start.hpp"

namespace hamilcar::python {

namespace {

class Runner {
public:
    // `channels`: places in the start's list of channels.
    Runner(std::shared_ptr<const Start> start, const Starts& variants, const std::vector<std::size_t>& channels,
           long steps, int threads)
        : start_(std::move(start)) {
        expect_start(start_), expect_starts(variants);
        if (steps < 1) throw nb::value_error("expected at least one step");
        if (threads < 0) throw nb::value_error("threads: expected a number not below zero");
        TracedReaders readers;
        for (const std::size_t i : channels) {
            const Channel& channel = start_->channels.at(i);
            if (!channel.trace) {
                throw nb::value_error(
                    fmt::format("{} cannot be recorded in a rollout: it is not compiled", channel.column.name).c_str());
            }
            readers.push_back(channel.trace);
        }
        RolloutOptions options{.steps = steps, .threads = threads};
        for (const auto& variant : variants) options.variants.push_back(&variant->simulation);
        rollout_.emplace(RolloutCar{&start_->simulation, &start_->controls}, readers, options);
    }

    // Channels after each row and the state at the end.
    nb::tuple run(const Starts& starts, const Numbers& controls, const Numbers& states) {
        const Turn turn(busy_);
        const Runs runs = checked(starts, controls, states);
        RolloutResults out;
        unlocked([&] { out = rollout_->run(runs.cars, runs.numbers, runs.rows); });
        return nb::make_tuple(by_row(std::move(out.channels), runs), by_state(std::move(out.states), runs));
    }

    // The same, and how both change along a direction for each run.
    nb::tuple tangents(const Starts& starts, const Numbers& controls, const Numbers& states,
                       const Numbers& along_controls, const Numbers& along_states, const Numbers& along_parameters) {
        const Turn turn(busy_);
        const Runs runs = checked(starts, controls, states);
        const RolloutNumbers along{
            .controls = numbers(along_controls, runs.numbers.controls.size(), "directions of the controls"),
            .states = numbers(along_states, runs.numbers.states.size(), "directions of the states"),
            .parameters =
                numbers(along_parameters, starts.size() * rollout_->parameter_count(), "directions of the parameters")};
        RolloutResults out, changes;
        unlocked([&] { out = rollout_->tangents(runs.cars, runs.numbers, along, runs.rows, changes); });
        return nb::make_tuple(by_row(std::move(out.channels), runs), by_state(std::move(out.states), runs),
                              by_row(std::move(changes.channels), runs), by_state(std::move(changes.states), runs));
    }

    // Of each run's weighted sum: by its controls, its starting state, and the numbers of its model.
    nb::tuple gradient(const Starts& starts, const Numbers& controls, const Numbers& states,
                       const Numbers& channel_weights, const Numbers& state_weights) {
        const Turn turn(busy_);
        const Runs runs = checked(starts, controls, states);
        const RolloutResults weights{
            .channels = numbers(channel_weights, starts.size() * runs.rows * rollout_->channel_count(),
                                "weights of the channels"),
            .states = numbers(state_weights, runs.numbers.states.size(), "weights of the states")};
        RolloutNumbers out;
        unlocked([&] { out = rollout_->gradient(runs.cars, runs.numbers, weights, runs.rows); });
        return nb::make_tuple(
            new_numbers(std::move(out.controls), {starts.size(), runs.rows + 1, start_->controls.list().size()}),
            by_state(std::move(out.states), runs),
            new_numbers(std::move(out.parameters), {starts.size(), rollout_->parameter_count()}));
    }

    NewNumbers parameters_of(const std::shared_ptr<const Start>& start) const {
        std::vector<double> out = rollout_->parameters_of(checked(start).simulation);
        const std::size_t count = out.size();
        return new_numbers(std::move(out), {count});
    }
    NewNumbers state_of(const std::shared_ptr<const Start>& start) const {
        const State<double>& state = checked(start).simulation.state();
        const std::size_t count = rollout_->state_size();
        return new_numbers({state.values.begin(), state.values.begin() + static_cast<long>(count)}, {count});
    }
    // Where its controls are at the start.
    std::vector<double> held(const std::shared_ptr<const Start>& start) const {
        const Start& car = checked(start);
        std::vector<double> out;
        for (std::size_t i = 0; i < car.controls.list().size(); ++i) {
            out.push_back(car.controls.value(i, 0, car.simulation.schedule()));
        }
        return out;
    }
    // Rows of controls of a start in the schedule's units, and the derivatives of these by those.
    nb::tuple scheduled(const std::shared_ptr<const Start>& start, const Numbers& controls) const {
        const DirectControls& own = checked(start).controls;
        if (own.list().empty() || controls.ndim() != 2 || controls.shape(1) != own.list().size()) {
            throw nb::value_error("expected rows of controls");
        }
        std::vector<double> values, slopes;
        for (std::size_t i = 0; i < controls.size(); ++i) {
            values.push_back(own.scheduled(i % own.list().size(), controls.data()[i]));
            slopes.push_back(own.slope(i % own.list().size(), controls.data()[i]));
        }
        const std::vector<std::size_t> shape{controls.shape(0), controls.shape(1)};
        return nb::make_tuple(new_numbers(std::move(values), shape), new_numbers(std::move(slopes), shape));
    }
    // Name, unit, and whether it is free: neither dependent on others nor an account of energy.
    nb::list state_numbers() const {
        nb::list out;
        const StateLayout layout(start_->simulation.vehicle());
        for (const StateNumber& number : layout.numbers()) {
            const bool follows = number.kind == StateKind::dependent || number.kind == StateKind::work ||
                                 number.kind == StateKind::energy_supplied;
            out.append(
                nb::make_tuple(number.name, state_kinds()[static_cast<std::size_t>(number.kind)].unit, !follows));
        }
        return out;
    }
    NewNumbers closed(const Starts& starts, const Numbers& controls, const Numbers& states,
                      const Numbers& along_controls, const Numbers& along_states) {
        const Turn turn(busy_);
        const Runs runs = checked(starts, controls, states);
        if (runs.rows != 1) throw nb::value_error("expected one row");
        const RolloutNumbers along{
            .controls = numbers(along_controls, runs.numbers.controls.size(), "directions of the controls"),
            .states = numbers(along_states, runs.numbers.states.size(), "directions of the states"),
            .parameters = std::vector<double>(starts.size() * rollout_->parameter_count())};
        std::vector<double> out;
        unlocked([&] { out = rollout_->closed(runs.cars, runs.numbers, along); });
        return by_state(std::move(out), runs);
    }
    const DirectControls& controls() const { return start_->controls; }
    const std::vector<Channel>& channels() const { return start_->channels; }

private:
    // Runs work() without the interpreter's lock, on the pool's threads; Ctrl-C is for the one that called.
    template <class Work>
    void unlocked(const Work& work) {
        Interruption interruption;
        std::atomic<bool> stops{false};
        const auto caller = std::this_thread::get_id();
        rollout_->set_stop([&] {
            if (!stops && std::this_thread::get_id() == caller && interruption.asked()) stops = true;
            return stops.load();
        });
        {
            const nb::gil_scoped_release release;
            work();
        }
        rollout_->set_stop({});
        interruption.raise_if_interrupted();
    }
    struct Runs {
        std::vector<RolloutCar> cars;
        RolloutNumbers numbers;
        std::size_t rows;
    };

    static std::vector<double> numbers(const Numbers& from, std::size_t count, const char* what) {
        if (from.size() != count) {
            throw nb::value_error(fmt::format("{}: expected {} numbers, found {}", what, count, from.size()).c_str());
        }
        return {from.data(), from.data() + count};
    }
    const Start& checked(const std::shared_ptr<const Start>& start) const {
        expect_start(start);
        const std::string obstacle = rollout_->obstacle({&start->simulation, &start->controls});
        if (!obstacle.empty()) throw nb::value_error(obstacle.c_str());
        return *start;
    }
    Runs checked(const Starts& starts, const Numbers& controls, const Numbers& states) const {
        if (starts.empty()) throw nb::value_error("expected at least one run");
        expect_starts(starts);
        const std::size_t count = start_->controls.list().size();
        if (controls.ndim() != 3 || controls.shape(0) != starts.size() || controls.shape(1) < 2 ||
            controls.shape(2) != count) {
            throw nb::value_error(
                fmt::format("controls: expected {} runs of at least 2 rows of {} numbers", starts.size(), count)
                    .c_str());
        }
        Runs out{.cars = {}, .numbers = {}, .rows = controls.shape(1) - 1};
        const Start* known = nullptr;  // many runs are of one start
        for (const auto& start : starts) {
            if (start.get() != known) known = &checked(start);
            out.cars.push_back({&known->simulation, &known->controls});
        }
        for (std::size_t i = 0; i < starts.size() * (out.rows + 1); ++i) {
            const double* row = controls.data() + i * count;
            expect_targets(starts[i / (out.rows + 1)]->controls, row);
            for (std::size_t k = 0; k < count; ++k) {
                if (std::isnan(row[k])) throw nb::value_error("controls: expected numbers, found a NaN");
            }
        }
        out.numbers.controls = numbers(controls, controls.size(), "controls");
        out.numbers.states = numbers(states, starts.size() * rollout_->state_size(), "states");
        return out;
    }
    NewNumbers by_row(std::vector<double> values, const Runs& runs) const {
        return new_numbers(std::move(values), {runs.cars.size(), runs.rows, rollout_->channel_count()});
    }
    NewNumbers by_state(std::vector<double> values, const Runs& runs) const {
        return new_numbers(std::move(values), {runs.cars.size(), rollout_->state_size()});
    }

    std::shared_ptr<const Start> start_;
    std::optional<Rollout> rollout_;
    mutable std::atomic<bool> busy_{false};
};

}  // namespace

void add_rollout(nb::module_& module) {
    nb::class_<Runner>(module, "Runner")
        .def(nb::init<std::shared_ptr<const Start>, const Starts&, const std::vector<std::size_t>&, long, int>(),
             "start"_a, "variants"_a, "channels"_a, "steps"_a, "threads"_a)
        .def("run", &Runner::run, "starts"_a, "controls"_a.noconvert(), "states"_a.noconvert())
        .def("tangents", &Runner::tangents, "starts"_a, "controls"_a.noconvert(), "states"_a.noconvert(),
             "along_controls"_a.noconvert(), "along_states"_a.noconvert(), "along_parameters"_a.noconvert())
        .def("gradient", &Runner::gradient, "starts"_a, "controls"_a.noconvert(), "states"_a.noconvert(),
             "channel_weights"_a.noconvert(), "state_weights"_a.noconvert())
        .def("parameters_of", &Runner::parameters_of, "start"_a)
        .def("state_of", &Runner::state_of, "start"_a)
        .def("scheduled", &Runner::scheduled, "start"_a, "controls"_a.noconvert())
        .def("held", &Runner::held, "start"_a)
        .def("state_numbers", &Runner::state_numbers)
        .def("closed", &Runner::closed, "starts"_a, "controls"_a.noconvert(), "states"_a.noconvert(),
             "along_controls"_a.noconvert(), "along_states"_a.noconvert())
        .def_prop_ro("controls", [](const Runner& runner) { return described(runner.controls()); });
}

}  // namespace hamilcar::python
