// Many cars stepped together: a car in each lane of a chunk, chunks distributed over threads. Every car has its own
// parameters, driver, road and start; they share the topology, the method and the step.
//
// A car has the same bits here as in a Simulation of its own, whatever its lane, its neighbors, the number of threads and the
// engine, and whenever it begins; in single precision the same as in any other batch.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hamilcar/batch/topology.hpp"
#include "hamilcar/batch/worker_pool.hpp"
#include "hamilcar/engine/chunk.hpp"
#include "hamilcar/engine/traced_sample.hpp"
#include "hamilcar/run/controlled_car.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct BatchOptions {
    int threads = 0;  // including the caller's; zero: as many as the machine has
    Precision precision = Precision::double_precision;
    std::string engine;     // its name; empty: the default engine
    double tilt_limit = 0;  // a car ends when its z axis leans further [rad]; zero: never
    // Cars that may take the place of others later (`replace`): numbers in which they differ from the first car may be changed. They need not
    // outlive the batch's making.
    std::vector<const Simulation*> variants = {};
};

class Batch {
public:
    // Starts from Simulations that have not been advanced yet. They must outlive the batch and keep their addresses and
    // schedules: a vector of them must not grow. Throws std::invalid_argument for cars that cannot share a chunk, for the
    // adaptive method and for an empty list; and as engine() does.
    Batch(std::vector<const Simulation*> cars, const BatchOptions& options);
    Batch(const std::vector<Simulation>& cars, const BatchOptions& options);
    Batch(std::vector<Simulation>&&, const BatchOptions&) = delete;

    std::size_t size() const { return cars_.size(); }
    std::string_view engine() const { return engine_->name; }

    // Advances all cars by that many steps; those that have ended stay where they are.
    void advance(long steps);
    double time() const { return static_cast<double>(step_count_) * step_; }  // since the batch was made [s]
    // Of a car since its own start, the end of one that has ended [s].
    double time(std::size_t car) const {
        const CarEnd ended = end(car);
        return ended.reason == EndReason::none ? chunk_of(car).time(lane_of(car)) : ended.time;
    }
    // The state in doubles; the last good one of a car that has ended.
    State<double> state(std::size_t car) const {
        return drivers_[car].stop ? drivers_[car].stop->state : chunk_of(car).state(lane_of(car));
    }
    CarEnd end(std::size_t car) const {
        const auto& stop = drivers_[car].stop;
        return stop ? CarEnd{EndReason::driver_ended, stop->time} : chunk_of(car).end(lane_of(car));
    }
    // Replaces a car's inputs from now on and removes its driver.
    void set_schedule(std::size_t car, const Schedule& schedule) {
        drivers_[car].driver.reset();
        drivers_[car].schedule = schedule;
        chunk_of(car).set_schedule(lane_of(car), drivers_[car].schedule);
    }
    // Calls change(schedule, driver or null) with what a car is driven by, and goes on with that. No other call at the same time but
    // of the same for a car of another chunk.
    template <class Change>
    void change_inputs(std::size_t car, Change&& change) {
        CarDriver& own = drivers_[car];
        change(own.schedule, own.driver ? &*own.driver : nullptr);
        chunk_of(car).set_schedule(lane_of(car), own.schedule);
    }
    // Calls f(car) for each, on the batch's threads; those of one chunk one after the other.
    void for_each_car(const std::function<void(std::size_t)>& f) {
        pool_.run(static_cast<int>(chunks_.size()), [&](int chunk) {
            for (const std::size_t car : cars_of_[static_cast<std::size_t>(chunk)]) f(car);
        });
    }
    const Schedule& schedule(std::size_t car) const { return drivers_[car].schedule; }
    // What its sensors and controllers remember; empty without any.
    std::span<const double> control_memory(std::size_t car) const { return drivers_[car].control_memory; }
    const Simulation& simulation(std::size_t car) const { return *cars_[car]; }  // that the car started as

    // What to read off every car, compiled for the batch.
    struct Sampler {
        std::vector<std::shared_ptr<const program::Executable>> of_group;
        std::size_t count = 0;
    };
    Sampler sampler(const TracedReaders& readers) const;
    // Number i of car c goes to [c * count + i]. Those of cars that have ended are left alone.
    void sample(const Sampler& sampler, double* to);

    // A car is again at its start, at time 0 of its own, whatever it has done and whether it has ended.
    void restart(std::size_t car);
    // Another car in the place of that one, at its start; it must outlive the batch. Throws std::invalid_argument for one that
    // differs in more than the batch was made for.
    void replace(std::size_t car, const Simulation& by);
    // Why it cannot, or nothing.
    std::string obstacle_to_replace(std::size_t car, const Simulation& by) const;
    // A place in a car's run to come back to, in this batch or in a Simulation of the same car, and from there to here. The car must run.
    void save(std::size_t car, Snapshot& to) const;
    void restore(std::size_t car, const Snapshot& from);

private:
    // A car's schedule and closed-loop driver, copied from its Simulation, and where the driver ended the run.
    struct Stop {
        double time;
        State<double> state;
    };
    struct CarDriver {
        Schedule schedule;
        std::optional<Driver> driver;
        long steps_per_decision = 1;
        std::vector<double> control_memory = {};  // of the simulation's control system
        std::optional<Stop> stop;
    };
    void advance_chunk(std::size_t chunk, long steps);
    void decide(std::size_t car);
    void let_controllers_decide(std::size_t car, long step);
    static CarDriver driver_of(const Simulation& car);

    // A car's chunk and its lane there.
    struct Slot {
        std::size_t chunk;
        int lane;
    };
    Chunk& chunk_of(std::size_t car) const { return *chunks_[slots_[car].chunk]; }
    int lane_of(std::size_t car) const { return slots_[car].lane; }
    void assign_slots(const ChunkSettings& settings, Precision precision,
                      const std::vector<const Simulation*>& variants);

    std::vector<const Simulation*> cars_;
    const Engine* engine_;
    std::vector<std::unique_ptr<Chunk>> chunks_;
    std::vector<std::vector<std::size_t>> cars_of_;  // of a chunk
    std::vector<Slot> slots_;
    // Cars whose linkages are eliminated in one order, and the program of all of them.
    struct Group {
        Model<double> example;
        CommonCar common;
        std::shared_ptr<const RhsProgram> program;
    };
    std::vector<Group> groups_;
    std::vector<std::size_t> group_of_;  // of a chunk
    Precision precision_ = Precision::double_precision;
    std::vector<CarDriver> drivers_;
    double step_ = 0;      // [s]
    long step_count_ = 0;  // done by all chunks
    WorkerPool pool_;
};

}  // namespace hamilcar
