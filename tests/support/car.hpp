// The car on the paper's tire and variants of it, for tests that need a whole vehicle.
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
inline VehicleDescription conservative_car() {
    VehicleDescription car = paper_car();
    for (SuspensionDescription& suspension : car.suspensions) {
        suspension.dampers[0].damper = {{-1, 1}, {0, 0}};
        const auto& tire = std::get<LinearTireDescription>(suspension.wheels[0].tire);
        suspension.wheels[0].tire = SpringTireDescription{tire.radius, tire.rolling_radius, tire.vertical_stiffness};
    }
    car.aerodynamics = {};
    return car;
}

inline Model<double> make_model(const VehicleDescription& car) {
    VehicleDescription alone = car;  // a torque at the wheels replaces the power units
    alone.power_units.clear(), alone.differentials.clear();
    return {.vehicle = Vehicle<double>(alone), .road = PlaneRoad<double>(0, 0, 1)};
}

inline Energy<double> energy_of(const Model<double>& model, const State<double>& state, const Input<double>& input) {
    const auto velocity = velocity_block(model, state, input);
    return energy(model, state, velocity, momenta_block(model, state, input, velocity));
}

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
