// What controllers know of a car, and how they act on it at a step.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "hamilcar/control/control_system.hpp"
#include "hamilcar/description/scenario.hpp"
#include "hamilcar/driver/observation.hpp"
#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

// `state`: the car at its start, which gives the loads of its wheels.
ControlledCar controlled_car(const VehicleDescription& vehicle, const Model<double>& model, const DrivenCar& driven,
                             const State<double>& state, const Input<double>& input);

// For StepTime.
std::optional<double> free_steering_wheel(const Vehicle<double>& vehicle, const State<double>& state);

// Throws io::Error(bad_file) for a rate that does not go with the scenario's step.
std::shared_ptr<const ControlSystem> make_control(const ScenarioDescription& scenario,
                                                  const VehicleDescription& vehicle, const ControlledCar& car);

struct StepTime {
    long step;
    double time;  // [s]
    // Its angle where the rack moves on its own; else it follows the schedule [rad].
    std::optional<double> steering_wheel{};
};
// Lets those decide whose time it is: from what is measured, in the memory, to the schedule's commands. Without allocation.
void let_decide(const ControlSystem& control, const Column& column, const StepTime& now, std::span<double> memory,
                Schedule& schedule);

}  // namespace hamilcar
