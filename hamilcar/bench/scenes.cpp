#include "hamilcar/bench/scenes.hpp"

namespace hamilcar {

ScenarioDescription bend(double rack) {
    ScenarioDescription scenario;
    scenario.name = "bend";
    scenario.duration = 1e6;
    scenario.initial.velocity = {20, 0, 0};
    scenario.drive = {{0}, {250}, Interpolation::smooth};
    scenario.steering_input = SteeringInput::rack;
    scenario.steering = {{0, 0.5}, {0, rack}, Interpolation::smooth};
    scenario.solver.energy_balance = false;
    return scenario;
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
    ScenarioDescription scenario;
    scenario.name = "lane change";
    scenario.duration = 15;
    scenario.initial.velocity = {20, 0, 0};
    scenario.drive = {{0}, {250}, Interpolation::smooth};
    scenario.steering_input = SteeringInput::rack;
    scenario.steering = {{1, 2, 3, 4, 7, 8, 9, 10}, {0, 0.005, -0.005, 0, 0, -0.005, 0.005, 0}, Interpolation::smooth};
    scenario.solver.energy_balance = false;
    return scenario;
}

}  // namespace hamilcar
