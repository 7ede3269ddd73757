// What limits the validity of a run, each thing once: where, what, how far and when beyond which limit, why that matters and what
// to do about it. The one list that every front end shows (docs/validity.md).
#pragma once

#include <string>
#include <vector>

namespace hamilcar {

struct ValidityWarning {
    std::string kind;            // for programs: "linear_tire", "energy_balance"; docs/validity.md lists them
    std::string where;           // "front_left.tire"
    std::string quantity, unit;  // "slip angle", "deg"
    double worst = 0, limit = 0;
    double time = 0;          // of the worst value [s]
    double from = 0, to = 0;  // when it was first beyond the limit, and last [s]
    std::string meaning;      // why that matters
    std::string advice;       // what to do about it
    std::string drive;        // of a maneuver; empty for a run

    // Whether it says something of the integration rather than of a model.
    bool is_numerical() const { return kind == "energy_balance" || kind == "step"; }
};

// "front_left.tire: slip angle 9.1 deg at t = 2.31 s (limit 5 deg, beyond it from 2.1 s to 2.5 s): ...; ..."
std::string sentence(const ValidityWarning& warning);
// One for all that say the same of different places, the place that is farthest beyond its limit: "rear_left.tire, farthest of 4
// alike: ...". Pages and JSON have them all.
std::vector<std::string> sentences(const std::vector<ValidityWarning>& warnings);

// Of an account that is off by `error` where `exchanged` was moved, both [J]; nothing where that is explained by the step
// (analysis/energy_bounds.hpp).
std::vector<ValidityWarning> energy_warning(double error, double exchanged, double step, double duration);

// Adds those of a further drive, each place and kind once, with the drive that went farthest beyond the limit.
void add_warnings(std::vector<ValidityWarning> further, const std::string& drive, std::vector<ValidityWarning>& to);

}  // namespace hamilcar
