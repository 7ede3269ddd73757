// How evenly steps take their time: what a hard real-time loop has to reckon with.
#pragma once

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// Times of a step [s]; all include a reading of the clock.
struct Steadiness {
    double median;
    double late;  // one step in ten thousand takes longer, whatever interrupted it
    double
        late_by_itself;  // the same of the step's own doing: each is replayed from a snapshot, and its best time counts
    double clock;        // what a reading takes
};

// Steps of a run, as many as fit into blocks of a thousand.
Steadiness steadiness(Simulation& simulation, long steps);

}  // namespace hamilcar
