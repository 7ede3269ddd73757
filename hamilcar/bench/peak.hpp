// What a core can do at most, to measure steps by.
#pragma once

#include "hamilcar/engine/engines.hpp"

namespace hamilcar {

// Does nothing but multiply and add with the instructions of an engine, fused where the processor can, as many at once as hide the
// latency of one. Returns how many additions and multiplications it did in that many rounds.
double multiply_and_add(const Engine& engine, Precision precision, long rounds);

}  // namespace hamilcar
