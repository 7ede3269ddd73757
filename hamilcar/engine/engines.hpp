// The engines of this machine: the backends that compile or interpret a vehicle's recorded step. All give the same bits.
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

// Throws std::invalid_argument, with a list of the supported engines, for a name that is unknown or not supported here.
const Engine& engine(std::string_view name);

// The engine that Simulations use: the fastest, unless another was chosen, which is meant for the start of a program.
const Engine& default_engine();
void choose_default_engine(std::string_view name);  // throws as engine()

// Why engines that generate code are missing although the processor supports them; empty if none is missing.
const std::string& refused_engines();

}  // namespace hamilcar
