// What passes between the batch and the engine of an instruction set: an engine is a shared object of its own, because
// objects compiled for different instruction sets must not be linked together (ARCHITECTURE.md, "Batch").
//
// Only doubles, pointers and plain structs cross; packs stay inside. A chunk is as many cars as an engine has lanes.
#pragma once

#include <string_view>

#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/integrator/methods.hpp"

namespace hamilcar {

enum class Precision { double_precision, single_precision };

// Why a car of a batch stopped before the others.
enum class EndReason { none, not_finite, came_apart, locked, rolled_over };

struct CarEnd {
    EndReason reason = EndReason::none;
    double time = 0;  // of the last good state [s]
};

// A car at its start; read while a chunk is made, but for the schedule, which must stay.
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
    bool energy_balance = false;
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

struct BatchEngine {
    static constexpr int current_version = 1;  // of this header
    int version;
    std::string_view instruction_set;
    int lanes_double, lanes_single;
    // At least one car, at most as many as there are lanes; the caller deletes the chunk.
    Chunk* (*make_chunk)(Precision, const LaneCar* cars, int count, const ChunkSettings&);

    int lanes(Precision p) const { return p == Precision::double_precision ? lanes_double : lanes_single; }
};

// Every engine exports one function of this type under this name.
using BatchEngineFunction = const BatchEngine* (*)();
inline constexpr const char* batch_engine_symbol = "hamilcar_batch_engine";

}  // namespace hamilcar
