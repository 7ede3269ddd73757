#include "hamilcar/live/hands.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hamilcar::live {

namespace {

constexpr double degree = std::numbers::pi / 180, kilometer_per_hour = 1 / 3.6;

struct Agility {
    double speed;  // of the steering wheel at most [rad/s]
    double pedal;  // full travel of a foot that presses [1/s]
};
constexpr Agility on_keys{400 * degree, 2.5}, on_axes{1500 * degree, 10};
constexpr double quickness = 30;                            // natural frequency of the arms [1/s]
constexpr double hardest_turn = quickness * on_axes.speed;  // acceleration of the steering wheel [rad/s^2]
constexpr double release = 10, foot_lag = 0.03;             // of a foot that lifts [1/s]; of any [s]

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

Hands::Hands(const HandledCar& car, double step) : car_(car), step_(step) {}

Input<double> Hands::next(const Controls& held, const Felt& felt, double time) {
    const Agility& agility = held.device == Device::keys ? on_keys : on_axes;
    if (std::abs(felt.speed) < shifting_speed) reverse_ = held.reverse;
    const bool engaged = reverse_ == held.reverse;  // nobody shifts into reverse at speed
    throttle_ = press(throttle_, engaged ? held.throttle : 0, agility.pedal, step_);
    brake_ = press(brake_, held.brake, agility.pedal, step_);
    Input<double> input{.rack = {car_.rack_per_angle * angle_, car_.rack_per_angle * rate_, 0},
                        .drive_torque = drive_torque(felt),
                        .brake = brake_,
                        .time = time};
    input.rack.acceleration = car_.rack_per_angle * turn_wheel(held, felt.speed);
    return input;
}

// Over the step, at an acceleration that is returned: the spring's a = w^2 (wanted - angle) - 2 w rate with both as they
// will be at the end, which is stable for a step of any length. At its end the rate is at most w (lock - angle), so that the
// wheel never turns past the lock; to keep that it brakes by w rate at most, which the bound on the acceleration allows.
double Hands::turn_wheel(const Controls& held, double speed) {
    const Agility& agility = held.device == Device::keys ? on_keys : on_axes;
    const double w = quickness, h = step_;
    const double wanted = held.steer * reach(held.device, speed);
    const double free = (w * w * (wanted - angle_ - h * rate_) - 2 * w * rate_) / ((1 + w * h) * (1 + w * h));
    const double half_way = angle_ + 0.5 * h * rate_, braking = w / (1 + 0.5 * w * h);
    const double next = std::clamp(rate_ + h * free, std::max(-agility.speed, -braking * (car_.lock + half_way)),
                                   std::min(agility.speed, braking * (car_.lock - half_way)));
    const double acceleration = std::clamp((next - rate_) / h, -hardest_turn, hardest_turn);
    angle_ += h * rate_ + 0.5 * h * h * acceleration;
    rate_ += h * acceleration;
    return acceleration;
}

// Keys: the angle that asks for a lateral acceleration a = v^2 / (wheelbase / steer) of a car without slip.
double Hands::reach(Device device, double speed) const {
    if (device == Device::axes || car_.wheels_per_angle <= 0) return car_.lock;
    const double steer = lateral_acceleration * car_.wheelbase / std::max(speed * speed, 1e-3);
    return std::min(car_.lock, steer / car_.wheels_per_angle);
}

// What the tires or the engine can do, whichever is less; until a driveline takes over, every engine is the same for its car.
double Hands::drive_torque(const Felt& felt) const {
    const double direction = reverse_ ? -1 : 1;
    const double r = car_.wheel_radius, spin = direction * felt.spin;
    if (r <= 0) return 0;
    const double top = (reverse_ ? reverse_speed : top_speed) / r;
    const double strongest = std::min(traction * r, power / std::max(spin, 1e-3)) * car_.mass;
    return direction * throttle_ * strongest * std::clamp((top - spin) / (fading * top), 0.0, 1.0);
}

}  // namespace hamilcar::live
