// Rollouts: cars under rows of controls, with exact derivatives of what is read off them by controls, starting state and parameters of the
// model, forwards (tangents) and backwards (adjoints).
//
//     controls, state, parameters ─► steps of the Runge-Kutta method ─► channels after each row, state at the end
//
// A run has the bits of the same run in a Batch. The derivatives are those of what the computer does, step by step: of the method's map, with its
// closing of the loops and normalizing of the quaternion, not of the differential equations' exact solution. Methods that remember
// past rates are no such map, and a driver's decisions have no derivatives.
//
// Backwards, a run is computed once forwards and then row by row from its end. The stages of its steps are kept while they are few; of a
// long run the states at the rows are and the stages of one row, and each row is computed once more.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hamilcar/batch/rollout_programs.hpp"
#include "hamilcar/batch/worker_pool.hpp"
#include "hamilcar/driver/direct_controls.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// A car whose model and controls are used; they must outlive the call or the rollout that they are given to.
struct RolloutCar {
    const Simulation* simulation;
    const DirectControls* controls;
};

struct RolloutOptions {
    long steps = 1;      // of a row
    int threads = 0;     // including the caller's; zero: as many as the machine has
    std::string engine;  // its name; empty: the default engine
    // Cars that others may be like: numbers in which they differ from the first one are the parameters.
    std::vector<const Simulation*> variants = {};
};

// Runs, one after the other, each with its numbers; or derivatives along or by them.
struct RolloutNumbers {
    std::vector<double> controls;    // of a run: where each is at the start, then at the end of each row
    std::vector<double> states;      // at the start
    std::vector<double> parameters;  // of the model, as numbers_of lists them; only of derivatives
};
struct RolloutResults {
    std::vector<double> channels;  // of a run: after each row each channel
    std::vector<double> states;    // at the end
};

class Rollout {
public:
    // Throws std::invalid_argument for a car with a driver, for a method that is not a Runge-Kutta method with fixed steps, and for variants of
    // another structure; and as engine() does.
    Rollout(const RolloutCar& car, const TracedReaders& readers, const RolloutOptions& options);

    std::size_t state_size() const { return programs_.state_size(); }
    std::size_t channel_count() const { return programs_.channel_count(); }
    std::size_t parameter_count() const { return programs_.parameters().size(); }
    std::vector<double> parameters_of(const Simulation& car) const { return programs_.parameters_of(car.model()); }
    // Why a car cannot run here, or nothing.
    std::string obstacle(const RolloutCar& car) const;
    // Asked after every step by each thread; true: the call returns at once, with numbers that mean nothing.
    void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }

    // Of so many rows; `cars`: one for each run. A run that fails (not finite, a linkage locks or opens) is NaN from then on.
    RolloutResults run(std::span<const RolloutCar> cars, const RolloutNumbers& runs, std::size_t rows);
    // Also how the results change along a direction for each run.
    RolloutResults tangents(std::span<const RolloutCar> cars, const RolloutNumbers& runs, const RolloutNumbers& along,
                            std::size_t rows, RolloutResults& changes);
    // The gradient of each run's weighted sum of results; NaN of a run that fails.
    RolloutNumbers gradient(std::span<const RolloutCar> cars, const RolloutNumbers& runs, const RolloutResults& weights,
                            std::size_t rows);

    // Directions of the starting states that keep the loops closed: the dependent coordinates of each move with the independent ones and
    // with the rack as its direction says, whatever was given for them.
    std::vector<double> closed(std::span<const RolloutCar> cars, const RolloutNumbers& runs,
                               const RolloutNumbers& along);

private:
    RolloutCar first_;
    long steps_;
    RolloutPrograms programs_;
    std::function<bool()> stop_;
    WorkerPool pool_;
};

}  // namespace hamilcar
