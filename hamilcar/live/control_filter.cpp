#include "hamilcar/live/control_filter.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/base/units.hpp"
#include "hamilcar/driver/steering_actuator.hpp"

namespace hamilcar::live {

namespace {

using units::degree;
using units::kilometer_per_hour;

struct Rates {
    double speed;  // maximum of the steering wheel [rad/s]
    double pedal;  // maximum while a pedal is pressed, full travels [1/s]
};
constexpr Rates key_rates{400 * degree, 2.5}, axis_rates{1500 * degree, 10};
constexpr double max_wheel_acceleration =
    SteeringActuator::natural_frequency * axis_rates.speed;  // of the steering wheel [rad/s^2]
constexpr double release_rate = 10, pedal_lag = 0.03;  // of a released pedal and of the clutch [1/s]; of all pedals [s]

constexpr double lateral_acceleration = 0.8 * 9.80665;  // maximum on keys [m/s^2]
constexpr double traction = 4, power = 45;              // of the whole mass [m/s^2], [W/kg]
constexpr double top_speed = 250 * kilometer_per_hour, reverse_speed = 30 * kilometer_per_hour;
constexpr double fading = 0.1;        // share of these over which the torque fades [1]
constexpr double shifting_speed = 1;  // below which the gear may change direction [m/s]

double press(double pedal, double wanted, double rate, double step) {
    const double change = (wanted - pedal) * step / (pedal_lag + step);
    return pedal + std::clamp(change, -release_rate * step, rate * step);
}

}  // namespace

ControlFilter::ControlFilter(const DrivenCar& car, const Column& column, double shaft_ratio, double step)
    : car_(car), column_(column), side_(car.wheels_per_angle < 0 ? -1 : 1), step_(step) {
    if (car.powered) lever_.emplace(car, shaft_ratio, step);
}

void ControlFilter::reset() {
    now_ = {};
    if (lever_) lever_->reset();
}

void ControlFilter::decide_gear(const Controls& controls, const Observation& observation, int steps) {
    if (lever_) lever_->decide(controls, now_.throttle, observation, steps);
}

Input<double> ControlFilter::next(const Controls& controls, const MeasuredSpeeds& speeds, double time) {
    const Rates& rates = controls.device == Device::keys ? key_rates : axis_rates;
    const bool back = controls.selector == Selector::reverse;
    if (std::abs(speeds.speed) < shifting_speed) now_.reverse = back;
    const bool engaged = lever_ || now_.reverse == back;  // no change of direction at speed
    now_.throttle = press(now_.throttle, engaged ? controls.throttle : 0, rates.pedal, step_);
    now_.brake = press(now_.brake, controls.brake, rates.pedal, step_);
    now_.clutch = press(now_.clutch, controls.clutch, release_rate, step_);
    Input<double> input{.rack = turn_rack(controls, speeds.speed), .brake = now_.brake, .time = time};
    if (lever_) {
        const GearLever::Position lever = lever_->next(now_.clutch, now_.throttle);
        input.throttle = lever.throttle, input.clutch = lever.clutch, input.gear = lever.gear;
    } else {
        input.drive_torque = drive_torque(speeds);
    }
    return input;
}

RackMotion<double> ControlFilter::turn_rack(const Controls& controls, double speed) {
    SignalValue<double> angle{side_ * now_.angle, side_ * now_.rate, 0};
    angle.acceleration = side_ * turn_steering_wheel(controls, speed);
    const SignalValue<double> rack = column_.rack_motion(angle);
    return {rack.value, rack.rate, rack.acceleration};
}

// Advances the steering wheel over one step and returns its acceleration.
double ControlFilter::turn_steering_wheel(const Controls& controls, double speed) {
    const SteeringActuator actuator{car_.lock, (controls.device == Device::keys ? key_rates : axis_rates).speed,
                                    max_wheel_acceleration};
    const double acceleration =
        actuator.acceleration(now_.angle, now_.rate, max_angle(controls.device, speed) * controls.steer, step_);
    now_.angle += step_ * now_.rate + 0.5 * step_ * step_ * acceleration;
    now_.rate += step_ * acceleration;
    return acceleration;
}

// On keys the angle that gives the lateral acceleration a = v^2 / (wheelbase / steer) without slip.
double ControlFilter::max_angle(Device device, double speed) const {
    if (device == Device::axes || car_.wheels_per_angle == 0) return car_.lock;
    const double steer = lateral_acceleration * car_.wheelbase / std::max(speed * speed, 1e-3);
    return std::min(car_.lock, steer / std::abs(car_.wheels_per_angle));
}

// For a car without power units: limited by the tires or by a nominal engine power per mass.
double ControlFilter::drive_torque(const MeasuredSpeeds& speeds) const {
    const double direction = now_.reverse ? -1 : 1;
    const double r = car_.wheel_radius, spin = direction * speeds.spin;
    if (r <= 0) return 0;
    const double top = (now_.reverse ? reverse_speed : top_speed) / r;
    const double max_torque = std::min(traction * r, power / std::max(spin, 1e-3)) * car_.mass;
    return direction * now_.throttle * max_torque * std::clamp((top - spin) / (fading * top), 0.0, 1.0);
}

}  // namespace hamilcar::live
