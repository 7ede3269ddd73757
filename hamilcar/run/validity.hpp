// What limits the validity of a run: models used outside of their range, a step beyond a stability limit, an energy account
// that does not balance. One list, made by an observer of the run's samples, for every front end (docs/validity.md).
//
//     Simulation ─► Sample ─► ValidityMonitor ─► ValidityWarning ─► summary, report, JSON
//
// The observer looks at the samples that are recorded anyway, so a step costs nothing more; what happens between two rows and
// is over before the second goes unseen.
#pragma once

#include <span>
#include <vector>

#include "hamilcar/run/range_checks.hpp"
#include "hamilcar/run/step_stability.hpp"
#include "hamilcar/run/validity_warning.hpp"

namespace hamilcar {

// Looking at a sample allocates nothing, but where the step is compared with the vehicle's motions, a few times in a run.
class ValidityMonitor {
public:
    // Of a run from its start, or one that is gone on with: with the marks of its first part.
    explicit ValidityMonitor(const Simulation& simulation, std::span<const double> marks = {});

    void look(const Sample& sample);
    std::vector<ValidityWarning> warnings() const;

    // All that it remembers, for a checkpoint; finite numbers.
    std::vector<double> marks() const;
    // Whether these can be the marks of such a run.
    static bool fit(const Simulation& simulation, std::span<const double> marks);

private:
    // Of one check.
    struct Mark {
        double worst = 0, time = 0;     // [unit], [s]
        double since = -1;              // beyond the limit without a break [s]; -1: within
        double from = -1, to = -1;      // [s]; -1: never
        static constexpr int size = 5;  // numbers
    };
    void look(const RangeCheck& check, const Sample& sample, Mark& mark) const;
    ValidityWarning warning(const RangeCheck& check, const Mark& mark) const;

    std::vector<RangeCheck> checks_;
    std::vector<Mark> marks_;
    StepStability stability_;
};

}  // namespace hamilcar
