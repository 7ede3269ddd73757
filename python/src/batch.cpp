// Many cars, stepped together from Python.
#include "hamilcar/batch/batch.hpp"

#include <deque>
#include <map>

#include "controls.hpp"
#include "documents.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/run/channels.hpp"
#include "place.hpp"

namespace hamilcar::python {

namespace {

using Cars = std::vector<std::size_t>;
using Vehicles = std::vector<const VehicleDocument*>;

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

class Fleet {
public:
    // A vehicle for each car; `variants`: others that cars may become.
    Fleet(const Vehicles& vehicles, const ScenarioDocument& scenario, const Vehicles& variants, int threads,
          bool single_precision, double tilt_limit)
        : scenario_(scenario.description) {
        if (vehicles.empty()) throw nb::value_error("expected at least one car");
        std::deque<Simulation> others;
        BatchOptions options{.threads = threads,
                             .precision = single_precision ? Precision::single_precision : Precision::double_precision,
                             .tilt_limit = tilt_limit};
        std::map<const VehicleDocument*, std::shared_ptr<Simulation>> made;  // one for all cars of one vehicle
        for (const VehicleDocument* vehicle : vehicles) {
            std::shared_ptr<Simulation>& simulation = made[vehicle];
            if (!simulation)
                simulation = std::make_shared<Simulation>(expect_object(vehicle, "a vehicle").description, scenario_);
            cars_.push_back(simulation);
        }
        for (const VehicleDocument* vehicle : variants) {
            options.variants.push_back(
                &others.emplace_back(expect_object(vehicle, "a vehicle").description, scenario_));
        }
        std::vector<const Simulation*> all;
        for (const auto& car : cars_) all.push_back(car.get());
        batch_.emplace(all, options);
        controls_ = DirectControls(cars_[0]->vehicle(), scenario_, cars_[0]->schedule());
        channels_ = all_channels(cars_[0]->vehicle());
    }

    std::size_t size() const { return cars_.size(); }
    const DirectControls& controls() const { return controls_; }
    const std::vector<Channel>& channels() const { return channels_; }
    double step_size() const { return scenario_.solver.step; }

    void step(long steps, const Numbers& targets) {
        const Turn turn(busy_);
        expect_controls(controls_, targets, size());
        if (steps < 1) throw nb::value_error("expected at least one step");
        const nb::gil_scoped_release release;
        step_with(steps, targets.data());
    }

    // Rows of targets for all cars, one after the other; the channels after each.
    NewNumbers rollout(long steps, const Numbers& targets, const std::vector<std::size_t>& which) {
        const Turn turn(busy_);
        const std::size_t row = size() * controls_.list().size();
        const std::size_t rows = row == 0 ? 0 : targets.size() / row;
        expect_controls(controls_, targets, rows * size());
        if (steps < 1) throw nb::value_error("expected at least one step");
        Interruption interruption;
        std::vector<double> out(rows * size() * which.size());
        {
            const nb::gil_scoped_release release;
            for (std::size_t i = 0; i < rows && !interruption.asked(); ++i) {
                step_with(steps, targets.data() + i * row);
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

    NewNumbers states() const {
        const Turn turn(busy_);
        const auto count = static_cast<std::size_t>(cars_[0]->model().vehicle.state_size);
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
    void replace(const Cars& cars, const Vehicles& vehicles) {
        const Turn turn(busy_);
        if (cars.size() != vehicles.size()) throw nb::value_error("expected a vehicle for each car");
        for (std::size_t i = 0; i < cars.size(); ++i) {
            auto by = std::make_shared<Simulation>(expect_object(vehicles[i], "a vehicle").description, scenario_);
            batch_->replace(check(cars[i]), *by);
            cars_[cars[i]] = std::move(by);
        }
    }
    std::vector<std::unique_ptr<Place>> save(const Cars& cars) const {
        const Turn turn(busy_);
        std::vector<std::unique_ptr<Place>> out;
        for (const std::size_t car : cars) {
            if (batch_->end(check(car)).reason != EndReason::none)
                throw nb::value_error(fmt::format("car {} has ended: there is nothing to come back to", car).c_str());
            out.push_back(std::make_unique<Place>(*cars_[car]));
            batch_->save(car, out.back()->snapshot);
        }
        return out;
    }
    void restore(const Cars& cars, const std::vector<const Place*>& from) {
        const Turn turn(busy_);
        if (cars.size() != from.size()) throw nb::value_error("expected a snapshot for each car");
        for (std::size_t i = 0; i < cars.size(); ++i) {
            expect_object(from[i], "a snapshot").expect_of(*cars_[check(cars[i])]);
        }
        for (std::size_t i = 0; i < cars.size(); ++i) batch_->restore(cars[i], from[i]->snapshot);
    }

    std::vector<bool> ended() const {
        std::vector<bool> out(size());
        for (std::size_t i = 0; i < size(); ++i) out[i] = batch_->end(i).reason != EndReason::none;
        return out;
    }
    std::string why(std::size_t car) const { return word(batch_->end(check(car)).reason); }
    NewNumbers times() const {
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
    void step_with(long steps, const double* targets) {
        const std::size_t count = controls_.list().size();
        const auto access = [&](std::size_t car) {
            return [this, car](auto&& change) { batch_->change_inputs(car, change); };
        };
        for (std::size_t car = 0; car < size(); ++car) {
            move_controls(controls_, targets + car * count, batch_->time(car), static_cast<double>(steps) * step_size(),
                          access(car));
        }
        batch_->advance(steps);
        for (std::size_t car = 0; car < size(); ++car) {
            hold_controls(controls_, targets + car * count, batch_->time(car), access(car));
        }
    }
    void read(const std::vector<std::size_t>& which, double* to) {
        batch_->for_each_car([&](std::size_t car) {
            const State<double> state = batch_->state(car);
            const Simulation& own = batch_->simulation(car);
            const Sample sample = sample_at(own.model(), state, batch_->schedule(car)(batch_->time(car)));
            for (std::size_t k = 0; k < which.size(); ++k) {
                to[car * which.size() + k] = channels_.at(which[k]).read(sample);
            }
        });
    }

    ScenarioDescription scenario_;
    std::vector<std::shared_ptr<const Simulation>> cars_;
    std::optional<Batch> batch_;
    DirectControls controls_;
    std::vector<Channel> channels_;
    mutable std::atomic<bool> busy_{false};
};

}  // namespace

void add_batch(nb::module_& module) {
    nb::class_<Fleet>(module, "Fleet")
        .def(nb::init<const Vehicles&, const ScenarioDocument&, const Vehicles&, int, bool, double>(), "vehicles"_a,
             "scenario"_a, "variants"_a, "threads"_a, "single_precision"_a, "tilt_limit"_a)
        .def("step", &Fleet::step, "steps"_a, "targets"_a.noconvert())
        .def("rollout", &Fleet::rollout, "steps"_a, "targets"_a.noconvert(), "channels"_a)
        .def("values", &Fleet::values, "channels"_a)
        .def("states", &Fleet::states)
        .def("restart", &Fleet::restart, "cars"_a)
        .def("replace", &Fleet::replace, "cars"_a, "vehicles"_a)
        .def("save", &Fleet::save, "cars"_a)
        .def("restore", &Fleet::restore, "cars"_a, "snapshots"_a)
        .def("ended", &Fleet::ended)
        .def("why", &Fleet::why, "car"_a)
        .def("times", &Fleet::times)
        .def_prop_ro("engine", &Fleet::engine)
        .def_prop_ro("step_size", &Fleet::step_size)
        .def_prop_ro("channels",
                     [](const Fleet& fleet) {
                         nb::list out;
                         for (const Channel& channel : fleet.channels()) {
                             out.append(nb::make_tuple(channel.column.name, channel.column.unit,
                                                       channel.column.description, channel.standard));
                         }
                         return out;
                     })
        .def_prop_ro("controls", [](const Fleet& fleet) { return described(fleet.controls()); });
}

}  // namespace hamilcar::python
