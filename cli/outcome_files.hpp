// What a maneuver leaves: its figures on the screen and in outcome.json, its films, its page.
#pragma once

#include <string>

#include "commands.hpp"
#include "hamilcar/maneuver/outcome_file.hpp"

namespace hamilcar::cli {

// Prints the outcome, then writes it, then its films and its page: what a full disk does not take is what matters less.
// What was driven only in part (`stopped`) is marked so, and does not take the place of a whole drive's outcome.
void tell_and_write(const ManeuverRun& run, const Outcome& outcome, bool stopped, const std::string& folder,
                    const Options& options);

// Whether the outcome.json is marked so; false where it cannot be read.
bool says_interrupted(const std::string& outcome);

}  // namespace hamilcar::cli
