#include "hamilcar/live/hands.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/driver/arms.hpp"

namespace hamilcar::live {

namespace {

constexpr double degree = std::numbers::pi / 180, kilometer_per_hour = 1 / 3.6;

struct Agility {
    double speed;  // of the steering wheel at most [rad/s]
    double pedal;  // full travel of a foot that presses [1/s]
};
constexpr Agility on_keys{400 * degree, 2.5}, on_axes{1500 * degree, 10};
constexpr double hardest_turn = Arms::quickness * on_axes.speed;  // of the steering wheel [rad/s^2]
constexpr double release = 10, foot_lag = 0.03;  // of a foot that lifts, or is on a clutch [1/s]; of any [s]

constexpr double lateral_acceleration = 0.8 * 9.80665;  // that keys ask for at most [m/s^2]
constexpr double traction = 4, power = 45;              // of the whole mass [m/s^2], [W/kg]
constexpr double top_speed = 250 * kilometer_per_hour, reverse_speed = 30 * kilometer_per_hour;
constexpr double fading = 0.1;        // share of these over which the torque fades [1]
constexpr double shifting_speed = 1;  // below which the gear may change direction [m/s]

double press(double pedal, double wanted, double rate, double step) {
    const double change = (wanted - pedal) * step / (foot_lag + step);
    return pedal + std::clamp(change, -release * step, rate * step);
}

}  // namespace

Hands::Hands(const DrivenCar& car, const Column& column, double shaft_ratio, double step)
    : car_(car), column_(column), side_(car.wheels_per_angle < 0 ? -1 : 1), step_(step) {
    if (car.powered) lever_.emplace(car, shaft_ratio, step);
}

void Hands::let_go() {
    now_ = {};
    if (lever_) lever_->let_go();
}

void Hands::shift(const Controls& held, const Senses& senses, int steps) {
    if (lever_) lever_->look(held, now_.throttle, senses, steps);
}

Input<double> Hands::next(const Controls& held, const Felt& felt, double time) {
    const Agility& agility = held.device == Device::keys ? on_keys : on_axes;
    const bool back = held.selector == Selector::reverse;
    if (std::abs(felt.speed) < shifting_speed) now_.reverse = back;
    const bool engaged = lever_ || now_.reverse == back;  // nobody shifts into reverse at speed
    now_.throttle = press(now_.throttle, engaged ? held.throttle : 0, agility.pedal, step_);
    now_.brake = press(now_.brake, held.brake, agility.pedal, step_);
    now_.clutch = press(now_.clutch, held.clutch, release, step_);
    Input<double> input{.rack = turn_rack(held, felt.speed), .brake = now_.brake, .time = time};
    if (lever_) {
        const GearLever::Position lever = lever_->next(now_.clutch, now_.throttle);
        input.throttle = lever.throttle, input.clutch = lever.clutch, input.gear = lever.gear;
    } else {
        input.drive_torque = drive_torque(felt);
    }
    return input;
}

RackMotion<double> Hands::turn_rack(const Controls& held, double speed) {
    SignalValue<double> angle{side_ * now_.angle, side_ * now_.rate, 0};
    angle.acceleration = side_ * turn_wheel(held, speed);
    const SignalValue<double> rack = column_.rack_motion(angle);
    return {rack.value, rack.rate, rack.acceleration};
}

// Over the step, at an acceleration that is returned.
double Hands::turn_wheel(const Controls& held, double speed) {
    const Arms arms{car_.lock, (held.device == Device::keys ? on_keys : on_axes).speed, hardest_turn};
    const double acceleration = arms.acceleration(now_.angle, now_.rate, reach(held.device, speed) * held.steer, step_);
    now_.angle += step_ * now_.rate + 0.5 * step_ * step_ * acceleration;
    now_.rate += step_ * acceleration;
    return acceleration;
}

// Keys: the angle that asks for a lateral acceleration a = v^2 / (wheelbase / steer) of a car without slip.
double Hands::reach(Device device, double speed) const {
    if (device == Device::axes || car_.wheels_per_angle == 0) return car_.lock;
    const double steer = lateral_acceleration * car_.wheelbase / std::max(speed * speed, 1e-3);
    return std::min(car_.lock, steer / std::abs(car_.wheels_per_angle));
}

// For a car without power units: what the tires or an engine could do, whichever is less; every engine is the same for its
// car.
double Hands::drive_torque(const Felt& felt) const {
    const double direction = now_.reverse ? -1 : 1;
    const double r = car_.wheel_radius, spin = direction * felt.spin;
    if (r <= 0) return 0;
    const double top = (now_.reverse ? reverse_speed : top_speed) / r;
    const double strongest = std::min(traction * r, power / std::max(spin, 1e-3)) * car_.mass;
    return direction * now_.throttle * strongest * std::clamp((top - spin) / (fading * top), 0.0, 1.0);
}

}  // namespace hamilcar::live
