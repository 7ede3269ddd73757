#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hamilcar/analysis/energy_bounds.hpp"

namespace hamilcar::cli {

namespace {
// JSON has no NaN: null where a run did not keep the number.
nlohmann::json kept(double number) {
    return std::isnan(number) ? nlohmann::json(nullptr) : nlohmann::json(number);
}

// What is printed as zero with so many digits has no sign.
double unsigned_zero(double number, int digits) {
    return std::abs(number) < 0.5 * std::pow(10, -digits) ? 0 : number;
}

// What the run is worth by its energy account.
std::string balance_word(const RunSummary& summary) {
    if (std::isnan(summary.worst_energy_drift)) return "not kept";
    switch (judge_energy(summary.worst_energy_drift, summary.turnover())) {
        case EnergyVerdict::fine: return "closed";
        case EnergyVerdict::doubtful: return "doubtful";
        case EnergyVerdict::wrong: return "wrong";
    }
    return "";
}
}  // namespace

nlohmann::json summary_json(const Simulation& simulation, const RunSummary& summary,
                            const std::vector<std::string>& files) {
    const Sample end = simulation.sample();
    nlohmann::json state;
    for (const Channel& channel : all_channels(simulation.vehicle())) {
        const std::string& name = channel.column.name;
        if (name.starts_with("chassis.position") || name.starts_with("chassis.velocity") ||
            name.starts_with("chassis.angle")) {
            state[name] = {{"value", channel.read(end)}, {"unit", channel.column.unit}};
        }
    }
    const SolverDescription& solver = simulation.scenario().solver;
    const std::optional<std::string> ended_by = simulation.ending();
    nlohmann::json facts = {
        {"scenario", simulation.scenario().name},
        {"vehicle", simulation.vehicle().name},
        {"integrator", solver.integrator},
        {"step_s", solver.step},
        {"constraints", solver.constraints == ConstraintMode::exact ? "exact" : "stabilized"},
        {"stabilization_gain_per_s", simulation.model().stabilization_gain},
        {"simulated_s", summary.duration},
        {"steps", summary.steps},
        {"wall_s", summary.wall_time},
        {"real_time_factor", summary.real_time_factor()},
        {"worst_constraint_opening_m", summary.worst_opening},
        {"energy",
         {{"kinetic_J", end.energy.kinetic},
          {"potential_J", end.energy.potential},
          {"work_J", kept(end.energy.work)},
          {"worst_balance_error_J", kept(summary.worst_energy_drift)},
          {"largest_kinetic_J", summary.largest_kinetic_energy},
          {"turnover_J", summary.turnover()},
          {"balance", balance_word(summary)}}},
        {"end_state", state},
        {"files", files},
        {"ended_early", summary.ended_early ? nlohmann::json(*summary.ended_early) : nlohmann::json(nullptr)},
        {"ended_by", ended_by ? nlohmann::json(*ended_by) : nlohmann::json(nullptr)},
        {"complaints", simulation.complaints()},
        {"interrupted", summary.interrupted},
    };
    return facts;
}

io::Table summary_table(const nlohmann::json& facts) {
    io::Table table{"What the run has to say of itself", {{"", ""}, {"value", ""}, {"unit", ""}}, {}};
    const auto add = [&](const char* name, const nlohmann::json& value, const char* unit) {
        io::Cell cell;
        if (value.is_string()) cell = value.get<std::string>();
        if (value.is_number()) cell = value.get<double>();
        table.rows.push_back({std::string(name), cell, std::string(unit)});
    };
    const auto& energy = facts["energy"];
    add("scenario", facts["scenario"], ""), add("vehicle", facts["vehicle"], "");
    add("integrator", facts["integrator"], ""), add("constraints", facts["constraints"], "");
    add("step", facts["step_s"], "s"), add("simulated", facts["simulated_s"], "s"), add("steps", facts["steps"], "");
    add("largest opening of a cut joint", facts["worst_constraint_opening_m"], "m");
    add("largest kinetic energy", energy["largest_kinetic_J"], "J"), add("work", energy["work_J"], "J");
    add("largest error of the energy balance", energy["worst_balance_error_J"], "J");
    add("energy balance", energy["balance"], "");
    if (!facts["ended_early"].is_null()) add("ended early", facts["ended_early"], "");
    if (!facts["ended_by"].is_null()) add("ended by", facts["ended_by"], "");
    for (const auto& complaint : facts["complaints"]) add("could not be done", complaint, "");
    for (const auto& [name, entry] : facts["end_state"].items()) {
        add(("at the end: " + name).c_str(), entry["value"], entry["unit"].get<std::string>().c_str());
    }
    return table;
}

void print_summary(const nlohmann::json& facts) {
    const auto& energy = facts["energy"];
    const auto value = [&](const char* name, int digits = 3) {
        return unsigned_zero(facts["end_state"][name]["value"].get<double>(), digits);
    };
    fmt::print("{} with {}: {:.6g} s in {} steps of {:g} s ({}, {} constraints)\n",
               facts["scenario"].get<std::string>(), facts["vehicle"].get<std::string>(),
               facts["simulated_s"].get<double>(), facts["steps"].get<long>(), facts["step_s"].get<double>(),
               facts["integrator"].get<std::string>(), facts["constraints"].get<std::string>());
    if (!facts["ended_by"].is_null()) {
        fmt::print("  ended by         {}\n", facts["ended_by"].get<std::string>());
    }
    fmt::print("  end state        x {:.3f}, y {:.3f}, z {:.4f} m\n", value("chassis.position.x"),
               value("chassis.position.y"), value("chassis.position.z", 4));
    const double x = value("chassis.velocity.x"), y = value("chassis.velocity.y"), z = value("chassis.velocity.z");
    fmt::print("                   velocity in ground axes x {:.3f}, y {:.3f}, z {:.3f} m/s; speed {:.3f} m/s\n", x, y,
               z, std::hypot(x, y, z));
    fmt::print("                   roll {:.3f}, pitch {:.3f}, yaw {:.3f} deg\n", value("chassis.angle.roll"),
               value("chassis.angle.pitch"), value("chassis.angle.yaw"));
    fmt::print("  joints           open by {:.2e} m at most\n", facts["worst_constraint_opening_m"].get<double>());
    if (energy["work_J"].is_null()) {
        fmt::print("  energy           kinetic {:.1f} J; no balance kept\n", energy["kinetic_J"].get<double>());
    } else {
        fmt::print("  energy           kinetic {:.1f} J, work {:.1f} J; balance within {:.2e} J\n",
                   energy["kinetic_J"].get<double>(), energy["work_J"].get<double>(),
                   energy["worst_balance_error_J"].get<double>());
    }
    fmt::print("  speed            {:.3f} s, {:.0f} times real time\n", facts["wall_s"].get<double>(),
               facts["real_time_factor"].get<double>());
    for (const auto& file : facts["files"]) fmt::print("  wrote            {}\n", file.get<std::string>());
}

}  // namespace hamilcar::cli
