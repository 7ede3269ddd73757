// The driver as a schedule: inputs over time with their rates, smooth enough for the rack's velocity to be continuous.
#pragma once

#include <vector>

#include "hamilcar/block/model.hpp"
#include "hamilcar/description/scenario.hpp"

namespace hamilcar {

// One input over time. Smooth: monotone cubic Hermite pieces (Fritsch and Carlson 1980), which never overshoot the table
// and have a continuous first derivative. Linear: straight lines. Constant outside the table.
class Signal {
public:
    Signal() = default;
    // `scale` turns the table's unit into the input's.
    explicit Signal(const SignalDescription& description, double scale = 1);

    struct Value {
        double value = 0, rate = 0, acceleration = 0;
    };
    Value at(double time) const;

private:
    std::vector<double> time_, value_, slope_;
    bool smooth_ = true;
};

// Rack, drive and brake of a scenario; call it with a time to get the Input.
class Schedule {
public:
    // Steering wheel angles become rack displacements by the vehicle's travel per revolution.
    Schedule(const ScenarioDescription& scenario, const SteeringDescription& steering);
    Input<double> operator()(double time) const;

private:
    Signal rack_, drive_, brake_;
};

}  // namespace hamilcar
