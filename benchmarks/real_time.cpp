// For a hard real-time loop: ten million steps of a car in a bend, one by one; and an hour of a car that stands, whose
// steps must take no longer than a moving car's, though everything in it decays toward zero.
#include <fmt/format.h>

#include "hamilcar/bench/interleave.hpp"
#include "hamilcar/bench/scenes.hpp"
#include "hamilcar/bench/step_jitter.hpp"
#include "hamilcar/io/vehicle_file.hpp"

int main() {
    using namespace hamilcar;
    const VehicleDescription vehicle = io::read_vehicle(HAMILCAR_SOURCE_DIR "/vehicles/bmw_323i_paper.toml");
    Simulation driving = cornering(vehicle, bend());
    const StepJitter s = step_jitter(driving, 10'000'000);
    fmt::print("10 million steps: median {:.0f} ns (the clock's reading of {:.0f} ns included); one in 10 000 takes\n",
               1e9 * s.median, 1e9 * s.clock);
    fmt::print("  by its own doing     more than {:6.0f} ns, {:5.2f} times the median\n", 1e9 * s.late_alone,
               s.late_alone / s.median);
    fmt::print("  with interruptions   more than {:6.0f} ns, {:5.2f} times the median\n", 1e9 * s.late,
               s.late / s.median);
    fmt::print("  a loop that only waits as long: more than {:6.0f} ns, {:5.2f} times\n", 1e9 * s.late_idle,
               s.late_idle / s.median);

    ScenarioDescription rest;
    rest.name = "rest";
    rest.duration = 1e6;
    rest.solver.energy_balance = false;
    Simulation standing(vehicle, rest);
    for (long i = 0; i < 3'600'000; ++i) standing.advance();
    const auto advance = [](Simulation& simulation) {
        return [&simulation](long steps) {
            for (long i = 0; i < steps; ++i) simulation.advance();
        };
    };
    const InterleavedTimes result =
        interleave({{"standing", advance(standing)}, {"driving", advance(driving)}}, 0.02, 25);
    fmt::print("after an hour at rest: a step takes {:.0f} ns, {:.2f} times that of a moving car\n",
               1e9 * result.time(0), result.ratio(0, 1));
}
