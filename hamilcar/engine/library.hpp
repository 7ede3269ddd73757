// Finds the engine that suits this machine and opens it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "hamilcar/engine/engine.hpp"

namespace hamilcar {

// Instruction sets that engines are built for, the richest first; "baseline" is the library's own, which needs no file.
inline constexpr std::array<std::string_view, 4> instruction_sets{"x86-64-v4", "x86-64-v3", "x86-64-v2", "baseline"};

// Those of them that were built and that this processor has, the richest first.
std::vector<std::string_view> supported_instruction_sets();

// The engine of an instruction set, opened once and kept. Throws std::invalid_argument for a set that is unknown or that
// the processor lacks, std::runtime_error where the engine cannot be opened, with the places that were tried.
const Engine& engine(std::string_view instruction_set);

// Those that the processor has and that can be opened, the richest first; all give the same bits.
const std::vector<const Engine*>& engines();
inline const Engine& best_engine() {
    return *engines().front();
}

}  // namespace hamilcar
