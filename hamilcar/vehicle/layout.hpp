// How many numbers a state holds, and for what.
#pragma once

#include "hamilcar/suspension/list.hpp"

namespace hamilcar {

inline constexpr int hub_size = 14;
inline constexpr int spoke_size = 2 * max_independent + max_dependent + 4;  // of a corner with a program of its own
inline constexpr int composed_capacity = 640;                               // for composed suspensions and trailers
inline constexpr int state_capacity = hub_size + max_spokes * spoke_size + composed_capacity;

}  // namespace hamilcar
