// How far the energy account may be off, as a share of the energy that was moved: what a step too large costs grows
// from round-off to nonsense without a sign in the driving itself, so these bounds are said once, for runs and
// maneuvers alike.
#pragma once

#include <limits>

namespace hamilcar {

struct EnergyBounds {
    static constexpr double doubtful = 0.001;  // above: told as a limit of validity (docs/validity.md)
    static constexpr double wrong = 0.1;       // above: a failure; these numbers are no motion of the vehicle
    static constexpr double ignored = 1;       // what a vehicle at rest may be off without a word [J]
};

// What a balance is off by, of the difference found [J]: a NaN where no account is kept, infinite where numbers that
// are too large have left none.
constexpr double account_error(double difference, bool is_kept) {
    if (!is_kept) return std::numeric_limits<double>::quiet_NaN();
    if (difference != difference) return std::numeric_limits<double>::infinity();
    return difference < 0 ? -difference : difference;
}

enum class EnergyVerdict { fine, doubtful, wrong };

// Of an `account_error` where `exchanged` was moved in all, both [J].
constexpr EnergyVerdict judge_energy(double error, double exchanged) {
    if (!(error > EnergyBounds::ignored)) return EnergyVerdict::fine;
    if (!(error <= EnergyBounds::wrong * exchanged && error <= std::numeric_limits<double>::max())) {
        return EnergyVerdict::wrong;
    }
    return error > EnergyBounds::doubtful * exchanged ? EnergyVerdict::doubtful : EnergyVerdict::fine;
}

}  // namespace hamilcar
