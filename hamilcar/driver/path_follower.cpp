#include "hamilcar/driver/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

constexpr double min_speed = 1;      // below it the steering of this speed is faded out, to zero at a standstill [m/s]
constexpr double integral_time = 1;  // time in which a steady offset doubles its effect [s]
constexpr double max_shift = 4;      // [m]
constexpr double max_slip = 0.25;    // of the front wheels: more gains no side force [rad]
constexpr double full_lock_speed = 5;  // below it larger angles are allowed, up to the lock [m/s]

}  // namespace

PathFollower::PathFollower(const PathFollowerDescription& description, const DrivenCar& car, const Column& column)
    : path_(description.path),
      preview_(car, description.preview_time),
      actuator_{car.lock, description.largest_rate},
      column_(column),
      wheels_per_angle_(car.wheels_per_angle) {
    if (!column.exists() || car.lock <= 0 || car.wheels_per_angle == 0) {
        throw std::invalid_argument("following a path requires a steering wheel, and this vehicle has none");
    }
    if (description.largest_angle > 0) actuator_.lock = std::min(car.lock, description.largest_angle);
}

void PathFollower::update(const Observation& observation, PathMemory& memory) const {
    const PathPlace place = memory.begun ? path_.nearest(observation.x, observation.y, memory.station)
                                         : path_.nearest_of_all(observation.x, observation.y, observation.yaw);
    memory.begun = true;
    memory.station = place.station, memory.offset = place.offset;
    if (std::abs(place.offset) <= memory.farthest) return;
    memory.farthest = std::abs(place.offset), memory.farthest_station = place.station;
}

SignalValue<double> PathFollower::steer(const Observation& observation, const SignalValue<double>& rack,
                                        double interval, PathMemory& memory) const {
    const double angle = column_.angle(rack.value);
    const Column::Rack at = column_.rack(angle);
    const double rate = rack.rate / at.slope, speed = std::max(observation.speed, min_speed);
    const LateralState now{.angle = angle,
                           .rate = rate,
                           .front = observation.lateral_velocity + preview_.center_behind() * observation.yaw_rate,
                           .rear = observation.lateral_velocity - preview_.center_before() * observation.yaw_rate};
    const double wanted = wanted_angle(observation, now, speed, interval, memory);
    const double acceleration = actuator_.acceleration(angle, rate, wanted, interval);
    return {rack.value, rack.rate, at.slope * acceleration + at.curvature * rate * rate};
}

// Anti-windup: the integral is frozen while actuator, lock or tires are at their limit and it would only grow.
double PathFollower::wanted_angle(const Observation& observation, const LateralState& now, double speed,
                                  double interval, PathMemory& memory) const {
    const PathPoint here = path_.at(memory.station);
    const auto [sine, cosine] = sincos(observation.yaw);
    const double across = here.tangent_x * sine - here.tangent_y * cosine;
    const double along = here.tangent_x * cosine + here.tangent_y * sine;
    const double largest = preview_.max_offset(speed), offset = std::clamp(memory.offset, -largest, largest);
    LateralState state = now;
    state.heading = along > 0 ? across : std::copysign(1.0, across);
    state.offset = offset + memory.shift;
    std::array<double, Preview::steps> curvature;
    const double stride = speed * preview_.horizon(speed) / Preview::steps;
    for (std::size_t i = 0; i < curvature.size(); ++i) {
        curvature[i] = path_.at(memory.station + (static_cast<double>(i) + 0.5) * stride).curvature;
    }
    const double ideal = preview_.wanted_angle(state, speed, curvature);
    const double moving = std::clamp(observation.speed / min_speed, 0.0, 1.0);
    const double ahead = arctangent(now.front, speed) / wheels_per_angle_;  // the angle without slip at the front
    const double range = max_slip * std::max(1.0, full_lock_speed / speed) / std::abs(wheels_per_angle_);
    const double wanted =
        moving * std::clamp(std::clamp(ideal, ahead - range, ahead + range), -actuator_.lock, actuator_.lock);
    const double growth = std::abs(memory.offset) < largest ? moving * interval / integral_time * offset : 0;
    const bool limited = std::abs(wanted - moving * ideal) > 0 && (ideal - wanted) * wheels_per_angle_ * growth < 0;
    if (!limited) memory.shift = std::clamp(memory.shift + growth, -max_shift, max_shift);
    return wanted;
}

}  // namespace hamilcar
