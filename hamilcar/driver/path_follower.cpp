#include "hamilcar/driver/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

constexpr double slowest = 1;          // below it the driver steers as at it, and less, down to a standstill [m/s]
constexpr double integral_time = 1;    // after which a steady offset has doubled its effect [s]
constexpr double largest_shift = 4;    // [m]
constexpr double largest_slip = 0.25;  // more than tires answer to; of the front wheels [rad]
constexpr double slipless_speed = 5;   // below it wheels may be turned farther, up to the lock [m/s]

}  // namespace

PathFollower::PathFollower(const PathFollowerDescription& description, const DrivenCar& car, const Column& column)
    : path_(description.path),
      preview_(car, description.preview_time),
      arms_{car.lock, description.largest_rate},
      column_(column),
      wheels_per_angle_(car.wheels_per_angle) {
    if (!column.exists() || car.lock <= 0 || car.wheels_per_angle == 0) {
        throw std::invalid_argument("a driver who follows a path needs a steering wheel, and this vehicle has none");
    }
    if (description.largest_angle > 0) arms_.lock = std::min(car.lock, description.largest_angle);
}

void PathFollower::look(const Senses& senses, PathMemory& memory) const {
    const PathPlace place = memory.begun ? path_.nearest(senses.x, senses.y, memory.station)
                                         : path_.nearest_of_all(senses.x, senses.y, senses.yaw);
    memory.begun = true;
    memory.station = place.station, memory.offset = place.offset;
    if (std::abs(place.offset) <= memory.farthest) return;
    memory.farthest = std::abs(place.offset), memory.farthest_station = place.station;
}

SignalValue<double> PathFollower::steer(const Senses& senses, const SignalValue<double>& rack, double interval,
                                        PathMemory& memory) const {
    const double angle = column_.angle(rack.value);
    const Column::Rack at = column_.rack(angle);
    const double rate = rack.rate / at.slope, speed = std::max(senses.speed, slowest);
    const LateralState now{.angle = angle,
                           .rate = rate,
                           .front = senses.lateral_velocity + preview_.center_behind() * senses.yaw_rate,
                           .rear = senses.lateral_velocity - preview_.center_before() * senses.yaw_rate};
    const double wanted = wanted_angle(senses, now, speed, interval, memory);
    const double acceleration = arms_.acceleration(angle, rate, wanted, interval);
    return {rack.value, rack.rate, at.slope * acceleration + at.curvature * rate * rate};
}

// The integral stands still while arms, lock or tires are at their limit and it would only grow.
double PathFollower::wanted_angle(const Senses& senses, const LateralState& now, double speed, double interval,
                                  PathMemory& memory) const {
    const PathPoint here = path_.at(memory.station);
    const auto [sine, cosine] = sincos(senses.yaw);
    const double across = here.tangent_x * sine - here.tangent_y * cosine;
    const double along = here.tangent_x * cosine + here.tangent_y * sine;
    const double largest = preview_.largest_offset(speed), offset = std::clamp(memory.offset, -largest, largest);
    LateralState state = now;
    state.heading = along > 0 ? across : std::copysign(1.0, across);
    state.offset = offset + memory.shift;
    std::array<double, Preview::steps> curvature;
    const double stride = speed * preview_.horizon(speed) / Preview::steps;
    for (std::size_t i = 0; i < curvature.size(); ++i) {
        curvature[i] = path_.at(memory.station + (static_cast<double>(i) + 0.5) * stride).curvature;
    }
    const double ideal = preview_.wanted_angle(state, speed, curvature);
    const double moving = std::clamp(senses.speed / slowest, 0.0, 1.0);
    const double ahead = arctangent(now.front, speed) / wheels_per_angle_;  // the angle without slip at the front
    const double reach = largest_slip * std::max(1.0, slipless_speed / speed) / std::abs(wheels_per_angle_);
    const double wanted = moving * std::clamp(std::clamp(ideal, ahead - reach, ahead + reach), -arms_.lock, arms_.lock);
    const double growth = std::abs(memory.offset) < largest ? moving * interval / integral_time * offset : 0;
    const bool limited = std::abs(wanted - moving * ideal) > 0 && (ideal - wanted) * wheels_per_angle_ * growth < 0;
    if (!limited) memory.shift = std::clamp(memory.shift + growth, -largest_shift, largest_shift);
    return wanted;
}

}  // namespace hamilcar
