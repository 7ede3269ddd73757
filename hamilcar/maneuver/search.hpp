// The search for a limit by trying: outward until it is passed, then bisection.
#pragma once

#include <cmath>
#include <optional>

#include "hamilcar/maneuver/test_run.hpp"

namespace hamilcar {

// The highest level that went well so far and the lowest above it that did not; NaN where there is none.
struct Bracket {
    double low = not_shown, high = not_shown;

    double middle() const { return 0.5 * (low + high); }
    bool is_open(double finest) const { return !(high - low <= finest); }
};

// Tries one level after the other until both ends are `finest` apart. `next(bracket)` tells the next level, `try_level(level)`
// whether it went well; nothing from either of them ends the search.
template <class Next, class Try>
void narrow(Bracket& bracket, double finest, Next&& next, Try&& try_level) {
    while (bracket.is_open(finest)) {
        const std::optional<double> level = next(bracket);
        const std::optional<bool> went_well = level ? try_level(*level) : std::nullopt;
        if (!went_well) return;
        (*went_well ? bracket.low : bracket.high) = *level;
    }
}

}  // namespace hamilcar
