#include "hamilcar/driver/preview.hpp"

#include <algorithm>

#include "hamilcar/driver/arms.hpp"
#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

constexpr double gravity = 9.80665;                          // [m/s^2]
constexpr double front_cornering = 12, rear_cornering = 17;  // stiffness over load: 1.4 deg/g of understeer [1/rad]
constexpr double hardest_return = 8;     // lateral acceleration that an offset alone may ask for [m/s^2]
constexpr double steepest_return = 0.3;  // and angle to the path [rad]
// Of the feedback that the horizon T amounts to, a = -(10/3) e / T^2 - (5/2) e' / T (a held acceleration).
constexpr double offset_gain = 10.0 / 3, approach_gain = 4.0 / 3;

}  // namespace

// One step of the horizon: arms exactly, axles by Euler's implicit method, since slow cars have stiff tires.
struct Preview::Step {
    double h, speed, front_rate, rear_rate;  // [s], [m/s], [m/s^2 per rad]
    double wheelbase, center_front, center_rear, wheels_per_angle;
    double decay;  // of the arms, exp(-w h)

    Step(const Preview& p, double v)
        : h(p.horizon(v) / steps),
          speed(v),
          front_rate(front_cornering * gravity),
          rear_rate(rear_cornering * gravity),
          wheelbase(p.wheelbase_),
          center_front(p.rear_ / p.wheelbase_),
          center_rear(p.front_ / p.wheelbase_),
          wheels_per_angle(p.wheels_per_angle_),
          decay(exponential(-Arms::quickness * h)) {}

    void take(LateralState& s, double wanted, double curvature) const {
        const double away = s.angle - wanted, drift = s.rate + Arms::quickness * away;
        s.angle = wanted + decay * (away + drift * h);
        s.rate = decay * (s.rate - Arms::quickness * drift * h);
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

double Preview::largest_offset(double speed) const {
    const double time = horizon(speed);
    return std::min(hardest_return * time * time / offset_gain, steepest_return * speed * time / approach_gain);
}

double Preview::wanted_angle(const LateralState& now, double speed, const std::array<double, steps>& curvature) const {
    const Step step(*this, speed);
    LateralState free = now, forced;
    double numerator = 0, denominator = 0;
    for (std::size_t i = 0; i < steps; ++i) {
        step.take(free, 0, curvature[i]);
        step.take(forced, 1, 0);
        numerator += free.offset * forced.offset;
        denominator += forced.offset * forced.offset;
    }
    return -numerator / denominator;
}

}  // namespace hamilcar
