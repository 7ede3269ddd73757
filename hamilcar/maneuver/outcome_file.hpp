// An outcome on disk, for programs and for comparisons: everything but the replay, which is a result file beside it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar {

// What was driven by whom, besides what came of it.
struct ManeuverRun {
    std::string maneuver, title, standard;  // of the Maneuver
    std::string vehicle, vehicle_file;
    std::vector<std::string> vehicle_set{};  // keys of the file that had other values, "KEY=VALUE"
    std::vector<std::pair<Setting, double>> settings;
    double step = 0;  // [s]
    std::string integrator;
    std::string program;               // "Hamilcar 0.1.0"
    bool interrupted = false;          // by a person, so that the outcome is that of a part
    std::vector<std::string> files{};  // written: the outcome, its replays, its page
};

nlohmann::ordered_json outcome_json(const ManeuverRun& run, const Outcome& outcome);

// Without replay and course. Throws io::Error(bad_file) for what is no outcome of hamilcar's, input_output for what
// cannot be read.
std::pair<ManeuverRun, Outcome> read_outcome(const std::string& path);

// The page of one maneuver: verdict, figures, its diagrams, the replay with its plots, the settings and the energy.
io::Page outcome_page(const ManeuverRun& run, const Outcome& outcome);

// Several on one page: figures side by side, diagrams of one name laid over each other. The replays are those of all of them.
io::Page comparison_page(std::vector<std::pair<ManeuverRun, Outcome>> runs);

}  // namespace hamilcar
