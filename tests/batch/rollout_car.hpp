// A car for rollouts, what is read off it, and rows of controls that move everything.
#pragma once

#include <cmath>

#include "hamilcar/batch/rollout.hpp"
#include "hamilcar/run/channels.hpp"
#include "support/car.hpp"

namespace hamilcar::test {

inline ScenarioDescription rolling(double speed = 15) {
    ScenarioDescription s = scenario(10, speed);
    s.solver.integrator = "rk4";
    s.solver.energy_balance = false;
    return s;
}

struct Car {
    Simulation simulation;
    DirectControls controls;
    explicit Car(const VehicleDescription& vehicle, const ScenarioDescription& scenario = rolling())
        : simulation(vehicle, scenario), controls(simulation.vehicle(), scenario, simulation.schedule()) {}
    RolloutCar car() const { return {&simulation, &controls}; }
};

inline TracedReaders readers(const VehicleDescription& vehicle) {
    TracedReaders out;
    for (const Channel& channel : all_channels(vehicle)) {
        for (const char* name : {"chassis.yaw_rate", "chassis.position.y", "chassis.speed", "chassis.angle.roll"}) {
            if (channel.column.name == name) out.push_back(channel.trace);
        }
    }
    return out;
}

// Steering to and fro, some torque, some braking.
inline RolloutNumbers runs_of(const Rollout& rollout, const Car& car, std::size_t runs, std::size_t rows) {
    RolloutNumbers out;
    for (std::size_t run = 0; run < runs; ++run) {
        for (std::size_t row = 0; row <= rows; ++row) {
            const double t = 0.7 * static_cast<double>(row) + 0.3 * static_cast<double>(run);
            for (const DirectControls::Entry& entry : car.controls.list()) {
                const double mass = Vehicle<double>(car.simulation.vehicle()).total_mass;
                const bool steers = entry.control == Control::rack;
                const double value = steers ? 0.4 * std::sin(t) * (entry.by_wheel ? 1 : 0.02)
                                     : entry.control == Control::drive_torque ? 0.1 * mass * std::cos(t)
                                                                              : 0.04 + 0.02 * std::sin(2 * t);
                out.controls.push_back(row == 0 ? 0 : value);  // a rack that began elsewhere would tear the linkage
            }
        }
        const State<double>& state = car.simulation.state();
        out.states.insert(out.states.end(), state.values.begin(),
                          state.values.begin() + static_cast<long>(rollout.state_size()));
    }
    return out;
}

}  // namespace hamilcar::test
