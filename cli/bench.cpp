// `hamilcar bench`: how fast this machine steps a car, alone and in batches, and what accuracy costs.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/bench/bench.hpp"
#include "hamilcar/io/json_text.hpp"

namespace hamilcar::cli {

namespace {

struct BenchOptions {
    VehicleChoice vehicle;
    double seconds = 20;
    bool json = false;
};

std::string_view name(Precision precision) {
    return precision == Precision::double_precision ? "double" : "single";
}
std::string_view name(ConstraintMode mode) {
    return mode == ConstraintMode::exact ? "exact" : "stabilized";
}

nlohmann::json json_of(const OperationCount& count) {
    return {{"additions", count.additions},
            {"multiplications", count.multiplications},
            {"divisions", count.divisions},
            {"roots", count.roots}};
}

nlohmann::json json_of(const BenchReport& report) {
    nlohmann::json cars, batches, trials;
    for (const CarBench& car : report.cars) {
        cars.push_back({{"engine", car.engine},
                        {"step_ns", 1e9 * car.step},
                        {"step_with_balance_ns", 1e9 * car.step_with_balance}});
    }
    for (const BatchBench& batch : report.batches) {
        batches.push_back({{"engine", batch.engine},
                           {"precision", name(batch.precision)},
                           {"threads", batch.threads},
                           {"lanes", batch.lanes},
                           {"step_per_car_ns", 1e9 * batch.step},
                           {"peak_GFLOP_per_s", 1e-9 * batch.peak},
                           {"share_of_peak", batch.share_of_peak},
                           {"speedup", batch.speedup}});
    }
    for (const TrialResult& result : report.trials) {
        trials.push_back({{"integrator", result.trial.integrator},
                          {"step_s", result.trial.step},
                          {"tolerance", result.trial.tolerance},
                          {"constraints", name(result.trial.constraints)},
                          {"path_error_m", result.path_error},
                          {"violation_m", result.violation},
                          {"wall_s", result.wall_time}});
    }
    return {
        {"version", HAMILCAR_VERSION},
        {"vehicle", report.vehicle},
        {"machine",
         {{"processor", report.machine.processor},
          {"threads", report.machine.threads},
          {"engines", report.machine.engines}}},
        {"operations", {{"turn", json_of(report.operations_of_turn)}, {"step", json_of(report.operations_of_step)}}},
        {"one_car", cars},
        {"batch", batches},
        {"description_to_first_step_ms", 1e3 * report.ready},
        {"snapshot_save_and_restore_ns", 1e9 * report.snapshot},
        {"step_jitter",
         {{"median_ns", 1e9 * report.step_jitter.median},
          {"slowest_in_10000_ns", 1e9 * report.step_jitter.late},
          {"slowest_in_10000_alone_ns", 1e9 * report.step_jitter.late_alone},
          {"slowest_in_10000_idle_ns", 1e9 * report.step_jitter.late_idle},
          {"clock_ns", 1e9 * report.step_jitter.clock}}},
        {"work_precision_duration_s", report.trial_duration},
        {"work_precision", trials}};
}

void print_cars(const BenchReport& report) {
    const OperationCount& n = report.operations_of_step;
    fmt::print("\nOne car, a 1 ms step of ab3: {} additions, {} multiplications, {} divisions, {} roots\n", n.additions,
               n.multiplications, n.divisions, n.roots);
    fmt::print("  {:<12}{:>10}{:>16}{:>18}\n", "engine", "step", "with balance", "times real time");
    for (const CarBench& car : report.cars) {
        fmt::print("  {:<12}{:>7.0f} ns{:>13.0f} ns{:>18.0f}\n", car.engine, 1e9 * car.step,
                   1e9 * car.step_with_balance, 1e-3 / car.step);
    }
}

void print_batches(const BenchReport& report) {
    fmt::print("\nMany cars, a car in each lane\n  {:<12}{:<8}{:>6}{:>9}{:>20}{:>16}{:>10}\n", "engine", "numbers",
               "lanes", "threads", "per car and step", "share of peak", "speedup");
    for (const BatchBench& batch : report.batches) {
        fmt::print("  {:<12}{:<8}{:>6}{:>9}{:>17.0f} ns{:>14.0f} %{:>10.2f}\n", batch.engine, name(batch.precision),
                   batch.lanes, batch.threads, 1e9 * batch.step, 100 * batch.share_of_peak, batch.speedup);
    }
}

void print_trials(const BenchReport& report) {
    fmt::print("\nA {:g} s double lane change at 20 m/s: distance from the converged path\n", report.trial_duration);
    fmt::print("  {:<12}{:>10}  {:<12}{:>10}{:>14}{:>14}\n", "integrator", "step", "constraints", "time", "path error",
               "joints open");
    for (const TrialResult& r : report.trials) {
        const std::string step = r.trial.integrator == "dopri5" ? fmt::format("tol {:.0e}", r.trial.tolerance)
                                                                : fmt::format("{:g} ms", 1e3 * r.trial.step);
        const std::string error = std::isfinite(r.path_error) ? fmt::format("{:.1e} m", r.path_error) : "ended early";
        fmt::print("  {:<12}{:>10}  {:<12}{:>7.2f} ms{:>14}{:>12.1e} m\n", r.trial.integrator, step,
                   name(r.trial.constraints), 1e3 * r.wall_time, error, r.violation);
    }
}

void print_report(const BenchReport& report) {
    fmt::print("{} on {}, {} threads\n", report.vehicle, report.machine.processor, report.machine.threads);
    print_cars(report);
    print_batches(report);
    fmt::print("\nReady: from a vehicle's description to its first step in {:.1f} ms\n", 1e3 * report.ready);
    fmt::print("Snapshot: saved and restored in {:.0f} ns\n", 1e9 * report.snapshot);
    const StepJitter& s = report.step_jitter;
    fmt::print(
        "Step jitter: a step takes {:.0f} ns; one in 10 000 more than {:.1f} times that by its own doing, "
        "{:.1f} times with what interrupts it (a loop of nothing: {:.1f} times)\n",
        1e9 * s.median, s.late_alone / s.median, s.late / s.median, s.late_idle / s.median);
    print_trials(report);
}

io::ExitCode bench(const BenchOptions& options) {
    const VehicleDescription vehicle = read_vehicle_or_shipped(options.vehicle);
    const bool terminal = isatty(STDERR_FILENO) != 0;
    const BenchReport report = hamilcar::bench(vehicle, options.seconds, [&](const std::string& part) {
        if (terminal) fmt::print(stderr, "\r\033[K{} ...", part);
    });
    if (terminal) fmt::print(stderr, "\r\033[K");
    if (options.json) {
        fmt::print("{}\n", io::json_text(json_of(report)));
    } else {
        print_report(report);
    }
    return io::ExitCode::ok;
}

}  // namespace

void add_bench(CommandList& list) {
    auto [command, o] =
        list.add<BenchOptions>("bench", "measure how fast this machine steps a car, alone and in batches", bench);
    command.add("vehicle", o.vehicle.file, "another vehicle file than the shipped car's");
    add_vehicle_set(command, o.vehicle);
    command.add("--seconds", o.seconds, {0.1, 3600, "s"}, "about how long to measure");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
