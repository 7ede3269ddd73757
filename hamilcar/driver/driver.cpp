#include "hamilcar/driver/driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/driver/short_number.hpp"

namespace hamilcar {

namespace {

// Rates of full pedal travel [1/s], and of wheel force over the car's mass for cars without power units [m/s^3].
constexpr double throttle_rate = 20, brake_rate = 8, clutch_rate = 20, force_rate = 60;
constexpr double close_enough = 1e-12;  // tolerance for controls whose range is about one
constexpr double path_tolerance = 1;    // offset from the path above which a warning is given [m]

// Moves a control toward its target at a constant, bounded rate; at the first decision it is set directly. Because times are
// rounded, the move ends short by that much, so that no pedal passes its stop.
struct RateLimiter {
    Schedule& schedule;
    double time, interval;
    bool first;

    void move(Control control, double wanted, double max_rate) const {
        const double now = schedule.signal(control).at(time).value, max_change = max_rate * interval;
        const double rounding = std::numeric_limits<double>::epsilon() * (4 + 2 * std::abs(time) / interval);
        if (first || std::abs(wanted - now) <= std::max(close_enough, rounding)) return set(control, wanted);
        const double change = (1 - rounding) * std::clamp(wanted - now, -max_change, max_change);
        schedule.follow(control, time, {now, change / interval, 0}, interval);
    }
    void set(Control control, double value) const { schedule.follow(control, time, {value, 0, 0}, interval); }
};

}  // namespace

Driver::Driver(const DriverDescription& description, const DrivenCar& car, const Column& column)
    : interval_(description.interval), car_(car) {
    if (description.steering) follower_.emplace(*description.steering, car, column);
    if (description.speed) speed_.emplace(*description.speed, car);
    if (description.shifting) shifting_.emplace(*description.shifting, car);
    if (shifting_ && !shifting_->is_active()) shifting_.reset();
    ending_.emplace(description.ending, follower_.has_value());
    if (!ending_->exists()) ending_.reset();
    brakes_ = description.speed && description.speed->may_brake;
}

void Driver::begin(const Schedule& schedule) {
    scheduled_throttle_ = schedule.signal(Control::throttle);
}

void Driver::act(const Observation& observation, Schedule& schedule) {
    const bool first = !memory_.begun || observation.time == memory_.first_time;
    if (first) {
        memory_ = {.begun = true,
                   .first_time = observation.time,
                   .has_throttle = memory_.has_throttle,
                   .throttle = memory_.throttle};
    }
    if (follower_) {
        follower_->update(observation, memory_.path);
        const SignalValue<double> rack = schedule.signal(Control::rack).at(observation.time);
        schedule.follow(Control::rack, observation.time, follower_->steer(observation, rack, interval_, memory_.path),
                        interval_);
    }
    update_pedals(observation, schedule, first);
    if (ending_) ending_->update(observation, place(), memory_.ending);
}

void Driver::update_pedals(const Observation& observation, Schedule& schedule, bool first) {
    double throttle =
        memory_.has_throttle ? memory_.throttle : scheduled_throttle_.at(observation.time + interval_).value;
    if (speed_) {
        const RateLimiter limiter{schedule, observation.time, interval_, first};
        const bool interrupted = shifting_ && shifting_->interrupts(memory_.shifting);
        const auto pedals = speed_->decide(observation, interrupted, interval_, memory_.speed);
        throttle = pedals.throttle;
        if (brakes_) limiter.move(Control::brake, pedals.brake, brake_rate);
        if (!car_.powered) {
            limiter.move(Control::drive_torque, pedals.drive_torque, force_rate * car_.mass * car_.wheel_radius);
        } else if (!shifting_) {
            limiter.move(Control::throttle, throttle, throttle_rate);
        }
    }
    if (shifting_) update_gears(observation, throttle, schedule, first);
}

void Driver::update_gears(const Observation& observation, double throttle, Schedule& schedule, bool first) {
    const RateLimiter limiter{schedule, observation.time, interval_, first};
    const Shifting::Decision decision = shifting_->decide(observation, throttle, interval_, memory_.shifting);
    if (speed_ || shifting_->cuts_throttle()) {
        const double given = std::max(throttle * decision.throttle_share, decision.min_throttle);
        limiter.move(Control::throttle, given, throttle_rate);
    }
    if (shifting_->operates_clutch()) limiter.move(Control::clutch, decision.clutch, clutch_rate);
    if (decision.evenly) {
        limiter.move(Control::gear, decision.gear, max_gears / interval_);
    } else {
        limiter.set(Control::gear, decision.gear);
    }
}

std::optional<std::string> Driver::end_reason() const {
    return ending_ ? ending_->reason(memory_.ending) : std::nullopt;
}

std::vector<std::string> Driver::warnings() const {
    std::vector<std::string> out;
    if (follower_ && memory_.path.farthest > path_tolerance) {
        out.push_back("the car was up to " + short_number(memory_.path.farthest) + " m off the path, " +
                      short_number(memory_.path.farthest_station) + " m along it");
    }
    if (speed_) {
        if (auto warning = SpeedControl::warning(memory_.speed)) out.push_back(std::move(*warning));
    }
    return out;
}

}  // namespace hamilcar
