#include "hamilcar/live/gear_lever.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hamilcar::live {

namespace {

using Phase = ShiftMemory::Phase;

constexpr double shifting_speed = 1;   // below which the direction may change [m/s]
constexpr double max_pedal_rate = 20;  // of a pedal during a gear change, full travels [1/s]

}  // namespace

GearLever::GearLever(const DrivenCar& car, double shaft_ratio, double step)
    : car_(car),
      shaft_ratio_(shaft_ratio),
      step_(step),
      automatic_(ShiftingDescription{}, car),
      manual_(ShiftingDescription{.gear = 1}, car) {}

void GearLever::decide(const Controls& controls, double throttle, const Observation& observation, int steps) {
    ShiftMemory& memory = now_.memory;
    const bool automatic = controls.selector == Selector::drive && memory.gear > 0;
    if (!automatic && memory.phase != Phase::changing) {
        const int wanted = wanted_gear(controls, observation, throttle);
        if (wanted != memory.gear) change_to(wanted);
    }
    const Shifting& shifting = automatic ? automatic_ : manual_;
    now_.decision = shifting.decide(observation, throttle, steps * step_, memory);
    if (!now_.begun) now_.at.clutch = now_.decision.clutch;
    now_.begun = true;
    now_.steps_left = steps;
}

int GearLever::wanted_gear(const Controls& controls, const Observation& observation, double throttle) const {
    const int engaged = now_.memory.gear;
    if (controls.selector == Selector::neutral) return 0;
    if (controls.selector == Selector::reverse) {
        const bool may_engage = engaged < 0 || std::abs(observation.speed) < shifting_speed;
        return car_.has_reverse && may_engage ? -1 : 0;
    }
    if (engaged <= 0 && observation.speed < -shifting_speed) return 0;
    return controls.selector == Selector::manual ? std::min(controls.gear, car_.gears)
                                                 : suitable_gear(observation, throttle);
}

// In neutral the shaft speed does not follow from the wheels. The first decision of a driver in first gear at this speed serves
// instead.
int GearLever::suitable_gear(const Observation& observation, double throttle) const {
    Observation in_first = observation;
    in_first.gear = 1;
    in_first.units[0].shaft_speed = car_.wheel_radius > 0 ? observation.speed / car_.wheel_radius * shaft_ratio_ : 0;
    ShiftMemory fresh;
    automatic_.decide(in_first, throttle, 0, fresh);
    return fresh.gear;
}

// The first gear is engaged at once when the drive begins. In a gearbox that interpolates between gears, a change between neutral
// and a gear that is not next to it skips those between.
void GearLever::change_to(int gear) {
    ShiftMemory& memory = now_.memory;
    const bool jumps = !car_.has_clutch && std::min(memory.gear, gear) <= 0 && std::abs(gear - memory.gear) > 1;
    memory.next = gear, memory.clock = 0;
    memory.phase = Phase::changing;
    if (now_.begun && !jumps) return;
    memory.gear = gear;
    memory.phase = car_.has_clutch ? Phase::launching : Phase::driving;
}

GearLever::Position GearLever::next(double clutch, double throttle) {
    const auto& [gear, evenly, wanted_clutch, share, min_throttle] = now_.decision;
    Position& at = now_.at;
    const bool arrives = !evenly || now_.steps_left <= 1;
    at.gear = arrives ? gear : at.gear + (gear - at.gear) / now_.steps_left;
    now_.steps_left = std::max(now_.steps_left - 1, 0);
    const double max_change = max_pedal_rate * step_;
    at.clutch += std::clamp(wanted_clutch - at.clutch, -max_change, max_change);
    at.throttle += std::clamp(std::max(throttle * share, min_throttle) - at.throttle, -max_change, max_change);
    return {at.gear, std::max(at.clutch, clutch), at.throttle};
}

}  // namespace hamilcar::live
