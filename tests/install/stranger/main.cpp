// A stranger's first program with the library: a car rolls for a second.
#include <hamilcar/io/vehicle_file.hpp>
#include <hamilcar/run/simulation.hpp>

#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    hamilcar::ScenarioDescription scenario;
    scenario.duration = 1;
    scenario.initial.velocity = {20, 0, 0};
    hamilcar::Simulation car(hamilcar::io::read_vehicle(argv[1]), scenario);
    while (!car.finished()) {
        if (const auto end = car.advance()) return std::printf("%s\n", end->message.c_str()), 1;
    }
    const double x = car.state().position()[0];
    std::printf("after 1 s at 20 m/s the car is at x = %.3f m\n", x);
    return x > 19 && x < 20 ? 0 : 1;
}
