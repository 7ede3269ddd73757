#include "hamilcar/driver/speed_control.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/driver/short_number.hpp"

namespace hamilcar {

namespace {

constexpr double proportional = 1.5, integral_gain = 0.35;  // [1/s], [1/s^2]; together overdamped
constexpr double max_integral = 5;                          // as on a grade of 60 percent [m/s^2]
constexpr double rolling = 0.1, drag = 3e-4;                // resistance of a typical car over its mass [m/s^2], [1/m]
constexpr double dead_band = 0.15;                          // missing deceleration before the brake is applied [m/s^2]
constexpr double slow = 0.2;                                // target or actual speed that counts as standing [m/s]
constexpr double holding = 1;   // initial deceleration of the brake that holds a car [m/s^2]
constexpr double pressing = 5;  // its rate while the car moves [m/s^3]
constexpr double still = 1e-3;  // speed that counts as no motion [m/s]
constexpr double tolerance = 0.02, patience = 2, progress = 0.1;  // of an attainable speed [1], [s], [m/s]

}  // namespace

SpeedControl::SpeedControl(const SpeedControlDescription& description, const DrivenCar& car)
    : speed_(description.speed),
      car_(car),
      may_brake_(description.may_brake && car.full_brake_force > 0),
      largest_acceleration_(description.largest_acceleration) {}

SpeedControl::Pedals SpeedControl::decide(const Observation& observation, bool interrupted, double interval,
                                          SpeedMemory& memory) const {
    const SignalValue<double> wanted = speed_.at(observation.time);
    const double missing = wanted.value - observation.speed, asked = wanted.rate + proportional * missing;
    const double bounded = std::clamp(asked, -largest_acceleration_, largest_acceleration_);
    const double resistance =
        rolling * std::clamp(observation.speed, 0.0, 1.0) + drag * observation.speed * observation.speed;
    const double force = car_.mass * (bounded + memory.integral + resistance);
    const ForceRange range = force_range(observation);
    Pedals pedals = press(range, force, memory);
    const bool standing = hold(observation.speed, wanted.value, pedals.brake, interval, memory);
    if (standing) pedals = {.brake = memory.hold};
    memory.interrupted = interrupted ? memory.interrupted + interval : 0;
    const bool floored = car_.powered && (pedals.throttle >= 1 || range.max <= range.min);
    const bool released = pedals.throttle <= 0 && pedals.drive_torque <= 0 && (!may_brake_ || pedals.brake >= 1);
    const bool held =
        (interrupted && !memory.braking) || standing || asked != bounded || (missing > 0 ? floored : released);
    if (!held) memory.integral += integral_gain * missing * interval;
    memory.integral = std::clamp(memory.integral, -max_integral, max_integral);
    const bool strained = interrupted ? memory.interrupted > patience : floored || asked > bounded;
    watch(observation.speed, wanted.value, strained, interval, memory);
    return pedals;
}

// Starts near rest, with the brake command that holds the car on the slope.
bool SpeedControl::hold(double speed, double wanted, double pressed, double interval, SpeedMemory& memory) const {
    if (!may_brake_ || std::abs(wanted) >= slow || (memory.hold == 0 && speed >= slow)) {
        memory.hold = 0;
        return false;
    }
    const double of_mass = car_.mass / car_.full_brake_force;  // [s^2/m]
    if (memory.hold == 0) memory.hold = std::max(pressed, of_mass * holding);
    if (std::abs(speed) > still) memory.hold += of_mass * pressing * interval;
    memory.hold = std::min(memory.hold, 1.0);
    memory.integral = 0;
    return true;
}

SpeedControl::ForceRange SpeedControl::force_range(const Observation& observation) const {
    ForceRange out{0, 0};
    if (!car_.powered || car_.wheel_radius <= 0) return out;
    for (int i = 0; i < observation.unit_count; ++i) {
        const PowerUnitObservation& unit = observation.units[static_cast<std::size_t>(i)];
        out.min += unit.min_torque * unit.wheel_ratio / car_.wheel_radius;
        out.max += unit.max_torque * unit.wheel_ratio / car_.wheel_radius;
    }
    return out;
}

// All units share one pedal, so each contributes the same fraction of its range.
SpeedControl::Pedals SpeedControl::press(const ForceRange& range, double force, SpeedMemory& memory) const {
    Pedals out;
    if (!car_.powered) {
        out.drive_torque = std::max(force, 0.0) * car_.wheel_radius;
    } else if (range.max > range.min) {
        out.throttle = std::clamp((force - range.min) / (range.max - range.min), 0.0, 1.0);
    }
    const double missing = range.min - force;  // of braking force
    memory.braking = may_brake_ && (memory.braking ? missing > 0 : missing > dead_band * car_.mass);
    if (memory.braking) out.brake = std::min(missing / car_.full_brake_force, 1.0);
    return out;
}

// Windows of two seconds: a car that still gains speed is not at its limit yet.
void SpeedControl::watch(double speed, double wanted, bool strained, double interval, SpeedMemory& memory) {
    if (!strained || speed >= (1 - tolerance) * wanted) {
        memory.straining = memory.watched = 0;
        return;
    }
    if (memory.watched == 0) memory.watched_from = speed;
    memory.straining += interval, memory.watched += interval;
    if (memory.watched >= patience) {
        memory.out_of_reach = memory.out_of_reach || speed < memory.watched_from + progress;
        memory.watched = 0;
    }
    memory.reached = memory.straining > interval ? std::max(memory.reached, speed) : speed;
    memory.wanted = wanted;
}

std::optional<std::string> SpeedControl::warning(const SpeedMemory& memory) {
    if (!memory.out_of_reach && memory.straining < patience) return {};
    return "the target speed of " + short_number(memory.wanted) + " m/s was " +
           (memory.out_of_reach ? "out of reach" : "not reached in time") + ": the car reached " +
           short_number(memory.reached) + " m/s";
}

}  // namespace hamilcar
