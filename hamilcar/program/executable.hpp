// A graph compiled for this machine.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program {

// A function that a program calls: `arguments` and `results` are doubles or floats by the program's precision, number by
// number, each with `lanes` values.
using CallFunction = void (*)(const void* context, int detail, int lanes, const void* arguments, void* results);

// The data of a run. Number `i` of an array in lane `l` is at [i * lanes + l]; arrays of doubles or floats by the precision,
// aligned to 64 bytes where there is more than one lane. Arrays that are written and those that are read must not overlap.
struct Frame {
    void* arrays[max_arrays] = {};
    const CallFunction* functions = nullptr;
    const void* context = nullptr;  // passed to the functions
};

// Statistics of a compilation.
struct CompileReport {
    std::size_t instructions = 0, code_bytes = 0, constant_bytes = 0;
    std::size_t spills = 0, reloads = 0;  // of values for which no register was left
    std::size_t scratch_bytes = 0;        // on the stack
    double seconds = 0;                   // to compile
};

// May run on many threads at once; throws nothing. Allocates nothing, except that the portable one may when it needs more
// than 128 KiB of scratch on more threads at once than ever before.
class Executable {
public:
    virtual ~Executable() = default;
    Executable(const Executable&) = delete;
    Executable& operator=(const Executable&) = delete;

    void run(const Frame& frame) const { entry_(*this, frame); }
    int lanes() const { return lanes_; }
    Precision precision() const { return precision_; }
    const CompileReport& report() const { return report_; }

protected:
    using Entry = void (*)(const Executable& self, const Frame& frame);
    Executable(Precision precision, int lanes) : precision_(precision), lanes_(lanes) {}
    Entry entry_ = nullptr;
    Precision precision_;
    int lanes_;
    CompileReport report_;
};

// A kind of machine to compile for.
struct Backend {
    std::string_view name;  // "avx512", "avx2", "sse2", "portable"
    int register_bytes;     // the widest; with a car in each lane, a lane is as wide as a number
    bool (*is_available)();
    // One car at a time (lanes 1, nodes of any width that fits register_bytes and 16 bytes at least), or a car in
    // each lane (nodes of width 1 alone). Throws std::runtime_error if the system refuses executable memory.
    std::unique_ptr<Executable> (*compile)(const Graph& graph, bool car_in_each_lane);

    int lanes(Precision precision) const { return register_bytes / (precision == Precision::double_precision ? 8 : 4); }
};

// The fastest first; "portable" is always there and comes last.
const std::vector<Backend>& backends();

}  // namespace hamilcar::program
