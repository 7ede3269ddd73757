// The engines of this machine: the backends that turn a vehicle's recorded step into something that runs. All give the same bits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/program/executable.hpp"

namespace hamilcar {

using Precision = program::Precision;
using Engine = program::Backend;

// Those that run here, the fastest first; the last, "portable", generates no code and runs everywhere.
const std::vector<const Engine*>& engines();

// Throws std::invalid_argument for a name that is unknown or that this machine does not run, with those that it does.
const Engine& engine(std::string_view name);

// The one that Simulations take: the fastest, unless somebody has chosen. For the start of a program.
const Engine& default_engine();
void choose_default_engine(std::string_view name);  // throws as engine()

// Why engines that generate code are not among them although the processor would run them; empty where they are.
const std::string& refused_engines();

}  // namespace hamilcar
