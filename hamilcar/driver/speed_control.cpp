#include "hamilcar/driver/speed_control.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/driver/words.hpp"

namespace hamilcar {

namespace {

constexpr double proportional = 1.5, integral_gain = 0.35;  // [1/s], [1/s^2]; together overdamped
constexpr double largest_integral = 5;                      // as on a grade of 60 percent [m/s^2]
constexpr double rolling = 0.1, drag = 3e-4;                // resistance of a common car over its mass [m/s^2], [1/m]
constexpr double dead_band = 0.15;  // deceleration that is missing before the foot goes to the brake [m/s^2]
constexpr double slow = 0.2;        // wanted or driven: as good as standing [m/s]
constexpr double holding = 1;       // of the brake of a car that is to stand, at first [m/s^2]
constexpr double pressing = 5;      // how fast it grows while the car moves [m/s^3]
constexpr double still = 1e-3;      // does not move [m/s]
constexpr double tolerance = 0.02, patience = 2, progress = 0.1;  // of a speed in reach [1], [s], [m/s]

}  // namespace

SpeedControl::SpeedControl(const SpeedControlDescription& description, const DrivenCar& car)
    : speed_(description.speed),
      car_(car),
      may_brake_(description.may_brake && car.full_brake_force > 0),
      largest_acceleration_(description.largest_acceleration) {}

SpeedControl::Pedals SpeedControl::decide(const Senses& senses, bool interrupted, double interval,
                                          SpeedMemory& memory) const {
    const SignalValue<double> wanted = speed_.at(senses.time);
    const double missing = wanted.value - senses.speed, asked = wanted.rate + proportional * missing;
    const double bounded = std::clamp(asked, -largest_acceleration_, largest_acceleration_);
    const double resistance = rolling * std::clamp(senses.speed, 0.0, 1.0) + drag * senses.speed * senses.speed;
    const double force = car_.mass * (bounded + memory.integral + resistance);
    const Reach reach = this->reach(senses);
    Pedals pedals = press(reach, force, memory);
    const bool standing = hold(senses.speed, wanted.value, pedals.brake, interval, memory);
    if (standing) pedals = {.brake = memory.hold};
    memory.interrupted = interrupted ? memory.interrupted + interval : 0;
    const bool floored = car_.powered && (pedals.throttle >= 1 || reach.most <= reach.least);
    const bool released = pedals.throttle <= 0 && pedals.drive_torque <= 0 && (!may_brake_ || pedals.brake >= 1);
    const bool held =
        (interrupted && !memory.braking) || standing || asked != bounded || (missing > 0 ? floored : released);
    if (!held) memory.integral += integral_gain * missing * interval;
    memory.integral = std::clamp(memory.integral, -largest_integral, largest_integral);
    const bool strained = interrupted ? memory.interrupted > patience : floored || asked > bounded;
    watch(senses.speed, wanted.value, strained, interval, memory);
    return pedals;
}

// Begun nearly at rest, where the brake holds the car on its slope already.
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

SpeedControl::Reach SpeedControl::reach(const Senses& senses) const {
    Reach out{0, 0};
    if (!car_.powered || car_.wheel_radius <= 0) return out;
    for (int i = 0; i < senses.unit_count; ++i) {
        const UnitSense& unit = senses.units[static_cast<std::size_t>(i)];
        out.least += unit.least_torque * unit.wheel_ratio / car_.wheel_radius;
        out.most += unit.most_torque * unit.wheel_ratio / car_.wheel_radius;
    }
    return out;
}

// All units feel one pedal, so each gives its share of what they can.
SpeedControl::Pedals SpeedControl::press(const Reach& reach, double force, SpeedMemory& memory) const {
    Pedals out;
    if (!car_.powered) {
        out.drive_torque = std::max(force, 0.0) * car_.wheel_radius;
    } else if (reach.most > reach.least) {
        out.throttle = std::clamp((force - reach.least) / (reach.most - reach.least), 0.0, 1.0);
    }
    const double missing = reach.least - force;  // of braking force
    memory.braking = may_brake_ && (memory.braking ? missing > 0 : missing > dead_band * car_.mass);
    if (memory.braking) out.brake = std::min(missing / car_.full_brake_force, 1.0);
    return out;
}

// Two seconds at a time: a car that still gains is not at its limit yet.
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

std::optional<std::string> SpeedControl::complaint(const SpeedMemory& memory) {
    if (!memory.out_of_reach && memory.straining < patience) return {};
    return "the wanted speed of " + spoken(memory.wanted) + " m/s was " +
           (memory.out_of_reach ? "out of reach" : "not reached in time") + ": the car came to " +
           spoken(memory.reached) + " m/s";
}

}  // namespace hamilcar
