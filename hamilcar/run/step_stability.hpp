// The step of a run against the stability limit of its method: the motions of the whole vehicle about an instant, from the
// differences of its right-hand side, and by what the method multiplies each of them in a step.
//
// Dependent coordinates follow the independent ones; the work and the energy supplied, which nothing depends on, are left out.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "hamilcar/integrator/stability.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct StepLimit {
    double stable_step = 0;       // the longest up to the run's own with which nothing grows that decays by itself [s]
    std::complex<double> lambda;  // of the motion that grows most with the run's own step [1/s]
    int number = 0;               // of the state, the one that takes part in it most
};

// Looks at the start, and again whenever the speed or the force of the stops has doubled, where a vehicle is stiffest: a handful of
// times in a run. Once the step is beyond the limit it looks no more, since what comes then is no motion of the vehicle.
class StepStability {
public:
    explicit StepStability(const Simulation& simulation);

    void look(const Sample& sample);
    bool is_exceeded() const { return worst_.stable_step < step_; }
    const StepLimit& worst() const { return worst_; }
    double step() const { return step_; }  // of the run [s]
    double time() const { return time_; }  // when it was looked at last [s]
    const std::string& method() const { return method_; }
    std::string number_name() const { return numbers_[static_cast<std::size_t>(worst_.number)]; }

    // What it remembers, for a checkpoint.
    static constexpr int mark_count = 7;
    std::vector<double> marks() const;
    bool take_marks(const double* marks);  // whether these can be its own

private:
    std::vector<std::string> numbers_;  // names of the state's
    std::vector<int> independent_;      // places of those that are varied
    std::string method_;
    double step_;
    bool chooses_steps_;  // an adaptive method keeps its limit by itself
    StepLimit worst_;
    double time_ = 0;
    double next_speed_ = 0, next_force_ = 0;  // at which to look again [m/s, N]
};

// The eigenvalues of a vehicle's motions about a state, and what takes part most in the one that the method makes grow most.
StepLimit step_limit(const Sample& sample, const Method& method, double step, const std::vector<int>& independent);

}  // namespace hamilcar
