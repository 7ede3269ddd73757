#include "hamilcar/live/gear_lever.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hamilcar::live {

namespace {

using Phase = ShiftMemory::Phase;

constexpr double shifting_speed = 1;  // below which the direction may change [m/s]
constexpr double quickest = 20;       // full travel of a pedal that a change of gear works [1/s]

}  // namespace

GearLever::GearLever(const DrivenCar& car, double shaft_ratio, double step)
    : car_(car),
      shaft_ratio_(shaft_ratio),
      step_(step),
      choosing_(ShiftingDescription{}, car),
      keeping_(ShiftingDescription{.gear = 1}, car) {}

void GearLever::look(const Controls& held, double throttle, const Senses& senses, int steps) {
    ShiftMemory& memory = now_.memory;
    const bool chooses = held.selector == Selector::drive && memory.gear > 0;
    if (!chooses && memory.phase != Phase::changing) {
        const int wanted = wanted_gear(held, senses, throttle);
        if (wanted != memory.gear) change_to(wanted);
    }
    const Shifting& shifting = chooses ? choosing_ : keeping_;
    now_.decision = shifting.decide(senses, throttle, steps * step_, memory);
    if (!now_.begun) now_.at.clutch = now_.decision.clutch;
    now_.begun = true;
    now_.steps_left = steps;
}

int GearLever::wanted_gear(const Controls& held, const Senses& senses, double throttle) const {
    const int in = now_.memory.gear;
    if (held.selector == Selector::neutral) return 0;
    if (held.selector == Selector::reverse) {
        const bool goes_in = in < 0 || std::abs(senses.speed) < shifting_speed;
        return car_.has_reverse && goes_in ? -1 : 0;
    }
    if (in <= 0 && senses.speed < -shifting_speed) return 0;
    return held.selector == Selector::manual ? std::min(held.gear, car_.gears) : fitting_gear(senses, throttle);
}

// In neutral no shaft tells how fast a gear would turn it; the first decision of a driver in first gear is for this speed.
int GearLever::fitting_gear(const Senses& senses, double throttle) const {
    Senses in_first = senses;
    in_first.gear = 1;
    in_first.units[0].shaft_speed = car_.wheel_radius > 0 ? senses.speed / car_.wheel_radius * shaft_ratio_ : 0;
    ShiftMemory fresh;
    choosing_.decide(in_first, throttle, 0, fresh);
    return fresh.gear;
}

// The first gear is in as the drive begins. In a gearbox that passes from gear to gear evenly, neutral and a gear that is not
// next to it do not pass through those between.
void GearLever::change_to(int gear) {
    ShiftMemory& memory = now_.memory;
    const bool skips = !car_.has_clutch && std::min(memory.gear, gear) <= 0 && std::abs(gear - memory.gear) > 1;
    memory.next = gear, memory.clock = 0;
    memory.phase = Phase::changing;
    if (now_.begun && !skips) return;
    memory.gear = gear;
    memory.phase = car_.has_clutch ? Phase::launching : Phase::driving;
}

GearLever::Position GearLever::next(double clutch, double throttle) {
    const auto& [gear, evenly, wanted_clutch, share, least] = now_.decision;
    Position& at = now_.at;
    const bool arrives = !evenly || now_.steps_left <= 1;
    at.gear = arrives ? gear : at.gear + (gear - at.gear) / now_.steps_left;
    now_.steps_left = std::max(now_.steps_left - 1, 0);
    const double most = quickest * step_;
    at.clutch += std::clamp(wanted_clutch - at.clutch, -most, most);
    at.throttle += std::clamp(std::max(throttle * share, least) - at.throttle, -most, most);
    return {at.gear, std::max(at.clutch, clutch), at.throttle};
}

}  // namespace hamilcar::live
