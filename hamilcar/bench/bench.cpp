#include "hamilcar/bench/bench.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/bench/interleave.hpp"
#include "hamilcar/bench/peak.hpp"
#include "hamilcar/bench/scenes.hpp"

namespace hamilcar {

namespace {

constexpr int rounds = 9;

Machine this_machine() {
    Machine machine{"unknown processor", static_cast<int>(std::thread::hardware_concurrency()), {}};
    for (const Engine* own : engines()) machine.engines.push_back(own->name);
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const auto colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            machine.processor = line.substr(colon + 2);
            break;
        }
    }
    return machine;
}

std::vector<CarBench> bench_cars(const Simulation& simulation, double turn) {
    std::vector<EngineCar> cars;
    for (const Engine* own : engines()) {
        for (const bool balance : {false, true}) cars.emplace_back(*own, simulation, balance);
    }
    std::vector<BenchmarkCase> cases;
    for (EngineCar& car : cars) cases.push_back({"", [&car](long steps) { car.advance(steps); }});
    const InterleavedTimes result = interleave(cases, turn, rounds);
    std::vector<CarBench> out;
    for (std::size_t i = 0; i < engines().size(); ++i) {
        out.push_back({engines()[i]->name, result.time(2 * i), result.time(2 * i + 1)});
    }
    return out;
}

// All cars of a batch by one step are one item.
std::vector<BatchBench> bench_batches(const VehicleDescription& vehicle, double operations, int threads, double turn) {
    int most_lanes = 1;
    for (const Engine* own : engines()) most_lanes = std::max(most_lanes, own->lanes(Precision::single_precision));
    const auto simulations = fleet(vehicle, 2 * most_lanes * threads);
    std::vector<const Simulation*> cars;
    for (const auto& simulation : simulations) cars.push_back(simulation.get());

    std::vector<BatchBench> out;
    for (const Engine* engine : engines()) {
        for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
            const std::string name(engine->name);
            Batch alone(cars, {.threads = 1, .precision = precision, .engine = name});
            Batch together(cars, {.threads = threads, .precision = precision, .engine = name});
            const Engine& own = *engine;
            const double per_round = multiply_and_add(own, precision, 1);
            std::vector<BenchmarkCase> cases{{"alone", [&](long steps) { alone.advance(steps); }},
                                             {"together", [&](long steps) { together.advance(steps); }},
                                             {"peak", [&](long times) { multiply_and_add(own, precision, times); }}};
            const InterleavedTimes result = interleave(cases, turn, rounds);
            const double work = operations * static_cast<double>(cars.size()) / per_round;  // in rounds of the peak's
            const double speedup = result.ratio(0, 1), share = work / result.ratio(0, 2);
            const double peak = per_round / result.time(2), count = static_cast<double>(cars.size());
            out.push_back({own.name, precision, 1, own.lanes(precision), result.time(0) / count, peak, share, 1});
            if (threads > 1) {
                out.push_back({own.name, precision, threads, own.lanes(precision), result.time(1) / count,
                               peak * threads, share * speedup / threads, speedup});
            }
        }
    }
    return out;
}

// Without the programs that are kept.
double bench_ready(const VehicleDescription& vehicle) {
    std::vector<double> times;
    for (int i = 0; i < rounds; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const Simulation simulation(vehicle, bend());
        default_engine().compile(rhs_trace_without_dead_code(simulation.model()).graph, false);
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return median(std::move(times));
}

double bench_snapshot(const Simulation& simulation, double turn) {
    Simulation copy = simulation;
    Snapshot snapshot;
    return interleave({{"",
                        [&](long times) {
                            for (long i = 0; i < times; ++i) copy.save(snapshot), copy.restore(snapshot);
                        }}},
                      turn, rounds)
        .time(0);
}

}  // namespace

BenchReport bench(const VehicleDescription& vehicle, double seconds,
                  const std::function<void(const std::string&)>& progress) {
    BenchReport report;
    report.vehicle = vehicle.name;
    report.machine = this_machine();
    Simulation simulation = cornering(vehicle, bend());
    report.operations_of_turn = operations_of_rhs(simulation);
    report.operations_of_step = operations_of_a_step(simulation);
    const double turn = seconds / 1000;  // there are about 400 turns, and the rest takes as long

    progress("one car");
    report.cars = bench_cars(simulation, turn);
    progress("many cars");
    report.batches = bench_batches(vehicle, static_cast<double>(report.operations_of_step.total()),
                                   std::min(2, report.machine.threads), turn);
    progress("snapshots and step_jitter");
    report.ready = bench_ready(vehicle);
    report.snapshot = bench_snapshot(simulation, turn);
    report.step_jitter = step_jitter(simulation, static_cast<long>(seconds * 5e4));
    progress("work against precision");
    ScenarioDescription scenario = lane_change();
    scenario.duration = report.trial_duration = std::clamp(std::round(seconds), 2.0, scenario.duration);
    const Trace reference = reference_path(vehicle, scenario);
    for (const AccuracyTrial& trial : default_trials()) {
        report.trials.push_back(run_trial(vehicle, scenario, trial, reference, seconds < 5 ? 1 : 3));
    }
    return report;
}

}  // namespace hamilcar
