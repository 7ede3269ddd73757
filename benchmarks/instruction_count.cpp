// A short, fixed piece of work for an instruction counter: steps of one vehicle, or of a batch, with one engine.
// Usage: instruction_count ENGINE (one | double | single) VEHICLE STEPS
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/bench/scenes.hpp"
#include "hamilcar/io/vehicle_file.hpp"

int main(int argc, char** argv) {
    using namespace hamilcar;
    if (argc != 5)
        return std::fprintf(stderr, "usage: instruction_count ENGINE (one | double | single) VEHICLE STEPS\n"), 2;
    const VehicleDescription vehicle =
        io::read_vehicle(std::string(HAMILCAR_SOURCE_DIR "/vehicles/") + argv[3] + ".toml");
    const long steps = std::atol(argv[4]);
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
    Batch batch(cars, {.threads = 1, .precision = precision, .engine = argv[1]});
    batch.advance(steps);
    std::printf("%.17g\n", batch.state(0).position()[0]);
}
