#include "hamilcar/driver/shifting.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hamilcar {

namespace {

using Phase = ShiftMemory::Phase;

// Phases of a manual gear change, as shares of its time: throttle closed, clutch begins to open, is open, lever moves, clutch
// begins to close, throttle begins to open.
constexpr double lifted = 0.15, opening = 0.05, open = 0.25, lever = 0.4, closing = 0.6, pressing = 0.7;
constexpr double matching =
    0.1;  // speed difference over shaft speed, below which the throttle opens only in proportion [1]

constexpr double large_slip = 0.2;  // share of the rotor's speed at which the throttle stays closed [1]

constexpr double min_time_in_gear = 0.8;  // before a change for comfort [s]
constexpr double smoothing = 0.3;         // time constant of the throttle for the shift points [s]
constexpr double landing_room = 1.05, downshift_room = 0.85,
                 lower_gear_room = 0.95;  // hysteresis, as shares of speeds [1]

constexpr double stalling = 0.95, free = 1.05;  // shares of the idle speed: open the clutch below, close it above [1]
constexpr double synchronous = 0.03;            // slip over rotor speed below which the clutch closes [1]
// Launch: the clutch begins to engage at the first share and is fully engaged at the second; these are shares of the idle speed
// at closed throttle and, at full throttle, of a launch speed, which is a share of the upshift speed.
constexpr double biting = 1.02, held = 1.5, biting_fully = 0.75, held_fully = 1.25, launch_share = 0.55;

double between(double at_zero, double at_one, double share) {
    return at_zero + share * (at_one - at_zero);
}

double ramp(double from, double to, double at) {
    return std::clamp((at - from) / (to - from), 0.0, 1.0);
}

void check(int gear, const DrivenCar& car, const std::string& what) {
    if (car.gears == 0 || gear == 0 || (gear == -1 && car.has_reverse) || (gear > 0 && gear <= car.gears)) return;
    throw std::invalid_argument(what + " " + std::to_string(gear) + " does not exist: this vehicle has " +
                                (car.gears == 1 ? "one forward gear" : std::to_string(car.gears) + " forward gears") +
                                (car.has_reverse ? " and a reverse gear (-1)" : " and no reverse gear"));
}

}  // namespace

Shifting::Shifting(const ShiftingDescription& description, const DrivenCar& car)
    : car_(car),
      fixed_(description.gear.has_value()),
      ramps_(!car.has_clutch),
      first_(description.gear.value_or(description.first_gear)) {
    check(first_, car, fixed_ ? "gear" : "first gear");
    if (!fixed_ && car.gears > 0 && first_ < 1) {
        throw std::invalid_argument("the first gear must be a forward gear, found " + std::to_string(first_));
    }
}

double Shifting::ratio(int gear) const {
    return car_.gearbox.ratios[static_cast<std::size_t>(gear - 1)];
}

double Shifting::upshift_speed(double throttle) const {
    const double full = car_.gearbox.upshift_speed, closed = car_.gearbox.upshift_speed_closed;
    return between(closed > 0 ? closed : full, full, throttle);
}

// Speed at which a gear is left downward; below the speed at which an upshift into it ends.
double Shifting::downshift_speed(int gear, double throttle) const {
    const double full = car_.gearbox.downshift_speed, closed = car_.gearbox.downshift_speed_closed;
    const double wanted = std::max(between(closed > 0 ? closed : full, full, throttle), car_.idle_speed);
    if (car_.gearbox.upshift_speed <= 0) return wanted;
    return std::min(wanted, downshift_room * upshift_speed(throttle) * ratio(gear) / ratio(gear - 1));
}

double Shifting::launch_clutch(double rotor, double throttle) const {
    const double idle = car_.idle_speed, upshift = car_.gearbox.upshift_speed;
    const double launch = std::max(upshift > 0 ? launch_share * upshift : 2 * held * idle, held * idle);
    return 1 - ramp(between(biting * idle, biting_fully * launch, throttle),
                    between(held * idle, held_fully * launch, throttle), rotor);
}

// The gearbox input turns at `shaft` in gear `from`.
int Shifting::lower_gear(double shaft, double throttle, int from, int gear) const {
    const double output = shaft / ratio(from);
    while (gear > first_ && output * ratio(gear) < downshift_speed(gear, throttle)) {
        const double faster = output * ratio(gear - 1), limit = car_.gearbox.upshift_speed;
        if (limit > 0 && faster > lower_gear_room * limit) break;
        --gear;
    }
    return gear;
}

// `ground`: speed of the gearbox input with rolling wheels, so that locked wheels do not select first gear.
int Shifting::suitable_gear(const PowerUnitObservation& unit, double ground, const ShiftMemory& memory) const {
    const int gear = memory.gear;
    const double throttle = memory.throttle, shaft = std::max(unit.shaft_speed, ground);
    const bool rested = memory.clock >= min_time_in_gear, launching = memory.phase == Phase::launching;
    if (!launching && gear < car_.gears && car_.gearbox.upshift_speed > 0) {
        const double fastest = std::max(unit.speed, unit.shaft_speed), drop = ratio(gear + 1) / ratio(gear);
        const double throttle_after = throttle / drop;  // for the same force
        const bool lands =
            throttle_after <= 1 && shaft * drop > landing_room * downshift_speed(gear + 1, throttle_after);
        if (fastest >= upshift_speed(1) || (rested && lands && fastest >= upshift_speed(throttle))) return gear + 1;
    }
    return rested || launching ? lower_gear(shaft, throttle, gear, gear) : gear;
}

void Shifting::settle(const PowerUnitObservation& unit, ShiftMemory& memory) const {
    const bool slow = car_.has_clutch && memory.gear != 0 && unit.shaft_speed < stalling * car_.idle_speed;
    memory.phase = slow ? Phase::launching : Phase::driving;
    memory.clock = 0;
}

void Shifting::begin(const Observation& observation, double throttle, ShiftMemory& memory) const {
    const int in = static_cast<int>(std::round(observation.gear));
    const PowerUnitObservation& unit = observation.units[0];
    memory.gear = memory.next = first_;
    memory.throttle = throttle;
    if (!fixed_ && in >= 1 && in <= car_.gears) memory.gear = lower_gear(unit.shaft_speed, throttle, in, car_.gears);
    settle(unit, memory);
    memory.clock = min_time_in_gear;
}

Shifting::Decision Shifting::decide(const Observation& observation, double throttle, double interval,
                                    ShiftMemory& memory) const {
    const PowerUnitObservation& unit = observation.units[0];
    if (memory.phase == Phase::unbegun) begin(observation, throttle, memory);
    memory.throttle += (throttle - memory.throttle) * interval / (smoothing + interval);
    if (memory.phase != Phase::changing && !fixed_) {
        const double ground = car_.wheel_radius > 0 ? observation.speed / car_.wheel_radius * unit.wheel_ratio : 0;
        memory.next = suitable_gear(unit, ground, memory);
        if (memory.next != memory.gear) memory.phase = Phase::changing, memory.clock = 0;
    }
    memory.clock += interval;
    return memory.phase == Phase::changing ? change(unit, interval, memory) : hold(unit, memory);
}

Shifting::Decision Shifting::change(const PowerUnitObservation& unit, double interval, ShiftMemory& memory) const {
    const double time = car_.gearbox.shift_time;
    if (memory.clock > time - 0.5 * interval) {
        memory.gear = memory.next;
        settle(unit, memory);
        return hold(unit, memory);
    }
    const double share = memory.clock / time;
    if (ramps_) return {.gear = between(memory.gear, memory.next, share), .evenly = true};
    Decision out{.gear = static_cast<double>(share < lever ? memory.gear : memory.next)};
    const bool slow = unit.shaft_speed < stalling * car_.idle_speed;
    out.clutch = std::max(std::min(ramp(opening, open, share), 1 - ramp(closing, 1, share)),
                          slow ? launch_clutch(unit.speed, memory.throttle) : 0.0);
    const double overspeed = (unit.speed - unit.shaft_speed) / std::max(unit.speed, 1.0);
    out.throttle_share = share < lever ? 1 - ramp(0, lifted, share)
                                       : std::min(ramp(pressing, 1, share), 1 - ramp(0, large_slip, overspeed));
    if (share >= lever && share < pressing && unit.shaft_speed > unit.speed) {
        out.min_throttle = std::min((unit.shaft_speed - unit.speed) / (matching * unit.shaft_speed), 1.0);
    }
    return out;
}

// An automatic gearbox completes its change at the same constant rate.
Shifting::Decision Shifting::hold(const PowerUnitObservation& unit, ShiftMemory& memory) const {
    Decision out{.gear = static_cast<double>(memory.gear), .evenly = ramps_ && !fixed_};
    if (!car_.has_clutch || memory.gear == 0) return out;
    const double idle = car_.idle_speed;
    if (memory.phase == Phase::driving && unit.shaft_speed < stalling * idle) memory.phase = Phase::launching;
    if (memory.phase == Phase::launching && unit.shaft_speed > free * idle &&
        unit.speed - unit.shaft_speed < synchronous * unit.speed) {
        memory.phase = Phase::driving;
    }
    if (memory.phase == Phase::driving) return out;
    out.clutch = launch_clutch(unit.speed, memory.throttle);
    return out;
}

}  // namespace hamilcar
