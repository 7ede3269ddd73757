// How evenly steps take their time: what a hard real-time loop has to reckon with.
#pragma once

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct Steadiness {
    double median, late;  // time of a step, and of the slowest one in ten thousand [s]
    double clock;         // what reading the clock takes, included in both [s]
};

Steadiness steadiness(Simulation& simulation, long steps);

}  // namespace hamilcar
