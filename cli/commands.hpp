// The commands of `hamilcar`. Each has a file with its options, its results and the function here that adds it to the command
// line; messages go to standard error, facts to standard output.
#pragma once

#include "command.hpp"

namespace hamilcar::cli {

using AddCommand = void(CommandList& list);

AddCommand add_new, add_run, add_maneuvers, add_compare, add_study, add_drive, add_view, add_paper, add_bench,
    add_equilibrium, add_kinematics, add_modes, add_check, add_channels, add_tire, add_road, add_program, add_schema,
    add_completion, add_manual;

// In the order of the help.
inline constexpr AddCommand* add_commands[] = {
    add_new,   add_run,   add_maneuvers,   add_compare,    add_study,      add_drive,  add_view,
    add_paper, add_bench, add_equilibrium, add_kinematics, add_modes,      add_check,  add_channels,
    add_tire,  add_road,  add_program,     add_schema,     add_completion, add_manual,
};

}  // namespace hamilcar::cli
