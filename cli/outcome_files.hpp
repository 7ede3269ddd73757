// What a maneuver leaves: its figures on the screen and in outcome.json, its replays, its page.
#pragma once

#include <string>

#include "hamilcar/maneuver/outcome_file.hpp"

namespace hamilcar::cli {

struct OutcomePlace {
    std::string folder;
    bool json = false;  // printed, in the place of text
    bool csv = false;   // recordings as tables, too
    bool silent = false;
};

// Prints the outcome, then writes it, then its recordings and its page: what a full disk does not take is what matters less.
// What was interrupted does not take the place of a whole drive's outcome.
void print_and_write(ManeuverRun run, const Outcome& outcome, const OutcomePlace& place);

}  // namespace hamilcar::cli
