// The stabilization gain alpha that a method and a step allow: the paper's (35) and (36).
#pragma once

#include <string>

#include "hamilcar/description/scenario.hpp"
#include "hamilcar/integrator/methods.hpp"

namespace hamilcar {

struct GainChoice {
    double gain = 0;          // alpha [1/s]; zero in exact mode
    std::string expectation;  // empty, or what is required instead, as a phrase after "expected"
};

// For a solver whose integrator is known. Exact mode needs no gain.
GainChoice stabilization_gain(const SolverDescription& solver);

}  // namespace hamilcar
