// A short, fixed piece of work for an instruction counter: steps of one car, or of a batch, with one engine.
// Usage: instruction_count ENGINE (one | double | single) STEPS
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/bench/scenes.hpp"
#include "hamilcar/io/vehicle_file.hpp"

int main(int argc, char** argv) {
    using namespace hamilcar;
    if (argc != 4) return std::fprintf(stderr, "usage: instruction_count ENGINE (one | double | single) STEPS\n"), 2;
    const VehicleDescription vehicle = io::read_vehicle(HAMILCAR_SOURCE_DIR "/vehicles/bmw_323i_paper.toml");
    const long steps = std::atol(argv[3]);
    const Engine& own = engine(argv[1]);
    if (std::strcmp(argv[2], "one") == 0) {
        EngineCar car(own, Simulation(vehicle, bend()));
        car.advance(steps);
        return std::printf("%.17g\n", car.state().position()[0]), 0;
    }
    const Precision precision =
        std::strcmp(argv[2], "single") == 0 ? Precision::single_precision : Precision::double_precision;
    const auto simulations = fleet(vehicle, own.lanes(precision));
    std::vector<const Simulation*> cars;
    for (const auto& simulation : simulations) cars.push_back(simulation.get());
    Batch batch(cars, {.threads = 1, .precision = precision, .instruction_set = argv[1]});
    batch.advance(steps);
    std::printf("%.17g\n", batch.state(0).position()[0]);
}
