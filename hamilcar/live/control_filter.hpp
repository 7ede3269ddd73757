// Turns the user's controls, keys or axes, into the model's inputs: rack motion, pedals and gear of each step.
//
// A key is either down or up, and a rack whose rate jumps would hit the car with an impulse. The filter therefore turns the
// steering wheel to the wanted angle as a critically damped spring would, at bounded speed and acceleration. Within a step the
// acceleration is constant, so displacement and rate are continuous. Keys are limited to the angle that a calm driver would use at
// that speed; axes cover the full range of the steering wheel.
#pragma once

#include <optional>

#include "hamilcar/block/model.hpp"
#include "hamilcar/live/gear_lever.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar::live {

// Speeds of the car that the filter depends on.
struct MeasuredSpeeds {
    double speed = 0;  // forward [m/s]
    double spin = 0;   // of the driven wheels, mean [rad/s]
};

class ControlFilter {
public:
    // `shaft_ratio`: of a car with power units (gear_lever.hpp) [1].
    ControlFilter(const DrivenCar& car, const Column& column, double shaft_ratio, double step);

    // Chooses the gear for the coming `steps`; for a car with power units.
    void decide_gear(const Controls& controls, const Observation& observation, int steps);
    // The inputs for one step from `time` on.
    Input<double> next(const Controls& controls, const MeasuredSpeeds& speeds, double time);
    void reset();

private:
    RackMotion<double> turn_rack(const Controls& controls, double speed);
    double turn_steering_wheel(const Controls& controls, double speed);
    double max_angle(Device device, double speed) const;
    double drive_torque(const MeasuredSpeeds& speeds) const;

    DrivenCar car_;
    Column column_;
    double side_;  // 1: a positive rack steers to the left; otherwise -1
    double step_;  // [s]
    std::optional<GearLever> lever_;

    struct Now {
        double angle = 0, rate = 0;                  // of the steering wheel, to the left [rad], [rad/s]
        double throttle = 0, brake = 0, clutch = 0;  // pedals [1]
        bool reverse = false;                        // direction of the drive torque without power units
    };
    Now now_;
};

}  // namespace hamilcar::live
