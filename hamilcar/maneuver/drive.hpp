// One drive of a maneuver: a scenario with its driver, run from start to end, and what was recorded on the way.
#pragma once

#include "hamilcar/maneuver/maneuver.hpp"
#include "hamilcar/run/channel_names.hpp"
#include "hamilcar/run/recording.hpp"

namespace hamilcar {

// A part of the maneuver's progress, 0 to 1.
struct Share {
    double from = 0, to = 1;
};

struct DriveOptions {
    double interval = 0.005;             // between two rows, a multiple of the step [s]
    Share share = {};                    // of the maneuver's progress
    bool replay = true;                  // keep rows for a page, if the maneuver is to keep any
    double replay_interval = 0;          // between these at least [s]
    bool seat_acceleration = false;      // its channels too; they cost as much as a step each row
    bool retry_with_finer_step = false;  // where the mathematics gave up: a quarter of the step, which a warning tells
};

struct Drive {
    std::string name;  // of its scenario
    Recording recording;
    Stopped stopped = Stopped::no;     // why the car could not go on
    std::string trouble;               // the same in words; empty where nothing stopped it
    std::optional<std::string> ended;  // what the driver's ending was, if it came before the time was up
    std::vector<std::string>
        warnings;  // what the driver could not do: a speed that was not reached, a path that was left
    EnergyBalance energy;
    std::vector<ValidityWarning> validity;  // where models were used beyond their ranges
    io::PageRun replay;                     // empty unless asked for

    // The whole maneuver is over, whatever this drive was for: a linkage whose loops opened is no limit of the vehicle.
    bool breaks_off() const { return stopped == Stopped::interrupted || stopped == Stopped::numerical; }
};

// Runs the scenario. A drive whose energy account is wrong counts as one whose mathematics gave up. Throws as Simulation does;
// where the scenario asks for more steering than the vehicle has, io::Error(numerical).
Drive drive(const VehicleDescription& vehicle, const ScenarioDescription& scenario, const DriveOptions& options = {},
            const ManeuverOptions& maneuver = {.keep_runs = false});

}  // namespace hamilcar
