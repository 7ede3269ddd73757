#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hamilcar/run/validity_report.hpp"

namespace hamilcar::cli {

namespace {

// JSON has no NaN: null where a run did not keep the number.
nlohmann::json kept(double number) {
    return std::isnan(number) ? nlohmann::json(nullptr) : nlohmann::json(number);
}

nlohmann::json or_null(const std::optional<std::string>& text) {
    return text ? nlohmann::json(*text) : nlohmann::json(nullptr);
}

const char* constraints_word(const RunReport& report) {
    return report.solver.constraints == ConstraintMode::exact ? "exact" : "stabilized";
}

// What the run is worth by its energy balance.
const char* balance_word(const RunReport& report) {
    if (std::isnan(report.run.max_balance_error)) return "not kept";
    switch (report.energy_verdict()) {
        case EnergyVerdict::fine: return "closed";
        case EnergyVerdict::doubtful: return "doubtful";
        case EnergyVerdict::wrong: return "wrong";
    }
    return "";
}

}  // namespace

RunReport report_of(const Simulation& simulation, const RunSummary& run, const std::vector<std::string>& files) {
    const Sample end = simulation.sample();
    RunReport report{.scenario = simulation.scenario().name,
                     .vehicle = simulation.vehicle().name,
                     .solver = simulation.scenario().solver,
                     .stabilization_gain = simulation.model().stabilization_gain,
                     .run = run,
                     .energy = end.energy,
                     .end_state = {},
                     .files = files,
                     .ended_by = simulation.ending(),
                     .warnings = simulation.warnings()};
    for (const Channel& channel : all_channels(simulation.vehicle())) {
        const std::string& name = channel.column.name;
        if (name.starts_with("chassis.position") || name.starts_with("chassis.velocity") ||
            name.starts_with("chassis.angle")) {
            report.end_state.push_back({name, channel.column.unit, channel.read(end)});
        }
    }
    std::ranges::sort(report.end_state, {}, &RunReport::Value::name);
    return report;
}

nlohmann::json json_of(const RunReport& report) {
    nlohmann::json state;
    for (const RunReport::Value& v : report.end_state) state[v.name] = {{"value", v.value}, {"unit", v.unit}};
    return {
        {"scenario", report.scenario},
        {"vehicle", report.vehicle},
        {"vehicle_set", report.vehicle_set},
        {"integrator", report.solver.integrator},
        {"step_s", report.solver.step},
        {"constraints", constraints_word(report)},
        {"stabilization_gain_per_s", report.stabilization_gain},
        {"simulated_s", report.run.duration},
        {"steps", report.run.steps},
        {"wall_s", report.run.wall_time},
        {"real_time_factor", report.run.real_time_factor()},
        {"max_constraint_violation_m", report.run.max_violation},
        {"energy",
         {{"kinetic_J", report.energy.kinetic},
          {"potential_J", report.energy.potential},
          {"work_J", kept(report.energy.work)},
          {"max_balance_error_J", kept(report.run.max_balance_error)},
          {"max_kinetic_J", report.run.max_kinetic_energy},
          {"exchanged_J", report.run.energy_exchanged()},
          {"balance", balance_word(report)}}},
        {"end_state", state},
        {"files", report.files},
        {"ended_early", or_null(report.run.ended_early)},
        {"ended_by", or_null(report.ended_by)},
        {"warnings", report.warnings},
        {"validity", validity_json(report.run.validity)},
        {"interrupted", report.run.interrupted},
    };
}

io::Table summary_table(const RunReport& report) {
    io::Table table{"Summary of the run", {{"", ""}, {"value", ""}, {"unit", ""}}, {}};
    const auto add = [&](const std::string& name, const io::Cell& value, const std::string& unit = "") {
        const auto* number = std::get_if<double>(&value);
        table.rows.push_back({name, number && std::isnan(*number) ? io::Cell() : value, unit});
    };
    add("scenario", report.scenario), add("vehicle", report.vehicle);
    for (const std::string& assignment : report.vehicle_set) add("vehicle with", assignment);
    add("integrator", report.solver.integrator), add("constraints", std::string(constraints_word(report)));
    add("step", report.solver.step, "s"), add("simulated", report.run.duration, "s");
    add("steps", double(report.run.steps));
    add("largest violation of a cut joint", report.run.max_violation, "m");
    add("largest kinetic energy", report.run.max_kinetic_energy, "J"), add("work", report.energy.work, "J");
    add("largest error of the energy balance", report.run.max_balance_error, "J");
    add("energy balance", std::string(balance_word(report)));
    if (report.run.ended_early) add("ended early", *report.run.ended_early);
    if (report.ended_by) add("ended by", *report.ended_by);
    for (const std::string& warning : report.warnings) add("driver warning", warning);
    for (const RunReport::Value& v : report.end_state) add("at the end: " + v.name, v.value, v.unit);
    return table;
}

void print_summary(const RunReport& report) {
    // What is printed as zero with so many digits has no sign.
    const auto value = [&](const char* name, int digits = 3) {
        const double number = std::ranges::find(report.end_state, name, &RunReport::Value::name)->value;
        return std::abs(number) < 0.5 * std::pow(10, -digits) ? 0 : number;
    };
    fmt::print("{} with {}: {:.6g} s in {} steps of {:g} s ({}, {} constraints)\n", report.scenario, report.vehicle,
               report.run.duration, report.run.steps, report.solver.step, report.solver.integrator,
               constraints_word(report));
    for (const std::string& assignment : report.vehicle_set) fmt::print("  vehicle with     {}\n", assignment);
    if (report.ended_by) fmt::print("  ended by         {}\n", *report.ended_by);
    fmt::print("  end state        x {:.3f}, y {:.3f}, z {:.4f} m\n", value("chassis.position.x"),
               value("chassis.position.y"), value("chassis.position.z", 4));
    const double x = value("chassis.velocity.x"), y = value("chassis.velocity.y"), z = value("chassis.velocity.z");
    fmt::print("                   velocity in ground axes x {:.3f}, y {:.3f}, z {:.3f} m/s; speed {:.3f} m/s\n", x, y,
               z, std::hypot(x, y, z));
    fmt::print("                   roll {:.3f}, pitch {:.3f}, yaw {:.3f} deg\n", value("chassis.angle.roll"),
               value("chassis.angle.pitch"), value("chassis.angle.yaw"));
    fmt::print("  joints           open by {:.2e} m at most\n", report.run.max_violation);
    if (std::isnan(report.energy.work)) {
        fmt::print("  energy           kinetic {:.1f} J; no balance kept\n", report.energy.kinetic);
    } else {
        fmt::print("  energy           kinetic {:.1f} J, work {:.1f} J; balance within {:.2e} J\n",
                   report.energy.kinetic, report.energy.work, report.run.max_balance_error);
    }
    fmt::print("  speed            {:.3f} s, {:.0f} times real time\n", report.run.wall_time,
               report.run.real_time_factor());
    for (const std::string& line : sentences(report.run.validity)) fmt::print("  validity         {}\n", line);
    for (const std::string& file : report.files) fmt::print("  wrote            {}\n", file);
}

}  // namespace hamilcar::cli
