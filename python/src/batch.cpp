// Many cars, stepped together from Python.
#include "hamilcar/batch/batch.hpp"

#include <algorithm>
#include <map>

#include "commands.hpp"
#include "controls.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/run/channels.hpp"
#include "place.hpp"
#include "start.hpp"

namespace hamilcar::python {

namespace {

using Cars = std::vector<std::size_t>;

const char* word(EndReason reason) {
    switch (reason) {
        case EndReason::none: return "";
        case EndReason::not_finite: return "its numbers are no longer finite";
        case EndReason::loops_open: return "a linkage's cut joints stand open";
        case EndReason::locked: return "a linkage locks";
        case EndReason::rolled_over: return "it leans beyond the tilt limit";
        case EndReason::driver_ended: return "the scenario's ending came true";
    }
    return "";
}

constexpr long steps_between_signals = 100;  // Ctrl-C is asked for in between

class Fleet {
public:
    // One for each car; `variants`: others that cars may become.
    Fleet(Starts starts, const Starts& variants, int threads, bool single_precision, double tilt_limit)
        : cars_(std::move(starts)) {
        if (cars_.empty()) throw nb::value_error("expected at least one car");
        expect_starts(cars_), expect_starts(variants);
        BatchOptions options{.threads = threads,
                             .precision = single_precision ? Precision::single_precision : Precision::double_precision,
                             .tilt_limit = tilt_limit};
        for (const auto& variant : variants) options.variants.push_back(&variant->simulation);
        std::vector<const Simulation*> all;
        for (const auto& car : cars_) all.push_back(&car->simulation);
        batch_.emplace(all, options);
    }

    std::size_t size() const { return cars_.size(); }
    const DirectControls& controls() const { return cars_[0]->controls; }
    const CommandLayout& commands() const { return cars_[0]->commands; }
    const std::vector<Channel>& channels() const { return cars_[0]->channels; }
    double step_size() const { return cars_[0]->simulation.scenario().solver.step; }

    void step(long steps, const Numbers& targets) {
        const Turn turn(busy_);
        expect_rows(targets, 1);
        expect_steps(steps);
        Interruption interruption;
        {
            const nb::gil_scoped_release release;
            step_with(steps, targets.data(), interruption);
        }
        interruption.raise_if_interrupted();
    }

    // Rows of targets for all cars, one after the other; the channels after each.
    NewNumbers rollout(long steps, const Numbers& targets, std::size_t rows, const std::vector<std::size_t>& which) {
        const Turn turn(busy_);
        expect_rows(targets, rows);
        expect_steps(steps);
        const std::size_t row = size() * controls().list().size();
        Interruption interruption;
        std::vector<double> out(rows * size() * which.size());
        {
            const nb::gil_scoped_release release;
            for (std::size_t i = 0; i < rows && !interruption.asked(); ++i) {
                step_with(steps, targets.data() + i * row, interruption);
                read(which, out.data() + i * size() * which.size());
            }
        }
        interruption.raise_if_interrupted();
        return new_numbers(std::move(out), {rows, size(), which.size()});
    }

    NewNumbers values(const std::vector<std::size_t>& which) {
        const Turn turn(busy_);
        std::vector<double> out(size() * which.size());
        {
            const nb::gil_scoped_release release;
            read(which, out.data());
        }
        return new_numbers(std::move(out), {size(), which.size()});
    }

    NewNumbers command_values() const {
        const Turn turn(busy_);
        const auto count = static_cast<std::size_t>(commands().size());
        std::vector<double> out;
        for (std::size_t car = 0; car < size(); ++car) {
            const auto now = batch_->schedule(car).commands();
            out.insert(out.end(), now.begin(), now.end());
        }
        return new_numbers(std::move(out), {size(), count});
    }
    // A row for each of these cars, from the next step on.
    void set_commands(const Cars& cars, const Numbers& told) {
        const Turn turn(busy_);
        expect_commands(commands(), told, cars.size());
        for (const std::size_t car : cars) check(car);
        const auto count = static_cast<std::size_t>(commands().size());
        for (std::size_t i = 0; i < cars.size(); ++i) {
            batch_->change_inputs(
                cars[i], [&](Schedule& schedule, Driver*) { tell_commands(told.data() + i * count, schedule); });
        }
    }

    NewNumbers states() const {
        const Turn turn(busy_);
        const auto count = static_cast<std::size_t>(cars_[0]->simulation.model().vehicle.state_size);
        std::vector<double> out;
        for (std::size_t i = 0; i < size(); ++i) {
            const State<double> state = batch_->state(i);
            out.insert(out.end(), state.values.begin(), state.values.begin() + static_cast<long>(count));
        }
        return new_numbers(std::move(out), {size(), count});
    }

    void restart(const Cars& cars) {
        const Turn turn(busy_);
        for (const std::size_t car : cars) batch_->restart(check(car));
    }
    // All of them or, where one does not fit, none.
    void replace(const Cars& cars, const Starts& starts) {
        const Turn turn(busy_);
        if (cars.size() != starts.size()) throw nb::value_error("expected a start for each car");
        expect_starts(starts);
        for (std::size_t i = 0; i < cars.size(); ++i) {
            std::string obstacle = batch_->obstacle_to_replace(check(cars[i]), starts[i]->simulation);
            if (!starts[i]->controls.has_same_list(controls())) obstacle = "they differ in their controls";
            if (!obstacle.empty()) {
                throw nb::value_error(
                    fmt::format("car {} cannot begin like this in this batch: {}", cars[i], obstacle).c_str());
            }
        }
        for (std::size_t i = 0; i < cars.size(); ++i) {
            batch_->replace(cars[i], starts[i]->simulation);
            cars_[cars[i]] = starts[i];
        }
    }
    std::vector<std::unique_ptr<Place>> save(const Cars& cars) const {
        const Turn turn(busy_);
        std::vector<std::unique_ptr<Place>> out;
        for (const std::size_t car : cars) {
            if (batch_->end(check(car)).reason != EndReason::none)
                throw nb::value_error(fmt::format("car {} has ended: there is nothing to come back to", car).c_str());
            out.push_back(std::make_unique<Place>(cars_[car]->simulation));
            batch_->save(car, out.back()->snapshot);
        }
        return out;
    }
    void restore(const Cars& cars, const std::vector<const Place*>& from) {
        const Turn turn(busy_);
        if (cars.size() != from.size()) throw nb::value_error("expected a snapshot for each car");
        for (std::size_t i = 0; i < cars.size(); ++i) {
            expect_object(from[i], "a snapshot").expect_of(cars_[check(cars[i])]->simulation);
        }
        for (std::size_t i = 0; i < cars.size(); ++i) batch_->restore(cars[i], from[i]->snapshot);
    }

    std::vector<bool> ended() const {
        const Turn turn(busy_);
        std::vector<bool> out(size());
        for (std::size_t i = 0; i < size(); ++i) out[i] = batch_->end(i).reason != EndReason::none;
        return out;
    }
    std::string why(std::size_t car) const {
        const Turn turn(busy_);
        return word(batch_->end(check(car)).reason);
    }
    NewNumbers times() const {
        const Turn turn(busy_);
        std::vector<double> out(size());
        for (std::size_t i = 0; i < size(); ++i) out[i] = batch_->time(i);
        return new_numbers(std::move(out), {size()});
    }
    std::string engine() const { return std::string(batch_->engine()); }

private:
    std::size_t check(std::size_t car) const {
        if (car >= size()) throw nb::index_error(fmt::format("car {}: the batch has {}", car, size()).c_str());
        return car;
    }
    static void expect_steps(long steps) {
        if (steps < 1) throw nb::value_error("expected at least one step");
    }
    void expect_rows(const Numbers& targets, std::size_t rows) const {
        const std::size_t count = controls().list().size();
        expect_count(targets, rows * size() * count);
        for (std::size_t i = 0; i < rows * size(); ++i) {
            expect_targets(cars_[i % size()]->controls, targets.data() + i * count);
        }
    }

    auto access(std::size_t car) {
        return [this, car](auto&& change) { batch_->change_inputs(car, change); };
    }
    void step_with(long steps, const double* targets, Interruption& interruption) {
        const std::size_t count = controls().list().size();
        for (std::size_t car = 0; car < size(); ++car) {
            move_controls(cars_[car]->controls, targets + car * count, {batch_->time(car), steps, step_size()},
                          access(car));
        }
        for (long left = steps; left > 0 && !interruption.asked(); left -= steps_between_signals) {
            batch_->advance(std::min(left, steps_between_signals));
        }
        const bool interrupted = interruption.asked();
        for (std::size_t car = 0; car < size(); ++car) {
            if (interrupted) {
                stop_controls(cars_[car]->controls, targets + car * count, batch_->time(car), access(car));
            } else {
                hold_controls(cars_[car]->controls, targets + car * count, batch_->time(car), access(car));
            }
        }
    }

    // By a program compiled for these channels, once; those that are not compiled, and cars that have ended, one by one.
    void read(const std::vector<std::size_t>& which, double* to) {
        const Selection& chosen = selection(which);
        batch_->sample(chosen.sampler, to);
        batch_->for_each_car([&](std::size_t car) {
            const bool ended = batch_->end(car).reason != EndReason::none;
            if (!ended && chosen.all_compiled) return;
            const State<double> state = batch_->state(car);
            const Start& own = *cars_[car];
            Sample sample = sample_at(own.simulation.model(), state, batch_->schedule(car)(batch_->time(car)));
            sample.control = own.simulation.control(), sample.control_memory = batch_->control_memory(car);
            for (std::size_t k = 0; k < which.size(); ++k) {
                const Channel& channel = own.channels[which[k]];
                if (ended || !channel.trace) to[car * which.size() + k] = channel.read(sample);
            }
        });
    }

    struct Selection {
        Batch::Sampler sampler;
        bool all_compiled = true;
    };
    const Selection& selection(const std::vector<std::size_t>& which) {
        const auto known = selections_.find(which);
        if (known != selections_.end()) return known->second;
        constexpr std::size_t most_selections = 64;  // who reads others every time compiles every time
        if (selections_.size() >= most_selections) selections_.clear();
        TracedReaders readers;
        Selection made;
        for (const std::size_t i : which) {
            const Channel& channel = channels().at(i);
            if (!channel.trace) made.all_compiled = false;
            readers.push_back(channel.trace ? channel.trace : [](const TracedSample&) { return Traced<>(0.0); });
        }
        made.sampler = batch_->sampler(readers);
        return selections_.emplace(which, std::move(made)).first->second;
    }

    Starts cars_;
    std::optional<Batch> batch_;
    std::map<std::vector<std::size_t>, Selection> selections_;
    mutable std::atomic<bool> busy_{false};
};

}  // namespace

void add_batch(nb::module_& module) {
    nb::class_<Start>(module, "Start")
        .def(nb::init<const VehicleDocument&, const ScenarioDocument&>(), "vehicle"_a, "scenario"_a)
        .def_prop_ro("channels", [](const Start& start) { return described(start.channels); });
    nb::class_<Fleet>(module, "Fleet")
        .def(nb::init<Starts, const Starts&, int, bool, double>(), "starts"_a, "variants"_a, "threads"_a,
             "single_precision"_a, "tilt_limit"_a)
        .def("step", &Fleet::step, "steps"_a, "targets"_a.noconvert())
        .def("rollout", &Fleet::rollout, "steps"_a, "targets"_a.noconvert(), "rows"_a, "channels"_a)
        .def("values", &Fleet::values, "channels"_a)
        .def("command_values", &Fleet::command_values)
        .def("set_commands", &Fleet::set_commands, "cars"_a, "told"_a.noconvert())
        .def("states", &Fleet::states)
        .def("restart", &Fleet::restart, "cars"_a)
        .def("replace", &Fleet::replace, "cars"_a, "starts"_a)
        .def("save", &Fleet::save, "cars"_a)
        .def("restore", &Fleet::restore, "cars"_a, "snapshots"_a)
        .def("ended", &Fleet::ended)
        .def("why", &Fleet::why, "car"_a)
        .def("times", &Fleet::times)
        .def_prop_ro("engine", &Fleet::engine)
        .def_prop_ro("step_size", &Fleet::step_size)
        .def_prop_ro("channels", [](const Fleet& fleet) { return described(fleet.channels()); })
        .def_prop_ro("controls", [](const Fleet& fleet) { return described(fleet.controls()); })
        .def_prop_ro("commands", [](const Fleet& fleet) { return described(fleet.commands()); });
}

}  // namespace hamilcar::python
