// One car in the hands of one engine: the bare step, without what a Simulation checks and keeps around it.
#pragma once

#include "hamilcar/engine/library.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

class EngineCar {
public:
    // Goes on from where the simulation is, with the past of a multi-step method still to be made.
    EngineCar(const Engine& engine, const Simulation& simulation)
        : engine_(&engine),
          surface_(simulation.surface()),
          model_(simulation.model()),
          schedule_(simulation.schedule()),
          state_(simulation.state()),
          step_count_(simulation.steps_taken()),
          integrator_(*find_method(simulation.scenario().solver.integrator), simulation.scenario().solver.step,
                      model_.vehicle.state_size, simulation.scenario().solver.tolerance) {}

    void advance(long steps) {
        for (long i = 0; i < steps; ++i, ++step_count_) {
            const double time = static_cast<double>(step_count_) * integrator_.step();
            engine_->advance_car(model_, integrator_, schedule_, time, state_);
        }
    }
    const State<double>& state() const { return state_; }
    void keep_energy_balance(bool keep) { model_.energy_balance = keep; }

private:
    const Engine* engine_;
    std::shared_ptr<const Surface> surface_;  // the model's
    Model<double> model_;
    Schedule schedule_;
    State<double> state_;
    long step_count_;
    Integrator<State<double>> integrator_;
};

}  // namespace hamilcar
