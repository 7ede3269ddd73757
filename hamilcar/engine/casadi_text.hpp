// A vehicle's right-hand side as C source with the symbols that CasADi looks for in a library (casadi.external): the function and its
// Jacobian.
#pragma once

#include <string>

#include "hamilcar/engine/rhs_trace.hpp"

namespace hamilcar {

// The function `car`: x, the state, and u, as in RhsInput, to the rate of x; and `jac_car`, its Jacobian by both, dense. `trace` is of a single
// vehicle and without calls, which only uneven roads make: throws std::invalid_argument for one with them.
std::string casadi_text(const RhsTrace& trace, int state_size);

}  // namespace hamilcar
