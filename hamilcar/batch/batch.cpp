#include "hamilcar/batch/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace hamilcar {

namespace {

std::vector<const Simulation*> pointers(const std::vector<Simulation>& cars) {
    std::vector<const Simulation*> out;
    for (const Simulation& car : cars) out.push_back(&car);
    return out;
}

}  // namespace

Batch::Batch(const std::vector<Simulation>& cars, const BatchOptions& options) : Batch(pointers(cars), options) {}

Batch::Batch(std::vector<const Simulation*> cars, const BatchOptions& options)
    : cars_(std::move(cars)),
      engine_(options.engine.empty() ? &default_engine() : &hamilcar::engine(options.engine)),
      pool_(options.threads) {
    if (cars_.empty()) throw std::invalid_argument("a batch needs at least one car");
    const SolverDescription& solver = cars_[0]->scenario().solver;
    const Method* method = find_method(solver.integrator);
    if (method->family == MethodFamily::embedded_runge_kutta) {
        throw std::invalid_argument(
            fmt::format("{} has variable steps; a batch needs a method with fixed steps", method->name));
    }
    for (std::size_t i = 0; i < cars_.size(); ++i) {
        const std::string difference = topology_difference(*cars_[0], *cars_[i]);
        if (!difference.empty()) {
            throw std::invalid_argument(
                fmt::format("car {} cannot share a chunk with the first one: they differ in {}", i + 1, difference));
        }
        if (cars_[i]->steps_taken() != 0)
            throw std::invalid_argument(fmt::format("car {} has already been advanced", i + 1));
        drivers_.push_back(driver_of(*cars_[i]));
    }
    step_ = solver.step;
    const ChunkSettings settings{.method = *method,
                                 .step = solver.step,
                                 .tilt_cosine = options.tilt_limit > 0 ? std::cos(options.tilt_limit) : -2.0};
    assign_slots(settings, options.precision, options.variants);
}

// As at its start.
Batch::CarDriver Batch::driver_of(const Simulation& car) {
    return {car.schedule(), car.driver(), car.steps_per_decision(), car.control_memory(), std::nullopt};
}

// Cars whose hardpoints differ so much that their linkages need another elimination order get a separate program.
void Batch::assign_slots(const ChunkSettings& settings, Precision precision,
                         const std::vector<const Simulation*>& variants) {
    precision_ = precision;
    std::map<std::vector<int>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < cars_.size(); ++i) groups[elimination_order(cars_[i]->model().vehicle)].push_back(i);
    const auto lanes = static_cast<std::size_t>(engine_->lanes(precision));
    slots_.resize(cars_.size());
    for (const auto& [order, group] : groups) {
        std::vector<const Model<double>*> models;
        for (const std::size_t car : group) models.push_back(&cars_[car]->model());
        for (const Simulation* variant : variants) {
            if (elimination_order(variant->model().vehicle) == order) models.push_back(&variant->model());
        }
        Group& made = groups_.emplace_back();
        made.common = common_car(models, made.example);
        made.program = rhs_program(models, *engine_, precision);
        const auto& program = made.program;
        for (std::size_t first = 0; first < group.size(); first += lanes) {
            std::vector<LaneCar> row;
            auto& own = cars_of_.emplace_back();
            for (std::size_t i = first; i < std::min(first + lanes, group.size()); ++i) {
                const std::size_t car = group[i];
                slots_[car] = {chunks_.size(), static_cast<int>(i - first)};
                row.push_back({&cars_[car]->model(), &cars_[car]->state(), &drivers_[car].schedule});
                own.push_back(car);
            }
            chunks_.push_back(make_chunk(program, row, settings));
            group_of_.push_back(groups_.size() - 1);
        }
    }
}

void Batch::advance(long steps) {
    pool_.run(static_cast<int>(chunks_.size()), [&](int i) { advance_chunk(static_cast<std::size_t>(i), steps); });
    step_count_ += steps;
}

// From one decision to the next, at the same steps of a car's own as in a Simulation.
void Batch::advance_chunk(std::size_t chunk, long steps) {
    Chunk& cars = *chunks_[chunk];
    for (long left = steps; left > 0;) {
        long next = left;
        for (const std::size_t car : cars_of_[chunk]) {
            const CarDriver& one = drivers_[car];
            const long now = cars.steps(lane_of(car));
            if (one.driver && !one.stop) {
                if (now > 0 && now % one.steps_per_decision == 0) decide(car);
                next = std::min(next, one.steps_per_decision - now % one.steps_per_decision);
            }
            const ControlSystem* control = cars_[car]->control();
            if (!control || one.stop) continue;
            if (control->is_due(now)) let_controllers_decide(car, now);
            next = std::min(next, control->steps_to_next(now));
        }
        cars.advance(next);
        for (const std::size_t car : cars_of_[chunk]) {
            if (cars_[car]->control()) cars.measurement(lane_of(car), drivers_[car].control_memory.data());
        }
        left -= next;
    }
}

void Batch::decide(std::size_t car) {
    const Chunk& chunk = chunk_of(car);
    if (chunk.end(lane_of(car)).reason != EndReason::none) return;
    CarDriver& one = drivers_[car];
    const double time = chunk.time(lane_of(car));
    const State<double> state = chunk.state(lane_of(car));
    one.driver->act(observe(cars_[car]->model(), state, one.schedule(time)), one.schedule);
    if (one.driver->end_reason()) one.stop = Stop{time, state};
    chunk_of(car).set_schedule(lane_of(car), one.schedule);
}

void Batch::let_controllers_decide(std::size_t car, long step) {
    Chunk& chunk = chunk_of(car);
    const int lane = lane_of(car);
    if (chunk.end(lane).reason != EndReason::none) return;
    CarDriver& one = drivers_[car];
    const Vehicle<double>& vehicle = cars_[car]->model().vehicle;
    StepTime now{step, chunk.time(lane)};
    if (vehicle.steering.exists()) now.steering_wheel = free_steering_wheel(vehicle, chunk.state(lane));
    let_decide(*cars_[car]->control(), cars_[car]->column(), now, one.control_memory, one.schedule);
    chunk.set_schedule(lane, one.schedule);
}

Batch::Sampler Batch::sampler(const TracedReaders& readers) const {
    Sampler out{.of_group = {}, .count = readers.size()};
    for (const Group& group : groups_) {
        out.of_group.push_back(sample_program(group.example, group.common, *engine_, precision_, readers));
        expect_lanes(*out.of_group.back(), group.program->executable->lanes());
    }
    return out;
}

void Batch::sample(const Sampler& sampler, double* to) {
    if (sampler.count == 0) return;
    pool_.run(static_cast<int>(chunks_.size()), [&](int i) {
        const auto chunk = static_cast<std::size_t>(i);
        const std::vector<double> numbers = chunks_[chunk]->sample(*sampler.of_group[group_of_[chunk]], sampler.count);
        const std::size_t lanes = numbers.size() / sampler.count;
        for (const std::size_t car : cars_of_[chunk]) {
            if (end(car).reason != EndReason::none) continue;
            const auto lane = static_cast<std::size_t>(lane_of(car));
            for (std::size_t k = 0; k < sampler.count; ++k) to[car * sampler.count + k] = numbers[k * lanes + lane];
        }
    });
}

void Batch::restart(std::size_t car) {
    const Simulation& from = *cars_[car];
    drivers_[car] = driver_of(from);
    chunk_of(car).set_car(lane_of(car), {&from.model(), &from.state(), &drivers_[car].schedule});
}

std::string Batch::obstacle_to_replace(std::size_t car, const Simulation& by) const {
    if (by.steps_taken() != 0) return "it has already been advanced";
    const std::vector<int>& parameters = groups_[group_of_[slots_[car].chunk]].program->parameters;
    const std::string difference = program_difference(*cars_[car], by, parameters);
    return difference.empty() ? difference : "they differ in " + difference;
}

void Batch::replace(std::size_t car, const Simulation& by) {
    if (const std::string obstacle = obstacle_to_replace(car, by); !obstacle.empty()) {
        throw std::invalid_argument(fmt::format("car {} cannot be replaced by this one: {}", car + 1, obstacle));
    }
    cars_[car] = &by;
    restart(car);
}

void Batch::save(std::size_t car, Snapshot& to) const {
    LanePast past;
    chunk_of(car).save_past(lane_of(car), past);
    to.step_count = past.steps;
    to.state = state(car);
    to.memory = past.rates;
    drivers_[car].schedule.save(to.inputs);
    if (drivers_[car].driver) to.driver = drivers_[car].driver->memory();
    std::ranges::copy(drivers_[car].control_memory, to.control.begin());
}

void Batch::restore(std::size_t car, const Snapshot& from) {
    const bool driver_was_removed = !drivers_[car].driver && cars_[car]->driver();
    drivers_[car] = driver_of(*cars_[car]);
    if (driver_was_removed) drivers_[car].driver.reset();
    CarDriver& own = drivers_[car];
    own.schedule.restore(from.inputs);
    if (own.driver) own.driver->restore(from.driver);
    std::copy_n(from.control.begin(), own.control_memory.size(), own.control_memory.begin());
    LanePast past;
    past.steps = from.step_count, past.rates = from.memory;
    chunk_of(car).set_car(lane_of(car), {&cars_[car]->model(), &from.state, &own.schedule}, &past);
}

}  // namespace hamilcar
