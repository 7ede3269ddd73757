// The car on the paper's tire and variants of it, for tests that need a whole vehicle. What instantiates templates is compiled once,
// in car.cpp, and not in every test.
#pragma once

#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/simulation.hpp"
#include "support/paths.hpp"

namespace hamilcar::test {

inline VehicleDescription paper_car() {
    return io::read_vehicle(source_path("vehicles/bmw_323i_paper.toml"));
}

// The shipped car unchanged, on Magic Formula tires.
inline VehicleDescription shipped_car() {
    return io::read_vehicle(source_path("vehicles/bmw_323i.toml"));
}

// The car without dissipation and smooth: no dampers, no drag, tires that are bilateral
// vertical springs. Its stops stay; a test keeps the travel inside them.
VehicleDescription conservative_car();

// On a level road. A torque at the wheels replaces the power units.
Model<double> make_model(const VehicleDescription& car);

Energy<double> energy_of(const Model<double>& model, const State<double>& state, const Input<double>& input);

// A scenario that starts from a given forward speed on the flat, with the inputs left to the caller.
inline ScenarioDescription scenario(double duration, double forward_speed = 0) {
    ScenarioDescription s;
    s.name = "test";
    s.duration = duration;
    s.initial.velocity = {forward_speed, 0, 0};
    return s;
}

inline SignalDescription table(std::vector<double> time, std::vector<double> value) {
    return {std::move(time), std::move(value), Interpolation::smooth};
}

// Runs to the end; fails the test with the reason if the run ends early.
void run_to_end(Simulation& simulation);

}  // namespace hamilcar::test
