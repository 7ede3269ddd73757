// From what a person holds, keys or axes, to what hands and feet do: rack, drive and brake from step to step.
//
// A key is either down or up, but no hand moves like that, and a rack whose rate jumps would hit the car with an impulse.
// The hands turn the steering wheel to the wanted angle as a critically damped spring would, at bounded speed and
// acceleration. Within a step the acceleration is constant, so displacement and rate continue each other exactly. Keys
// reach only as far as a calm driver would at that speed, axes reach the stops.
#pragma once

#include "hamilcar/block/model.hpp"

namespace hamilcar::live {

enum class Device { keys, axes };

// What a person holds; the range of each is checked where it is received.
struct Controls {
    Device device = Device::keys;
    double steer = 0;     // -1 full right to 1 full left
    double throttle = 0;  // 0 to 1
    double brake = 0;     // 0 to 1
    bool reverse = false;
};

// What hands need to know of the car that they drive.
struct HandledCar {
    double lock = 0;              // of the steering wheel, each way; 0: nothing to steer [rad]
    double rack_per_angle = 0;    // signed so that a positive angle steers to the left [m/rad]
    double wheels_per_angle = 0;  // by how much the steered wheels turn, near straight ahead [1]
    double wheelbase = 1;         // [m]
    double mass = 0;              // of everything [kg]
    double wheel_radius = 0;      // of the driven wheels; 0: there are none [m]
};

// What a driver feels of the car.
struct Felt {
    double speed = 0;  // forward [m/s]
    double spin = 0;   // of the driven wheels, mean [rad/s]
};

class Hands {
public:
    Hands(const HandledCar& car, double step);

    // The driver from `time` on, for one step.
    Input<double> next(const Controls& held, const Felt& felt, double time);
    void let_go() { *this = Hands(car_, step_); }

private:
    double turn_wheel(const Controls& held, double speed);
    double reach(Device device, double speed) const;
    double drive_torque(const Felt& felt) const;

    HandledCar car_;
    double step_;                      // [s]
    double angle_ = 0, rate_ = 0;      // of the steering wheel [rad], [rad/s]
    double throttle_ = 0, brake_ = 0;  // pedals [1]
    bool reverse_ = false;             // the gear that is in
};

}  // namespace hamilcar::live
