#include "hamilcar/driver/preview.hpp"

#include <algorithm>

#include "hamilcar/driver/steering_actuator.hpp"
#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

constexpr double gravity = 9.80665;                          // [m/s^2]
constexpr double front_cornering = 12, rear_cornering = 17;  // stiffness over load: 1.4 deg/g of understeer [1/rad]
constexpr double max_return_acceleration = 8;  // lateral acceleration that an offset alone may demand [m/s^2]
constexpr double max_return_angle = 0.3;       // angle to the path that an offset alone may demand [rad]
// A horizon T is equivalent to the feedback a = -(10/3) e / T^2 - (5/2) e' / T for a constant acceleration.
constexpr double offset_gain = 10.0 / 3, approach_gain = 4.0 / 3;

}  // namespace

// One step of the horizon: actuator exactly, axles by the implicit Euler method, since tires are stiff at low speed.
struct Preview::Step {
    double h, speed, front_rate, rear_rate;  // [s], [m/s], [m/s^2 per rad]
    double wheelbase, center_front, center_rear, wheels_per_angle;
    double decay;  // of the actuator, exp(-w h)

    Step(const Preview& p, double v)
        : h(p.horizon(v) / steps),
          speed(v),
          front_rate(front_cornering * gravity),
          rear_rate(rear_cornering * gravity),
          wheelbase(p.wheelbase_),
          center_front(p.rear_ / p.wheelbase_),
          center_rear(p.front_ / p.wheelbase_),
          wheels_per_angle(p.wheels_per_angle_),
          decay(exponential(-SteeringActuator::natural_frequency * h)) {}

    void advance(LateralState& s, double wanted, double curvature) const {
        const double error = s.angle - wanted, combined = s.rate + SteeringActuator::natural_frequency * error;
        s.angle = wanted + decay * (error + combined * h);
        s.rate = decay * (s.rate - SteeringActuator::natural_frequency * combined * h);
        // (1 + h M) v = v + h B delta with M = [kf/U + U/L, -U/L; U/L, kr/U - U/L]
        const double turn = h * speed / wheelbase;
        const double m11 = 1 + h * front_rate / speed + turn, m22 = 1 + h * rear_rate / speed - turn;
        const double right = s.front + h * front_rate * wheels_per_angle * s.angle;
        const double determinant = m11 * m22 + turn * turn;
        const double front = (m22 * right + turn * s.rear) / determinant;
        const double rear = (m11 * s.rear - turn * right) / determinant;
        s.front = front, s.rear = rear;
        const double heading = s.heading + h * ((front - rear) / wheelbase - speed * curvature);
        s.offset += h * (0.5 * speed * (s.heading + heading) + center_front * front + center_rear * rear);
        s.heading = heading;
    }
};

Preview::Preview(const DrivenCar& car, double time)
    : time_(time),
      wheelbase_(car.wheelbase),
      front_(std::clamp(car.center_behind, 0.1 * car.wheelbase, 0.9 * car.wheelbase)),
      rear_(car.wheelbase - front_),
      wheels_per_angle_(car.wheels_per_angle) {}

double Preview::horizon(double speed) const {
    return std::max(time_, wheelbase_ / speed);
}

double Preview::max_offset(double speed) const {
    const double time = horizon(speed);
    return std::min(max_return_acceleration * time * time / offset_gain,
                    max_return_angle * speed * time / approach_gain);
}

double Preview::wanted_angle(const LateralState& now, double speed, const std::array<double, steps>& curvature) const {
    const Step step(*this, speed);
    LateralState free = now, forced;
    double numerator = 0, denominator = 0;
    for (std::size_t i = 0; i < steps; ++i) {
        step.advance(free, 0, curvature[i]);
        step.advance(forced, 1, 0);
        numerator += free.offset * forced.offset;
        denominator += forced.offset * forced.offset;
    }
    return -numerator / denominator;
}

}  // namespace hamilcar
