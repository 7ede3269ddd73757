// The options of `hamilcar run`, of a scenario and of a maneuver.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files.hpp"
#include "hamilcar/description/scenario.hpp"
#include "hamilcar/io/error.hpp"

namespace hamilcar::cli {

struct RunOptions {
    std::string scenario, maneuver;             // one of them
    VehicleChoice vehicle;                      // its file instead of the scenario's
    std::string output;                         // folder
    std::vector<std::string> settings;          // of the maneuver, "speed=80"
    std::vector<std::string> channels;          // of a maneuver's recording
    bool csv = false, no_recording = false;     // of a maneuver
    std::optional<double> interval;             // between rows of its recording, at least [s]
    std::optional<double> step;                 // instead of the scenario's [s]
    std::string checkpoint, resume;             // files
    std::optional<double> checkpoint_interval;  // of simulated time [s]
    bool json = false;
    bool silent = false;  // prints nothing but what goes wrong
};

// As the file of the options says, which has been read and may have been changed since.
io::ExitCode run_scenario(const RunOptions& options, const ScenarioDescription& scenario);

}  // namespace hamilcar::cli
