#include "hamilcar/bench/operations.hpp"

#include "hamilcar/math/counted.hpp"

namespace hamilcar {

namespace {

Input<Counted> counted(const Input<double>& input) {
    return {.rack = {input.rack.displacement, input.rack.rate, input.rack.acceleration},
            .drive_torque = input.drive_torque,
            .brake = input.brake};
}

// The car again, in numbers that count.
struct CountedCar {
    Model<Counted> model;
    State<Counted> state;

    explicit CountedCar(const Simulation& simulation)
        : model{.vehicle = Vehicle<Counted>(simulation.vehicle()),
                .road = PlaneRoad<Counted>(0, 0, 1),
                .chart = simulation.model().chart,
                .constraints = simulation.model().constraints,
                .stabilization_gain = simulation.model().stabilization_gain,
                .energy_balance = simulation.model().energy_balance} {
        for (std::size_t i = 0; i < state.values.size(); ++i) state.values[i] = simulation.state().values[i];
    }
};

}  // namespace

OperationCount operations_of_a_turn(const Simulation& simulation) {
    CountedCar car(simulation);
    const Input<Counted> input = counted(simulation.schedule()(simulation.time()));
    State<Counted> rate;
    Counted::count() = {};
    evaluate(car.model, input, car.state, rate);
    return Counted::count();
}

OperationCount operations_of_a_step(const Simulation& simulation) {
    CountedCar car(simulation);
    const SolverDescription& solver = simulation.scenario().solver;
    Integrator<State<Counted>> integrator(*find_method(solver.integrator), solver.step, car.model.vehicle.state_size);
    const auto input_at = [&](double t) { return counted(simulation.schedule()(t)); };
    for (int warm_up = 0; warm_up < max_adams_order; ++warm_up) {
        integration_block(car.model, integrator, input_at, simulation.time(), car.state);
    }
    Counted::count() = {};
    integration_block(car.model, integrator, input_at, simulation.time(), car.state);
    return Counted::count();
}

}  // namespace hamilcar
