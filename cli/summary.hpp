// What a run has to say at its end: as JSON, as a table of a page, and for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/analysis/energy_bounds.hpp"
#include "hamilcar/io/page.hpp"
#include "hamilcar/run/record.hpp"

namespace hamilcar::cli {

struct RunReport {
    struct Value {
        std::string name, unit;
        double value;
    };

    std::string scenario, vehicle;
    std::vector<std::string> vehicle_set{};  // keys of its file that had other values, "KEY=VALUE"
    SolverDescription solver;
    double stabilization_gain;  // [1/s]
    RunSummary run;
    Energy<double> energy;           // at the end [J]
    std::vector<Value> end_state;    // of the chassis, sorted by name
    std::vector<std::string> files;  // that were written
    std::optional<std::string> ended_by;
    std::vector<std::string> warnings;

    EnergyVerdict energy_verdict() const { return judge_energy(run.max_balance_error, run.energy_exchanged()); }
};

RunReport report_of(const Simulation& simulation, const RunSummary& run, const std::vector<std::string>& files);

nlohmann::json json_of(const RunReport& report);
// What does not depend on the machine.
io::Table summary_table(const RunReport& report);
void print_summary(const RunReport& report);

}  // namespace hamilcar::cli
