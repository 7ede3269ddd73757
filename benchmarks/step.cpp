// The shipped car, cornering at 20 m/s: one right-hand side, one 1 ms step of third-order Adams-Bashforth, the whole
// 15 s of the paper's case, and a peer in two forms. Counters: floating-point operations of one evaluation, counted by
// a counting scalar.
#include <benchmark/benchmark.h>

#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/math/counted.hpp"
#include "hamilcar/run/simulation.hpp"
#ifdef HAMILCAR_WITH_SIMBODY
#include "oracle/simbody_car.hpp"
#endif

namespace {

using namespace hamilcar;

std::string source(const char* path) {
    return std::string(HAMILCAR_SOURCE_DIR "/") + path;
}

// Half a second into a bend.
Simulation cornering() {
    ScenarioDescription scenario;
    scenario.duration = 1e6;
    scenario.initial.velocity = {20, 0, 0};
    scenario.drive = {{0}, {250}, Interpolation::smooth};
    scenario.steering_input = SteeringInput::rack;
    scenario.steering = {{0, 0.5}, {0, 0.003}, Interpolation::smooth};
    Simulation simulation(io::read_vehicle(source("vehicles/bmw_323i.toml")), scenario);
    while (simulation.time() < 0.5) simulation.advance();
    return simulation;
}

OperationCount count_operations() {
    const Simulation simulation = cornering();
    const Model<Counted> model{.vehicle = Vehicle<Counted>(simulation.vehicle()), .road = PlaneRoad<Counted>(0, 0, 1)};
    State<Counted> state, rate;
    for (std::size_t i = 0; i < state.values.size(); ++i) state.values[i] = simulation.state().values[i];
    const Input<double> now = simulation.schedule()(simulation.time());
    Input<Counted> input;
    input.rack = {now.rack.displacement, now.rack.rate, now.rack.acceleration};
    input.drive_torque = now.drive_torque;
    Counted::count() = {};
    evaluate(model, input, state, rate);
    return Counted::count();
}

void right_hand_side(benchmark::State& run) {
    const Simulation simulation = cornering();
    const Input<double> input = simulation.schedule()(simulation.time());
    const State<double> state = simulation.state();
    State<double> rate;
    for (auto _ : run) {
        evaluate(simulation.model(), input, state, rate);
        benchmark::DoNotOptimize(rate.values.data());
        benchmark::ClobberMemory();
    }
    const OperationCount count = count_operations();
    run.counters["add"] = static_cast<double>(count.additions);
    run.counters["mul"] = static_cast<double>(count.multiplications);
    run.counters["div"] = static_cast<double>(count.divisions);
    run.counters["sqrt"] = static_cast<double>(count.roots);
    run.counters["GFLOP/s"] =
        benchmark::Counter(1e-9 * static_cast<double>(count.total()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(right_hand_side);

void step_of_1_ms(benchmark::State& run) {
    Simulation simulation = cornering();
    for (auto _ : run) benchmark::DoNotOptimize(simulation.advance());
}
BENCHMARK(step_of_1_ms);

void paper_case_15_s(benchmark::State& run) {
    const ScenarioDescription scenario = io::read_scenario(source("scenarios/paper.toml"));
    const VehicleDescription vehicle = io::read_vehicle(scenario.vehicle);
    for (auto _ : run) {
        Simulation simulation(vehicle, scenario);
        while (!simulation.finished()) simulation.advance();
        benchmark::DoNotOptimize(simulation.state().values.data());
    }
    run.counters["times real time"] =
        benchmark::Counter(scenario.duration, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(paper_case_15_s)->Unit(benchmark::kMillisecond);

#ifdef HAMILCAR_WITH_SIMBODY
void evaluate_in_simbody(benchmark::State& run, oracle::SpindleModel spindle_model) {
    oracle::SimbodyCar car(io::read_vehicle(source("vehicles/bmw_323i.toml")), {}, spindle_model);
    for (auto _ : run) benchmark::DoNotOptimize(car.evaluate_accelerations_once({.rack = 0.003, .drive_torque = 250}));
}

void simbody_acceleration_evaluation(benchmark::State& run) {
    evaluate_in_simbody(run, oracle::SpindleModel::strut);
}
BENCHMARK(simbody_acceleration_evaluation);

void simbody_acceleration_evaluation_one_constraint(benchmark::State& run) {
    evaluate_in_simbody(run, oracle::SpindleModel::strut_one_constraint);
}
BENCHMARK(simbody_acceleration_evaluation_one_constraint);
#endif

}  // namespace

BENCHMARK_MAIN();
