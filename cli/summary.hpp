// What a run has to say at its end, once as JSON and once for people.
#pragma once

#include <nlohmann/json.hpp>

#include "hamilcar/io/page.hpp"
#include "hamilcar/run/record.hpp"

namespace hamilcar::cli {

nlohmann::json summary_json(const Simulation& simulation, const RunSummary& summary,
                            const std::vector<std::string>& files);
// Those of the facts that do not depend on the machine, as a table of a page.
io::Table summary_table(const nlohmann::json& facts);
void print_summary(const nlohmann::json& facts);

}  // namespace hamilcar::cli
