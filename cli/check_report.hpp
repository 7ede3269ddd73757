// What `hamilcar check` finds out about a vehicle, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/analysis/freedom.hpp"
#include "hamilcar/analysis/plausibility.hpp"
#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/io/results.hpp"

namespace hamilcar::cli {

// One suspension: its structure, its loops where the vehicle stands, and what its wheels bear.
struct SuspensionReport {
    SuspensionStructure structure;
    LoopReport loops;
    std::vector<double> static_load;  // wheel by wheel [N]
};

// The paper's way of counting, which has one body a suspension.
struct Table2 {
    std::vector<ConstraintRow> rows;
    int coordinates = 0, constraints = 0;
};

struct CheckReport {
    std::string file, vehicle;
    VehicleFigures figures;
    std::vector<Oddity> oddities;
    Structure counted;
    std::vector<SuspensionReport> suspensions;
    std::optional<Table2> table_2;   // none of a vehicle of other shape
    std::vector<std::string> notes;  // what the tire files leave open, each file's once
    std::vector<io::Column> channels;
};

std::string sentence(const Oddity& oddity);
// `structure`: joints, coordinates and degrees of freedom as well.
std::string text_of(const CheckReport& report, bool structure);
nlohmann::json json_of(const CheckReport& report);

}  // namespace hamilcar::cli
