// The step loops, compiled once for each instruction set. What passes between the library and such an engine: an engine is
// a shared object of its own, because objects compiled for different instruction sets must not be linked together
// (ARCHITECTURE.md, "Engines").
//
// Only doubles, pointers and plain structs cross; packs stay inside. A chunk is as many cars as an engine has lanes.
#pragma once

#include <string_view>

#include "hamilcar/block/integration.hpp"
#include "hamilcar/driver/schedule.hpp"

namespace hamilcar {

enum class Precision { double_precision, single_precision };

// Why a car of a batch stopped before the others.
enum class EndReason { none, not_finite, came_apart, locked, rolled_over, driver_ended };

struct CarEnd {
    EndReason reason = EndReason::none;
    double time = 0;  // of the last good state [s]
};

// A car at its start. The state is read while a chunk is made; model and schedule must stay as long as it does.
struct LaneCar {
    const Model<double>* model;
    const State<double>* state;
    const Schedule* schedule;
};

// The same for every car of a batch.
struct ChunkSettings {
    Method method;
    double step;              // [s]
    double tilt_cosine = -2;  // a car ends where its z axis leans further; -2: it may roll over
};

class Chunk {
public:
    virtual ~Chunk() = default;
    // Cars that have ended keep their last good state.
    virtual void advance(long steps) = 0;
    virtual double time() const = 0;
    virtual State<double> state(int lane) const = 0;
    virtual CarEnd end(int lane) const = 0;
    virtual void set_schedule(int lane, const Schedule& schedule) = 0;
};

struct Engine {
    std::string_view instruction_set;
    int lanes_double, lanes_single;

    // One step of one car: the Integration block. The worst health met on the way.
    Health<double> (*advance_car)(const Model<double>&, Integrator<State<double>>&, const Schedule&, double time,
                                  State<double>&);
    // At least one car, at most as many as there are lanes; the caller deletes the chunk.
    Chunk* (*make_chunk)(Precision, const LaneCar* cars, int count, const ChunkSettings&);
    // Does nothing but multiply and add, as fast as a core can with this instruction set, fused where it can: the limit to
    // measure the others by. Returns how many additions and multiplications it did in that many rounds.
    double (*multiply_and_add)(Precision, long rounds);

    int lanes(Precision p) const { return p == Precision::double_precision ? lanes_double : lanes_single; }
};

// Every engine exports one function of this type. A hash of the sources is part of its name, so that a library never takes
// an engine of another build.
using EngineFunction = const Engine* (*)();

// The parts of an engine, each in a source of its own since they want different options of the compiler.
namespace engine_parts {
Health<double> advance_car(const Model<double>&, Integrator<State<double>>&, const Schedule&, double, State<double>&);
Chunk* make_chunk(Precision, const LaneCar* cars, int count, const ChunkSettings&);
double multiply_and_add(Precision, long rounds);
const Engine& engine();  // all of them
}  // namespace engine_parts

}  // namespace hamilcar
