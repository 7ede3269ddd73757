#include "hamilcar/driver/driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/driver/words.hpp"

namespace hamilcar {

namespace {

// Full travel of a foot, and of a torque that stands for one over the car's mass [1/s], [m/s^3].
constexpr double on_throttle = 20, on_brake = 8, on_clutch = 20, of_force = 60;
constexpr double there = 1e-12;       // close enough to be there, of what goes up to about one
constexpr double path_tolerance = 1;  // beside the path before there is a complaint [m]

// Leads a control evenly to where it is wanted, as fast as may be; at the first decision it is there already. Times are
// rounded: it ends that much short, so that no pedal comes past its stop.
struct Hand {
    Schedule& schedule;
    double time, interval;
    bool first;

    void lead(Control control, double wanted, double fastest) const {
        const double now = schedule.signal(control).at(time).value, most = fastest * interval;
        const double rounding = std::numeric_limits<double>::epsilon() * (4 + 2 * std::abs(time) / interval);
        if (first || std::abs(wanted - now) <= std::max(there, rounding)) return put(control, wanted);
        const double change = (1 - rounding) * std::clamp(wanted - now, -most, most);
        schedule.follow(control, time, {now, change / interval, 0}, interval);
    }
    void put(Control control, double value) const { schedule.follow(control, time, {value, 0, 0}, interval); }
};

}  // namespace

Driver::Driver(const DriverDescription& description, const DrivenCar& car, const Column& column)
    : interval_(description.interval), car_(car) {
    if (description.steering) follower_.emplace(*description.steering, car, column);
    if (description.speed) speed_.emplace(*description.speed, car);
    if (description.shifting) shifting_.emplace(*description.shifting, car);
    if (shifting_ && !shifting_->acts()) shifting_.reset();
    ending_.emplace(description.ending, follower_.has_value());
    if (!ending_->exists()) ending_.reset();
    brakes_ = description.speed && description.speed->may_brake;
}

void Driver::begin(const Schedule& schedule) {
    scheduled_throttle_ = schedule.signal(Control::throttle);
}

void Driver::act(const Senses& senses, Schedule& schedule) {
    const bool first = !memory_.begun || senses.time == memory_.first_time;
    if (first) memory_ = {.begun = true, .first_time = senses.time};
    if (follower_) {
        follower_->look(senses, memory_.path);
        const SignalValue<double> rack = schedule.signal(Control::rack).at(senses.time);
        schedule.follow(Control::rack, senses.time, follower_->steer(senses, rack, interval_, memory_.path), interval_);
    }
    work_pedals(senses, schedule, first);
    if (ending_) ending_->look(senses, place(), memory_.ending);
}

void Driver::work_pedals(const Senses& senses, Schedule& schedule, bool first) {
    double throttle = scheduled_throttle_.at(senses.time + interval_).value;
    if (speed_) {
        const Hand hand{schedule, senses.time, interval_, first};
        const bool interrupted = shifting_ && shifting_->interrupts(memory_.shifting);
        const auto pedals = speed_->decide(senses, interrupted, interval_, memory_.speed);
        throttle = pedals.throttle;
        if (brakes_) hand.lead(Control::brake, pedals.brake, on_brake);
        if (!car_.powered) {
            hand.lead(Control::drive_torque, pedals.drive_torque, of_force * car_.mass * car_.wheel_radius);
        } else if (!shifting_) {
            hand.lead(Control::throttle, throttle, on_throttle);
        }
    }
    if (shifting_) work_gears(senses, throttle, schedule, first);
}

void Driver::work_gears(const Senses& senses, double throttle, Schedule& schedule, bool first) {
    const Hand hand{schedule, senses.time, interval_, first};
    const Shifting::Decision decision = shifting_->decide(senses, throttle, interval_, memory_.shifting);
    if (speed_ || shifting_->cuts_throttle()) {
        const double given = std::max(throttle * decision.throttle_share, decision.least_throttle);
        hand.lead(Control::throttle, given, on_throttle);
    }
    if (shifting_->works_clutch()) hand.lead(Control::clutch, decision.clutch, on_clutch);
    if (decision.evenly) {
        hand.lead(Control::gear, decision.gear, max_gears / interval_);
    } else {
        hand.put(Control::gear, decision.gear);
    }
}

std::optional<std::string> Driver::ended() const {
    return ending_ ? ending_->reason(memory_.ending) : std::nullopt;
}

std::vector<std::string> Driver::complaints() const {
    std::vector<std::string> out;
    if (follower_ && memory_.path.farthest > path_tolerance) {
        out.push_back("the car was up to " + spoken(memory_.path.farthest) + " m off the path, " +
                      spoken(memory_.path.farthest_station) + " m along it");
    }
    if (speed_) {
        if (auto complaint = SpeedControl::complaint(memory_.speed)) out.push_back(std::move(*complaint));
    }
    return out;
}

}  // namespace hamilcar
