// From what a person holds, keys or axes, to what hands and feet do: rack, pedals and gears from step to step.
//
// A key is either down or up, but no hand moves like that, and a rack whose rate jumps would hit the car with an impulse.
// The hands turn the steering wheel to the wanted angle as a critically damped spring would, at bounded speed and
// acceleration. Within a step the acceleration is constant, so displacement and rate continue each other. Keys
// reach only as far as a calm driver would at that speed, axes reach the stops.
#pragma once

#include <optional>

#include "hamilcar/block/model.hpp"
#include "hamilcar/live/gear_lever.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar::live {

// What a driver feels of the car.
struct Felt {
    double speed = 0;  // forward [m/s]
    double spin = 0;   // of the driven wheels, mean [rad/s]
};

class Hands {
public:
    // `shaft_ratio`: of a car with power units (gear_lever.hpp) [1].
    Hands(const DrivenCar& car, const Column& column, double shaft_ratio, double step);

    // Decides about the gears for the coming `steps`; for a car with power units.
    void shift(const Controls& held, const Senses& senses, int steps);
    // The driver from `time` on, for one step.
    Input<double> next(const Controls& held, const Felt& felt, double time);
    void let_go();

private:
    RackMotion<double> turn_rack(const Controls& held, double speed);
    double turn_wheel(const Controls& held, double speed);
    double reach(Device device, double speed) const;
    double drive_torque(const Felt& felt) const;

    DrivenCar car_;
    Column column_;
    double side_;  // 1: a positive rack steers to the left; otherwise -1
    double step_;  // [s]
    std::optional<GearLever> lever_;

    struct Now {
        double angle = 0, rate = 0;                  // of the steering wheel, to the left [rad], [rad/s]
        double throttle = 0, brake = 0, clutch = 0;  // feet on pedals [1]
        bool reverse = false;                        // the way that a mere torque drives
    };
    Now now_;
};

}  // namespace hamilcar::live
