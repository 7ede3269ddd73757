// As many cars as a program has lanes, stepped together.
#pragma once

#include <memory>
#include <vector>

#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/engine/rhs_program.hpp"
#include "hamilcar/integrator/integrator.hpp"

namespace hamilcar {

// Why a car of a batch stopped before the others.
enum class EndReason { none, not_finite, loops_open, locked, rolled_over, driver_ended };

struct CarEnd {
    EndReason reason = EndReason::none;
    double time = 0;  // of the last good state [s]
};

// A car at its start, or where it stood once. The state is copied when a chunk is made; model and schedule must outlive the chunk.
struct LaneCar {
    const Model<double>* model;
    const State<double>* state;
    const Schedule* schedule;
};

// What else a car's further steps depend on: how many it has done, and its latest rates as in an Integrator.
struct LanePast {
    long steps = 0;
    Integrator<State<double>>::Memory rates;
    LanePast() {}
};

// The same for every car of a batch.
struct ChunkSettings {
    Method method;
    double step;              // [s]
    double tilt_cosine = -2;  // a car ends when its z axis leans further; -2: never
};

class Chunk {
public:
    virtual ~Chunk() = default;
    // Cars that have ended keep their last good state.
    virtual void advance(long steps) = 0;
    virtual double time(int lane) const = 0;  // of a car, since its own start [s]
    virtual long steps(int lane) const = 0;   // the same in steps; those of a car that has ended go on
    virtual State<double> state(int lane) const = 0;
    virtual CarEnd end(int lane) const = 0;
    virtual void set_schedule(int lane, const Schedule& schedule) = 0;
    // Puts a car into a lane, at its start or where its past says. The numbers of its model that are no parameters of the program
    // are those that the program was made with.
    virtual void set_car(int lane, const LaneCar& car, const LanePast* past = nullptr) = 0;
    // Runs a program of the same cars (engine/traced_sample.hpp) on their states: number i of lane l is at [i * lanes + l].
    virtual std::vector<double> sample(const program::Executable& program, std::size_t count) = 0;
    // What sensors of a car read at the beginning of the latest step.
    virtual void measurement(int lane, double* to) const = 0;
    // Of a car that runs.
    virtual void save_past(int lane, LanePast& to) const = 0;
};

// At least one car, at most as many as the program has lanes.
std::unique_ptr<Chunk> make_chunk(std::shared_ptr<const RhsProgram> program, std::span<const LaneCar> cars,
                                  const ChunkSettings& settings);

}  // namespace hamilcar
