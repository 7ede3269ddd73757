#include "hamilcar/bench/scenes.hpp"

#include <utility>

namespace hamilcar {

namespace {

// On the flat at 20 m/s under power, the rack led through the table.
ScenarioDescription steered(const char* name, double duration, SignalDescription rack) {
    ScenarioDescription scenario;
    scenario.name = name;
    scenario.duration = duration;
    scenario.initial.velocity = {20, 0, 0};
    scenario.drive = {{0}, {250}, Interpolation::smooth};
    scenario.steering_input = SteeringInput::rack;
    scenario.steering = std::move(rack);
    scenario.solver.energy_balance = false;
    scenario.controllers_off = {"all"};  // whose rates go with few steps only
    return scenario;
}

}  // namespace

ScenarioDescription bend(double rack) {
    return steered("bend", 1e6, {{0, 0.5}, {0, rack}, Interpolation::smooth});
}

Simulation cornering(const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    Simulation simulation(vehicle, scenario);
    while (simulation.time() < 0.5) simulation.advance();
    return simulation;
}

std::vector<std::unique_ptr<Simulation>> fleet(const VehicleDescription& vehicle, int count) {
    std::vector<std::unique_ptr<Simulation>> cars;
    for (int i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / count;
        VehicleDescription own = vehicle;
        own.chassis.mass *= 1 + 0.2 * share;
        ScenarioDescription scenario = bend(0.003 * (1 + share));
        scenario.road.friction = 1 - 0.3 * share;
        cars.push_back(std::make_unique<Simulation>(own, scenario));
    }
    return cars;
}

ScenarioDescription lane_change() {
    return steered("lane change", 15,
                   {{1, 2, 3, 4, 7, 8, 9, 10}, {0, 0.005, -0.005, 0, 0, -0.005, 0.005, 0}, Interpolation::smooth});
}

}  // namespace hamilcar
