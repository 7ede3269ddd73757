// How evenly steps take their time: what a hard real-time loop has to reckon with.
#pragma once

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// Times of a step [s], a reading of the clock included; `late` ones are exceeded by one step in ten thousand.
struct StepJitter {
    double median;
    double late;        // whatever interrupted it
    double late_alone;  // of the step's own doing: each is replayed from a snapshot, and its best time counts
    double late_idle;   // of a loop that only waits as long: what the machine interrupts by itself
    double clock;       // of a reading of the clock alone
};

// Steps of a run, as many as fit into blocks of a thousand.
StepJitter step_jitter(Simulation& simulation, long steps);

}  // namespace hamilcar
