// Outcomes side by side: what each found, how far it is from the first one's, and what each passed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/maneuver/outcome_file.hpp"

namespace hamilcar {

struct Comparison {
    struct Row {
        std::string name, unit, meaning;
        std::vector<double> values;  // of each run; NaN where it did not show it
        double difference(std::size_t run) const { return values[run] - values[0]; }
    };
    struct Judged {
        std::string criterion;
        std::vector<std::optional<bool>> passed;  // by each run; nothing where it has no such criterion
    };
    std::vector<std::string> labels;  // that tell the runs apart: by vehicle, or by what differs
    std::vector<Row> figures;         // all that any of them has, in the order in which they first come
    std::vector<Judged> verdicts;
};

using NamedOutcome = std::pair<ManeuverRun, Outcome>;
Comparison compare(const std::vector<NamedOutcome>& runs);

// One line for each figure and verdict, one column for each run; RFC 4180.
std::string comparison_csv(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison, const std::vector<NamedOutcome>& runs);
// Values, and differences from the first run; percent where they are not from zero.
io::Table values_table(const Comparison& comparison);
io::Table differences_table(const Comparison& comparison);

}  // namespace hamilcar
