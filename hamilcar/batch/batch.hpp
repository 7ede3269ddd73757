// Many cars in lock step: a car in each lane of a chunk, chunks over threads. Every car has its own parameters, driver, road
// and start; what they share is the topology, the method and the step.
//
// A car computes the same bits here as in a Simulation of its own, whatever its lane, its neighbors, the number of threads
// and the engine; in single precision the same as in any other batch.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hamilcar/batch/worker_pool.hpp"
#include "hamilcar/engine/chunk.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct BatchOptions {
    int threads = 0;  // with the caller's own; zero: as many as the machine has
    Precision precision = Precision::double_precision;
    std::string engine;     // its name; empty: the default engine
    double tilt_limit = 0;  // a car ends when its z axis leans further [rad]; zero: it may roll over
};

// What differs between two cars that cannot share a chunk, or nothing: "tire model of wheel 2", "step", ...
std::string topology_difference(const Simulation& a, const Simulation& b);

class Batch {
public:
    // Takes over cars that have been put on the road by their Simulations and not been advanced yet. These must outlive
    // the batch, stay where they are and keep their schedules: a vector of them must not grow. Throws
    // std::invalid_argument for cars that cannot share a chunk, for the adaptive method and for no cars; and as engine()
    // does.
    Batch(std::vector<const Simulation*> cars, const BatchOptions& options);
    Batch(const std::vector<Simulation>& cars, const BatchOptions& options);
    Batch(std::vector<Simulation>&&, const BatchOptions&) = delete;

    std::size_t size() const { return cars_.size(); }
    std::string_view engine() const { return engine_->name; }

    // All cars by that many steps; those that have ended stay where they are.
    void advance(long steps);
    double time() const { return chunks_.front()->time(); }
    // In doubles; the last good state of a car that has ended.
    State<double> state(std::size_t car) const {
        return attended_[car].stop ? attended_[car].stop->state : chunk_of(car).state(lane_of(car));
    }
    CarEnd end(std::size_t car) const {
        const auto& stop = attended_[car].stop;
        return stop ? CarEnd{EndReason::driver_ended, stop->time} : chunk_of(car).end(lane_of(car));
    }
    // Other inputs over time from now on, and no driver; they must outlive the batch.
    void set_schedule(std::size_t car, const Schedule& schedule) {
        attended_[car].driver.reset();
        chunk_of(car).set_schedule(lane_of(car), schedule);
    }
    void set_schedule(std::size_t, Schedule&&) = delete;

private:
    // A car with a driver who decides on the way: his own copies, and where he ended the run.
    struct Stop {
        double time;
        State<double> state;
    };
    struct Attended {
        Schedule schedule;
        std::optional<Driver> driver;
        long steps_per_decision = 1;
        std::optional<Stop> stop;
    };
    void advance_chunk(std::size_t chunk, long steps);
    void decide(std::size_t car, long step);

    // Where a car is: its chunk, and its lane there.
    struct Seat {
        std::size_t chunk;
        int lane;
    };
    Chunk& chunk_of(std::size_t car) const { return *chunks_[seats_[car].chunk]; }
    int lane_of(std::size_t car) const { return seats_[car].lane; }
    void seat(const ChunkSettings& settings, Precision precision);

    std::vector<const Simulation*> cars_;
    const Engine* engine_;
    std::vector<std::unique_ptr<Chunk>> chunks_;
    std::vector<std::vector<std::size_t>> cars_of_;  // of a chunk
    std::vector<Seat> seats_;
    std::vector<Attended> attended_;
    double step_ = 0;      // [s]
    long step_count_ = 0;  // that all chunks have done
    WorkerPool pool_;
};

}  // namespace hamilcar
