// Finds the batch engine that suits this machine and opens it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/batch/engine.hpp"

namespace hamilcar {

// Instruction sets that engines are built for, the richest first.
inline constexpr std::array<std::string_view, 3> instruction_sets{"x86-64-v4", "x86-64-v3", "x86-64-v2"};

// Those of them that this processor has, the richest first.
std::vector<std::string_view> supported_instruction_sets();

// The engine of an instruction set; of the richest one that the processor has if the name is empty. Opened once and kept.
// Throws std::invalid_argument for a set that is unknown or that the processor lacks, std::runtime_error where the engine
// cannot be opened, with the places that were tried.
const BatchEngine& batch_engine(std::string_view instruction_set = {});

}  // namespace hamilcar
