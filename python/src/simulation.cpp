// One car, stepped from Python, and whole runs of scenarios.
#include "hamilcar/run/simulation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "commands.hpp"
#include "controls.hpp"
#include "documents.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/run/replay_rows.hpp"
#include "hamilcar/run/scene.hpp"
#include "place.hpp"

namespace hamilcar::python {

namespace {

constexpr long steps_between_signals = 500;  // Ctrl-C is asked for in between

class Car {
    // How controls reach a Simulation's schedule and driver.
    auto access() {
        return [this](auto&& change) { simulation_.change_inputs(change); };
    }

public:
    Car(const VehicleDocument& vehicle, const ScenarioDocument& scenario)
        : simulation_(vehicle.description, scenario.description),
          schedule_(simulation_.schedule()),
          controls_(simulation_.vehicle(), simulation_.scenario(), schedule_),
          commands_(simulation_.vehicle()),
          channels_(all_channels(simulation_.vehicle())) {
        simulation_.prepare();
        simulation_.save(start_);
    }

    // Steps on with the controls moving to their targets, a NaN for one that is left alone. What ended it, or nothing.
    void step(long steps, const Numbers& targets) {
        const Turn turn(busy_);
        expect_count(targets, controls_.list().size());
        expect_targets(controls_, targets.data());
        if (steps < 1) throw nb::value_error("expected at least one step");
        Interruption interruption;
        std::optional<End> end;
        {
            const nb::gil_scoped_release release;
            move_controls(controls_, targets.data(), {simulation_.time(), steps, step_size()}, access());
            for (long i = 0; i < steps && !end && !simulation_.ending(); ++i) {
                end = simulation_.advance();
                if (i % steps_between_signals == steps_between_signals - 1 && interruption.asked()) break;
            }
            if (end || interruption.asked()) {
                stop_controls(controls_, targets.data(), simulation_.time(), access());
            } else {
                hold_controls(controls_, targets.data(), simulation_.time(), access());
            }
        }
        interruption.raise_if_interrupted();
        if (end) throw io::Error(io::ExitCode::numerical, end->message);
    }

    std::vector<double> values(const std::vector<std::size_t>& which) const {
        const Turn turn(busy_);
        const Sample sample = simulation_.sample();
        std::vector<double> out;
        for (const std::size_t i : which) out.push_back(channels_.at(i).read(sample));
        return out;
    }
    std::vector<double> control_values() const {
        const Turn turn(busy_);
        std::vector<double> out;
        for (std::size_t i = 0; i < controls_.list().size(); ++i) {
            out.push_back(controls_.value(i, simulation_.time(), simulation_.schedule()));
        }
        return out;
    }

    NewNumbers command_values() const {
        const Turn turn(busy_);
        const auto now = simulation_.schedule().commands();
        return new_numbers({now.begin(), now.end()}, {now.size()});
    }
    // From the next step on.
    void set_commands(const Numbers& told) {
        const Turn turn(busy_);
        expect_commands(commands_, told, 1);
        simulation_.change_inputs([&](Schedule& schedule, Driver*) { tell_commands(told.data(), schedule); });
    }
    std::vector<std::string> controllers() const {
        std::vector<std::string> out;
        for (std::size_t i = 0; i < controller_count(); ++i) out.push_back(simulation_.control()->keyword(i));
        return out;
    }
    bool controller_is_on(std::size_t controller) const {
        const Turn turn(busy_);
        check(controller);
        return simulation_.control()->is_on(controller, simulation_.control_memory());
    }
    void switch_controller(std::size_t controller, bool on) {
        const Turn turn(busy_);
        check(controller);
        simulation_.switch_controller(controller, on);
    }

    NewNumbers state() const {
        const Turn turn(busy_);
        const auto size = static_cast<std::size_t>(simulation_.model().vehicle.state_size);
        return new_numbers(
            {simulation_.state().values.begin(), simulation_.state().values.begin() + static_cast<long>(size)}, {size});
    }

    std::unique_ptr<Place> save() const {
        const Turn turn(busy_);
        auto out = std::make_unique<Place>(simulation_);
        simulation_.save(out->snapshot);
        return out;
    }
    // The scenario's tables are again in force where the snapshot has no other inputs.
    void restore(const Place& from) {
        const Turn turn(busy_);
        from.expect_of(simulation_);
        go_back(from.snapshot);
    }
    void reset() {
        const Turn turn(busy_);
        go_back(start_);
    }

    double time() const {
        const Turn turn(busy_);
        return simulation_.time();
    }
    long steps_taken() const {
        const Turn turn(busy_);
        return simulation_.steps_taken();
    }
    std::optional<std::string> ending() const {
        const Turn turn(busy_);
        return simulation_.ending();
    }
    std::vector<std::string> warnings() const {
        const Turn turn(busy_);
        return simulation_.warnings();
    }

    const Simulation& simulation() const { return simulation_; }
    const std::vector<Channel>& channels() const { return channels_; }
    const DirectControls& controls() const { return controls_; }
    const CommandLayout& commands() const { return commands_; }
    double step_size() const { return simulation_.scenario().solver.step; }

private:
    std::size_t controller_count() const {
        return simulation_.control() ? simulation_.control()->controller_count() : 0;
    }
    void check(std::size_t controller) const {
        if (controller < controller_count()) return;
        throw nb::index_error(fmt::format("controller {}: the car has {}", controller, controller_count()).c_str());
    }
    void go_back(const Snapshot& to) {
        simulation_.set_schedule(schedule_);
        simulation_.restore(to);
    }

    Simulation simulation_;
    Schedule schedule_;  // as at the start
    DirectControls controls_;
    CommandLayout commands_;
    std::vector<Channel> channels_;
    Snapshot start_;
    mutable std::atomic<bool> busy_{false};
};

// The whole scenario, with the channels that it or the caller asks for and what a picture needs.
std::tuple<io::PageRun, RunSummary, std::vector<std::string>> run(const VehicleDocument& vehicle,
                                                                  const ScenarioDocument& scenario,
                                                                  const std::vector<std::string>& channels,
                                                                  double interval, bool motion) {
    if (!(interval >= 0)) throw nb::value_error("interval: expected a time not below zero [s]");
    Interruption interruption;
    std::tuple<io::PageRun, RunSummary, std::vector<std::string>> out;
    // Copies: another thread may change the documents meanwhile.
    VehicleDescription driven = vehicle.description;
    ScenarioDescription drive = scenario.description;
    {
        const nb::gil_scoped_release release;
        Simulation simulation(std::move(driven), std::move(drive));
        const std::vector<Channel> all = all_channels(simulation.vehicle());
        std::vector<Channel> chosen = select_channels(all, channels);
        if (motion) add_missing_motion(all, chosen);
        io::PageRun rows{
            .name = simulation.scenario().name, .file = "", .columns = {}, .values = {}, .scene = "", .tiles = {}};
        rows.columns.push_back({"time", "s", "time since the start of the run"});
        for (const Channel& channel : chosen) rows.columns.push_back(channel.column);
        rows.values.resize(rows.columns.size());
        if (motion) rows.scene = scene_json(simulation.vehicle(), simulation.scenario());
        std::vector<double> x, y;
        RunSummary summary = record(
            simulation, chosen, interval,
            [&](const Sample& sample, const std::vector<double>& row) {
                rows.values[0].push_back(sample.time);
                for (std::size_t i = 0; i < row.size(); ++i) rows.values[i + 1].push_back(row[i]);
                x.push_back(sample.state.position()[0]), y.push_back(sample.state.position()[1]);
            },
            [&](double, const RunSummary&) { return !interruption.asked(); });
        const bool uneven = motion && simulation.scenario().road.is_uneven();
        rows.tiles = tiles_along(simulation.model().road, uneven ? simulation.surface().get() : nullptr, x, y);
        std::vector<std::string> warnings = simulation.warnings();
        for (const ValidityWarning& warning : summary.validity) warnings.push_back(sentence(warning));
        if (const auto ending = simulation.ending()) warnings.push_back(*ending);
        out = {std::move(rows), std::move(summary), std::move(warnings)};
    }
    interruption.raise_if_interrupted();
    return out;
}

}  // namespace

void add_simulation(nb::module_& module) {
    nb::class_<Place>(module, "Snapshot", "A place in a run to come back to.")
        .def_prop_ro("steps", [](const Place& place) { return place.snapshot.step_count; })
        .def_prop_ro("time",
                     [](const Place& place) { return static_cast<double>(place.snapshot.step_count) * place.step; });
    nb::class_<Car>(module, "Car")
        .def(nb::init<const VehicleDocument&, const ScenarioDocument&>(), "vehicle"_a, "scenario"_a)
        .def("step", &Car::step, "steps"_a, "targets"_a.noconvert())
        .def(
            "values",
            [](const Car& car, const std::vector<std::size_t>& which) {
                std::vector<double> values = car.values(which);
                return new_numbers(std::move(values), {which.size()});
            },
            "channels"_a)
        .def("control_values", &Car::control_values)
        .def("command_values", &Car::command_values)
        .def("set_commands", &Car::set_commands, "told"_a.noconvert())
        .def("controller_is_on", &Car::controller_is_on, "controller"_a)
        .def("switch_controller", &Car::switch_controller, "controller"_a, "on"_a)
        .def("state", &Car::state)
        .def("state_names",
             [](const Car& car) {
                 const StateLayout layout(car.simulation().vehicle());
                 std::vector<std::string> out;
                 for (const StateNumber& number : layout.numbers()) out.push_back(number.name);
                 return out;
             })
        .def("save", &Car::save)
        .def("restore", &Car::restore, "snapshot"_a)
        .def("reset", &Car::reset)
        .def("scene",
             [](const Car& car) { return scene_json(car.simulation().vehicle(), car.simulation().scenario()); })
        .def_prop_ro("channels", [](const Car& car) { return described(car.channels()); })
        .def_prop_ro("controls", [](const Car& car) { return described(car.controls()); })
        .def_prop_ro("commands", [](const Car& car) { return described(car.commands()); })
        .def_prop_ro("controllers", &Car::controllers)
        .def_prop_ro("time", &Car::time)
        .def_prop_ro("steps_taken", &Car::steps_taken)
        .def_prop_ro("step_size", &Car::step_size)
        .def_prop_ro("ending", &Car::ending)
        .def_prop_ro("warnings", &Car::warnings);
    nb::class_<RunSummary>(module, "RunSummary")
        .def_ro("duration", &RunSummary::duration)
        .def_ro("steps", &RunSummary::steps)
        .def_ro("wall_time", &RunSummary::wall_time)
        .def_ro("ended_early", &RunSummary::ended_early)
        .def_ro("max_violation", &RunSummary::max_violation)
        .def_ro("max_balance_error", &RunSummary::max_balance_error)
        .def_prop_ro("energy_exchanged", &RunSummary::energy_exchanged)
        .def_prop_ro("real_time_factor", &RunSummary::real_time_factor);
    module.def("run", &run, "vehicle"_a, "scenario"_a, "channels"_a, "interval"_a, "motion"_a);
}

}  // namespace hamilcar::python
