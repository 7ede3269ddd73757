// One run: a vehicle and a scenario become a state that is stepped until the time is up or something
// ends it. The mathematics never throws; what it flags becomes an `End` here, with the results so far kept by the caller.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "hamilcar/analysis/energy.hpp"
#include "hamilcar/analysis/joint_forces.hpp"
#include "hamilcar/block/equilibrium.hpp"
#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/block/integration.hpp"
#include "hamilcar/control/control_system.hpp"
#include "hamilcar/driver/driver.hpp"
#include "hamilcar/driver/observe.hpp"
#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/engine/rhs_program.hpp"

namespace hamilcar {

// Everything about one instant, for channels and summaries.
struct Sample {
    using Number = double;
    double time;
    const Model<double>& model;
    const State<double>& state;
    Input<double> input;
    Velocity<double> velocity;
    Momenta<double> momenta;
    Energy<double> energy;
    double violation;        // largest opening of a cut joint [m]
    double constraint_norm;  // Euclidean norm of all Phi, the paper's Fig. 9
    double mobility;         // smallest over the suspensions: 0 where a linkage locks
    // Found when first asked for; a sample belongs to one thread.
    mutable std::optional<VehicleJointForces> joint_forces{};
    mutable std::optional<double> rack_force{};
    // Of a car with controllers, and what they remember.
    const ControlSystem* control = nullptr;
    std::span<const double> control_memory{};
};

// All of that at one state; model and state must outlive it.
Sample sample_at(const Model<double>& model, const State<double>& state, const Input<double>& input);

// Why a run ended early.
struct End {
    double time;          // of the last good state [s]
    std::string message;  // for a person
};

// A place in a run to come back to: the numbers that the rest of the run depends on. A plain copy, and one without
// allocation; of its 60 kB saving and restoring touch only what the car and the method use.
struct Snapshot {
    long step_count = 0;
    State<double> state;
    Integrator<State<double>>::Memory memory;
    Schedule::Memory inputs;
    DriverMemory driver;
    std::array<double, max_control_memory> control;  // of ControlSystem
    Snapshot() {}
};
static_assert(std::is_trivially_copyable_v<Snapshot>);

class Simulation {
public:
    // Runs the Initial Process. Throws io::Error: bad_file where scenario and vehicle do not fit together (unknown
    // integrator, gain beyond the stability limit), numerical where the car does not assemble or settle.
    Simulation(VehicleDescription vehicle, ScenarioDescription scenario);

    double time() const { return step_count_ * integrator_.step(); }
    long steps_taken() const { return step_count_; }
    long total_steps() const { return total_steps_; }
    bool finished() const { return step_count_ >= total_steps_ || ending(); }
    // What ended the run before its time, of those endings that the driver was told.
    std::optional<std::string> ending() const { return driver_ ? driver_->end_reason() : std::nullopt; }
    // What the driver could not do, with what was reached.
    std::vector<std::string> warnings() const { return driver_ ? driver_->warnings() : std::vector<std::string>(); }

    // Compiles the step; the first `advance` does so otherwise. For who cannot wait then.
    void prepare();
    // One step, before which the driver decides if it is time; the reason if the run cannot go on. The state is then the last good one.
    std::optional<End> advance();

    // Going back: a run that is restored and advanced again computes the same bits. The snapshot must be of this
    // Simulation, or of one with the same vehicle, method and step.
    void save(Snapshot& to) const;
    void restore(const Snapshot& from);
    // Another driver from now on, as a predictive controller tries one after the other.
    void set_schedule(const Schedule& schedule) { schedule_ = schedule; }
    // The driver of a simulator decides anew before every step: from now on a control goes as told. Without allocation.
    void follow(Control control, const SignalValue<double>& now) {
        schedule_.follow(control, time(), now, scenario_.solver.step);
    }
    // What actuators are told from now on, until a controller says otherwise; as many as the car takes (vehicle/command_layout.hpp).
    void set_commands(std::span<const double> commands) { schedule_.set_commands(commands); }
    // Calls change(schedule, driver or null) with what the car is driven by.
    template <class Change>
    void change_inputs(Change&& change) {
        change(schedule_, driver_ ? &*driver_ : nullptr);
    }
    Observation observation() const { return observe(model_, state_, schedule_(time())); }
    const DrivenCar& driven_car() const { return car_; }

    Sample sample() const;
    const Model<double>& model() const { return model_; }
    // What stands on the road's plane; the model refers to it. Null on a plane.
    const std::shared_ptr<const Surface>& surface() const { return surface_; }
    const State<double>& state() const { return state_; }
    const Schedule& schedule() const { return schedule_; }
    const VehicleDescription& vehicle() const { return vehicle_; }
    const ScenarioDescription& scenario() const { return scenario_; }
    const std::optional<Driver>& driver() const { return driver_; }
    // Of the car's controllers, by their order in its file.
    void switch_controller(std::size_t controller, bool on);
    const ControlSystem* control() const { return control_.get(); }
    const std::vector<double>& control_memory() const { return control_memory_; }
    const Column& column() const { return column_; }
    long steps_per_decision() const { return steps_per_decision_; }
    double initial_energy_balance() const { return initial_balance_; }

private:
    void start();
    void start_driver();
    void start_control();
    std::string first_not_finite() const;
    std::string inspect(const Health<double>& health) const;
    std::string travels(int number) const;

    VehicleDescription vehicle_;
    ScenarioDescription scenario_;
    std::shared_ptr<const Surface> surface_;  // the model's; a copy of a Simulation shares it
    Model<double> model_;
    std::shared_ptr<const RhsProgram> program_;  // of the model; a copy of a Simulation shares it
    Schedule schedule_;
    DrivenCar car_;
    std::optional<Driver> driver_;
    std::shared_ptr<const ControlSystem> control_;  // null without controllers; a copy of a Simulation shares it
    std::vector<double> control_memory_;
    Column column_;
    long steps_per_decision_ = 1;
    Integrator<State<double>> integrator_;
    State<double> state_, last_good_;  // the latter before the present step
    long step_count_ = 0, total_steps_ = 0;
    double initial_balance_ = 0;
};

}  // namespace hamilcar
