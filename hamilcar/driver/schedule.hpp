// The driver as a schedule: inputs over time with their rates, smooth enough for the rack's velocity to be continuous.
#pragma once

#include "hamilcar/block/model.hpp"
#include "hamilcar/description/scenario.hpp"
#include "hamilcar/math/signal.hpp"

namespace hamilcar {

// Rack, drive and brake of a scenario; call it with a time to get the Input.
class Schedule {
public:
    // Steering wheel angles become rack displacements by the vehicle's travel per revolution.
    Schedule(const ScenarioDescription& scenario, const SteeringDescription& steering);
    HAMILCAR_CORE Input<double> operator()(double time) const {
        const SignalValue<double> rack = rack_.at(time);
        return {.rack = {rack.value, rack.rate, rack.acceleration},
                .drive_torque = drive_.at(time).value,
                .brake = brake_.at(time).value,
                .time = time};
    }

    const Signal& rack() const { return rack_; }
    const Signal& drive() const { return drive_; }
    const Signal& brake() const { return brake_; }

private:
    Signal rack_, drive_, brake_;
};

}  // namespace hamilcar
