// The kinematics of an axle for files: tables, charts and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hamilcar/analysis/kinematics.hpp"
#include "hamilcar/io/page.hpp"

namespace hamilcar::cli {

// Every figure of every row, as CSV.
std::string table_of(const Sweep& sweep);

// The left wheel over bump, or both where they differ; both over roll and steer.
std::vector<io::Chart> charts(const AxleReport& axle);

nlohmann::json json_of(const AxleReport& axle);

// At design, what there is.
io::Table design_table(const AxleReport& axle);

}  // namespace hamilcar::cli
