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

    // A driver who decides from step to step: from `now.time` on the rack goes as its displacement, rate and acceleration
    // say, torque and brake stay. Without allocation.
    void follow(const Input<double>& now, double step) {
        rack_.follow(now.time, {now.rack.displacement, now.rack.rate, now.rack.acceleration}, step);
        drive_.follow(now.time, {now.drive_torque}, step);
        brake_.follow(now.time, {now.brake}, step);
    }

    const Signal& rack() const { return rack_; }
    const Signal& drive() const { return drive_; }
    const Signal& brake() const { return brake_; }

private:
    Signal rack_, drive_, brake_;
};

}  // namespace hamilcar
