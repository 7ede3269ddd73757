// One car in the hands of one engine: the bare step, without what a Simulation checks and keeps around it.
#pragma once

#include "hamilcar/engine/car_rhs.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

class EngineCar {
public:
    // Goes on from where the simulation is, with the past of a multi-step method still to be made.
    EngineCar(const Engine& engine, const Simulation& simulation, bool energy_balance)
        : surface_(simulation.surface()),
          program_(rhs_program(with_balance(simulation.model(), energy_balance), engine)),
          schedule_(simulation.schedule()),
          state_(simulation.state()),
          step_count_(simulation.steps_taken()),
          integrator_(*find_method(simulation.scenario().solver.integrator), simulation.scenario().solver.step,
                      program_->state_size, simulation.scenario().solver.tolerance) {}
    EngineCar(const Engine& engine, const Simulation& simulation)
        : EngineCar(engine, simulation, simulation.model().energy_balance) {}

    void advance(long steps) {
        const CarRhs rhs(*program_, surface_.get());
        for (long i = 0; i < steps; ++i, ++step_count_) {
            const double time = static_cast<double>(step_count_) * integrator_.step();
            advance_car(rhs, integrator_, schedule_, time, state_);
        }
    }
    const State<double>& state() const { return state_; }
    const RhsProgram& program() const { return *program_; }

private:
    static Model<double> with_balance(Model<double> model, bool keep) {
        model.energy_balance = keep;
        return model;
    }

    std::shared_ptr<const Surface> surface_;  // the model's
    std::shared_ptr<const RhsProgram> program_;
    Schedule schedule_;
    State<double> state_;
    long step_count_;
    Integrator<State<double>> integrator_;
};

}  // namespace hamilcar
