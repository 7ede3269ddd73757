#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/test_run.hpp"

namespace hamilcar {

namespace {

// What holds of every maneuver: one that was broken off has no verdicts, since what was not driven was not met, and where the
// mathematics failed there are no figures either.
void judge(Outcome& outcome) {
    const EnergyBalance& energy = outcome.energy;
    if (outcome.stopped == Stopped::no && judge_energy(energy.error(), energy.exchanged) == EnergyVerdict::wrong) {
        outcome.stopped = Stopped::numerical;
        outcome.failed = fmt::format("the energy account of all drives is off by {:.2g} J of {:.2g} J exchanged",
                                     energy.error(), energy.exchanged);
    }
    if (outcome.stopped != Stopped::no) outcome.verdicts.clear();
    if (outcome.stopped == Stopped::numerical) outcome.figures.clear(), outcome.charts.clear();
}

}  // namespace

Outcome Maneuver::drive(const VehicleDescription& vehicle, const Settings& complete,
                        const ManeuverOptions& options) const {
    try {
        TestRun test(*this, vehicle, complete, options);
        run(test);
        judge(test.outcome);
        return std::move(test.outcome);
    } catch (const NoSolution& problem) {
        throw io::Error(io::ExitCode::numerical, problem.what());
    }
}

const std::vector<Maneuver>& maneuvers() {
    static const std::vector<Maneuver> all{
        constant_radius(),
        constant_speed(),
        constant_steer(),
        step_steer(),
        sine_steer(),
        pulse_steer(),
        random_steer(),
        weave(),
        double_lane_change(),
        obstacle_avoidance(),
        braking_in_turn(),
        power_off_in_turn(),
        sine_with_dwell(),
        fishhook(),
        straight_braking(),
        split_braking(),
        acceleration(),
        coast_down(),
        cleat(),
        rough_road(),
    };
    return all;
}

const Maneuver* find_maneuver(const std::string& name) {
    const auto found = std::ranges::find(maneuvers(), name, &Maneuver::name);
    return found == maneuvers().end() ? nullptr : &*found;
}

const Maneuver& require_maneuver(const std::string& name) {
    if (const Maneuver* maneuver = find_maneuver(name)) return *maneuver;
    std::vector<std::string_view> names;
    for (const Maneuver& maneuver : maneuvers()) names.push_back(maneuver.name);
    const std::string hint = io::did_you_mean(name, names);
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("there is no maneuver '{}': expected {}{}", name, io::quoted_list(names),
                                hint.empty() ? "" : "; " + hint),
                    "maneuver.name");
}

void require_support(const Maneuver& maneuver, const VehicleDescription& vehicle) {
    const std::string reason = maneuver.unsupported_reason(vehicle);
    if (reason.empty()) return;
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("{} cannot do the maneuver '{}': {}", vehicle.name, maneuver.name, reason),
                    "maneuver.name");
}

}  // namespace hamilcar
