// How far the energy account may be off, as a share of the energy that was moved: what a step too large costs grows
// from round-off to nonsense without a sign in the driving itself, so these bounds are said once, for runs and
// maneuvers alike.
#pragma once

#include <limits>

namespace hamilcar {

struct EnergyBounds {
    static constexpr double doubtful = 0.01;  // above: a warning
    static constexpr double wrong = 0.1;      // above: a failure; these numbers are no motion of the vehicle
    static constexpr double least = 1;        // what a vehicle at rest may be off without a word [J]
};

enum class EnergyVerdict { fine, doubtful, wrong };

// Of a balance that is `error` off where `turnover` was moved in all, both [J]. A NaN, where no account is kept, is fine.
constexpr EnergyVerdict judge_energy(double error, double turnover) {
    const double size = error < 0 ? -error : error;
    if (!(size > EnergyBounds::least)) return EnergyVerdict::fine;
    if (size > EnergyBounds::wrong * turnover || size > std::numeric_limits<double>::max()) return EnergyVerdict::wrong;
    return size > EnergyBounds::doubtful * turnover ? EnergyVerdict::doubtful : EnergyVerdict::fine;
}

}  // namespace hamilcar
