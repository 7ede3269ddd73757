// The shipped car beside the same car in Simbody and MuJoCo: first what a step costs, in one interleave on one core; then work
// against precision over a 15 s double lane change. With --json the same as one JSON object.
#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/accuracy.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/bench/interleave.hpp"
#include "hamilcar/bench/scenes.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "oracle/hand_over.hpp"
#include "oracle/mujoco_car.hpp"

namespace {

using namespace hamilcar;

constexpr double turn = 0.02;  // [s]
constexpr int rounds = 25;
constexpr oracle::Inputs in_the_bend{.rack = 0.003, .drive_torque = 250};

BenchmarkCase stepping(const Engine& own, const Simulation& start) {
    const auto car = std::make_shared<EngineCar>(own, start);
    return {fmt::format("one car, {}", own.name), [car](long steps) { car->advance(steps); }};
}

// The same as a user runs it, by the best engine: with the checks after each step and the last good state kept.
BenchmarkCase running(const Simulation& start) {
    const auto simulation = std::make_shared<Simulation>(start);
    return {"one car, a run's step", [simulation](long steps) {
                for (long i = 0; i < steps; ++i) simulation->advance();
            }};
}

// Cars of a batch on one thread; an item is one step of all.
BenchmarkCase stepping_many(std::string_view set, Precision precision, const std::vector<const Simulation*>& cars) {
    const auto batch =
        std::make_shared<Batch>(cars, BatchOptions{.threads = 1, .precision = precision, .engine = std::string(set)});
    return {fmt::format("batch, {}, {}", set, precision == Precision::double_precision ? "double" : "single"),
            [batch](long steps) { batch->advance(steps); }};
}

// One evaluation of accelerations, which every method needs at least once a step.
BenchmarkCase simbody(const VehicleDescription& vehicle, oracle::SpindleModel model, std::string name) {
    const auto car = std::make_shared<oracle::SimbodyCar>(vehicle, oracle::Road{}, model);
    return {std::move(name), [car](long times) {
                for (long i = 0; i < times; ++i) car->evaluate_accelerations_once(in_the_bend);
            }};
}

BenchmarkCase mujoco(const VehicleDescription& vehicle, oracle::MujocoIntegrator integrator, std::string name,
                     const Simulation& start) {
    const auto loops = oracle::MujocoLoops::stiffest(integrator, 1e-3);
    const auto car =
        std::make_shared<oracle::MujocoCar>(vehicle, oracle::Road{}, oracle::MujocoOptions{integrator, 1e-3, loops});
    car->set_inputs(in_the_bend);
    car->set_state(oracle::state_of(start));
    return {std::move(name),
            [car](long steps) { car->advance(0, static_cast<int>(steps), [](double) { return in_the_bend; }); }};
}

nlohmann::json race_of_steps(const VehicleDescription& vehicle) {
    const Simulation start = cornering(vehicle, bend());
    const auto simulations = fleet(vehicle, 64);
    std::vector<const Simulation*> cars;
    for (const auto& simulation : simulations) cars.push_back(simulation.get());

    std::vector<BenchmarkCase> cases{
        simbody(vehicle, oracle::SpindleModel::strut, "Simbody, one evaluation"),
        simbody(vehicle, oracle::SpindleModel::strut_one_constraint, "Simbody, the same with one constraint"),
        mujoco(vehicle, oracle::MujocoIntegrator::euler, "MuJoCo, a 1 ms step of Euler", start),
        mujoco(vehicle, oracle::MujocoIntegrator::rk4, "MuJoCo, a 1 ms step of RK4", start)};
    cases.push_back(running(start));
    std::vector<double> cars_of(cases.size(), 1);
    for (const Engine* own : engines()) {
        cases.push_back(stepping(*own, start));
        cars_of.push_back(1);
    }
    for (const Engine* own : engines()) {
        for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
            cases.push_back(stepping_many(own->name, precision, cars));
            cars_of.push_back(static_cast<double>(cars.size()));
        }
    }
    const InterleavedTimes result = interleave(cases, turn, rounds);
    nlohmann::json rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        rows.push_back({{"name", cases[i].name},
                        {"time_ns", 1e9 * result.time(i) / cars_of[i]},
                        {"simbody_evaluations", result.ratio(0, i) * cars_of[i]},
                        {"mujoco_euler_steps", result.ratio(2, i) * cars_of[i]}});
    }
    return rows;
}

// Runs a peer over the scenario; `advance(t)` takes it from t one path interval on.
template <class Car, class Advance, class Violation>
nlohmann::json peer_trial(std::string name, double step, const Simulation& start, const Trace& reference, Car& car,
                          const Advance& advance, const Violation& violation) {
    const auto inputs = oracle::inputs_of(start);
    car.set_inputs(inputs(0));
    car.set_state(oracle::state_of(start));
    Trace path{start.state().position()};
    double open = 0;
    const auto began = std::chrono::steady_clock::now();
    try {
        while (path.size() < reference.size()) {
            advance(static_cast<double>(path.size() - 1) * path_interval, inputs);
            path.push_back(Vec3<double>(car.state().position.data()));
            open = std::max(open, violation());
        }
    } catch (const std::exception&) {
        path.clear();  // the motion was lost: no path, an infinite error
    }
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const double error = path_error(path, reference);
    return {{"name", std::move(name)},
            {"step_s", step},
            {"path_error_m", std::isfinite(error) ? nlohmann::json(error) : nlohmann::json(nullptr)},
            {"violation_m", open},
            {"wall_s", wall}};
}

nlohmann::json peers_precision(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                               const Trace& reference) {
    const Simulation start(vehicle, scenario);
    nlohmann::json rows;
    for (const double step : {5e-3, 2e-3, 1e-3}) {
        oracle::SimbodyCar car(vehicle, {}, oracle::SpindleModel::strut);
        rows.push_back(peer_trial(
            "Simbody, RK4", step, start, reference, car,
            [&](double t, const auto& inputs) {
                car.advance(t, step, static_cast<int>(std::lround(path_interval / step)), inputs);
            },
            [&] { return car.worst_constraint_error(); }));
    }
    using oracle::MujocoIntegrator;
    for (const auto& [integrator, name, step] : {std::tuple{MujocoIntegrator::euler, "MuJoCo, Euler", 2e-3},
                                                 std::tuple{MujocoIntegrator::euler, "MuJoCo, Euler", 1e-3},
                                                 std::tuple{MujocoIntegrator::euler, "MuJoCo, Euler", 2.5e-4},
                                                 std::tuple{MujocoIntegrator::rk4, "MuJoCo, RK4", 5e-3},
                                                 std::tuple{MujocoIntegrator::rk4, "MuJoCo, RK4", 2e-3},
                                                 std::tuple{MujocoIntegrator::rk4, "MuJoCo, RK4", 1e-3}}) {
        oracle::MujocoCar car(vehicle, {}, {integrator, step, oracle::MujocoLoops::stiffest(integrator, step)});
        rows.push_back(peer_trial(
            name, step, start, reference, car,
            [&, step = step](double t, const auto& inputs) {
                car.advance(t, static_cast<int>(std::lround(path_interval / step)), inputs);
            },
            [&] { return car.worst_loop_opening(); }));
    }
    return rows;
}

nlohmann::json own_precision(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                             const Trace& reference) {
    nlohmann::json rows;
    for (const AccuracyTrial& trial : default_trials()) {
        const TrialResult r = run_trial(vehicle, scenario, trial, reference, 3);
        const bool exact = trial.constraints == ConstraintMode::exact;
        const std::string tolerance = trial.integrator == "dopri5" ? fmt::format(" {:.0e}", trial.tolerance) : "";
        rows.push_back(
            {{"name", fmt::format("Hamilcar, {}{}, {}", trial.integrator, tolerance, exact ? "exact" : "stabilized")},
             {"step_s", trial.step},
             {"path_error_m", std::isfinite(r.path_error) ? nlohmann::json(r.path_error) : nlohmann::json(nullptr)},
             {"violation_m", r.violation},
             {"wall_s", r.wall_time}});
    }
    return rows;
}

void print(const nlohmann::json& facts) {
    fmt::print("{:<42}{:>12}{:>22}{:>22}\n", "a step, per car", "", "Simbody evaluations", "MuJoCo Euler steps");
    for (const auto& row : facts["interleave"]) {
        fmt::print("{:<42}{:>9.0f} ns{:>20.1f} x{:>20.1f} x\n", row["name"].get<std::string>(),
                   row["time_ns"].get<double>(), row["simbody_evaluations"].get<double>(),
                   row["mujoco_euler_steps"].get<double>());
    }
    fmt::print("\n{:<42}{:>10}{:>14}{:>14}{:>16}\n", "a 15 s double lane change", "step", "time", "path error",
               "joints open");
    for (const auto& row : facts["work_precision"]) {
        const auto& error = row["path_error_m"];
        fmt::print("{:<42}{:>7g} ms{:>11.2f} ms{:>14}{:>14.1e} m\n", row["name"].get<std::string>(),
                   1e3 * row["step_s"].get<double>(), 1e3 * row["wall_s"].get<double>(),
                   error.is_null() ? "lost" : fmt::format("{:.1e} m", error.get<double>()),
                   row["violation_m"].get<double>());
    }
}

}  // namespace

int main(int argc, char** argv) {
    const VehicleDescription vehicle = io::read_vehicle(HAMILCAR_SOURCE_DIR "/vehicles/bmw_323i_paper.toml");
    nlohmann::json facts;
    facts["interleave"] = race_of_steps(vehicle);
    const ScenarioDescription scenario = lane_change();
    const Trace reference = reference_path(vehicle, scenario);
    facts["work_precision"] = own_precision(vehicle, scenario, reference);
    for (auto& row : peers_precision(vehicle, scenario, reference)) facts["work_precision"].push_back(row);
    if (argc > 1 && std::strcmp(argv[1], "--json") == 0) {
        fmt::print("{}\n", facts.dump(2));
    } else {
        print(facts);
    }
}
