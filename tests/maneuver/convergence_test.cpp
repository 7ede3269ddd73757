// Figures converge with the step: what the usual step leaves of an error is small against the figure, and a shorter one
// leaves less of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/test_run.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

struct Watched {
    const char* maneuver;
    const char* figure;
    double tolerance;  // at the usual step, of the figure
};

void PrintTo(const Watched& watched, std::ostream* out) {
    *out << watched.maneuver;
}

class Convergence : public testing::TestWithParam<Watched> {};

double figure(const Watched& watched, double step) {
    const VehicleDescription car = test::shipped_car();
    const Maneuver& maneuver = *find_maneuver(watched.maneuver);
    ManeuverOptions options;
    options.solver.step = step;
    options.keep_runs = false;
    Settings chosen;
    for (const Setting& setting : maneuver.settings(car)) {
        if (setting.name == "search" || setting.name == "top_speed") chosen[setting.name] = 0;
        if (setting.name == "amplitudes") chosen[setting.name] = std::max(setting.min, 1.0);
    }
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
    for (const Figure& one : outcome.figures) {
        if (one.name == watched.figure) return one.value;
    }
    ADD_FAILURE() << "no figure '" << watched.figure << "'";
    return 0;
}

TEST_P(Convergence, WithTheStep) {
    const Watched& watched = GetParam();
    const double finest = figure(watched, 2.5e-4);
    const double usual = std::abs(figure(watched, 1e-3) - finest), half = std::abs(figure(watched, 5e-4) - finest);
    EXPECT_LT(usual, watched.tolerance * std::abs(finest)) << finest;
    EXPECT_NE(usual, 0) << "the step is not used";
    EXPECT_LE(half, std::max(usual, 1e-6 * std::abs(finest))) << usual;
}

INSTANTIATE_TEST_SUITE_P(
    Maneuvers, Convergence,
    testing::Values(
        Watched{"constant_radius", "understeer gradient", 1e-3}, Watched{"constant_speed", "understeer gradient", 1e-3},
        Watched{"constant_steer", "understeer gradient", 1e-3}, Watched{"step_steer", "yaw rate response time", 5e-3},
        Watched{"sine_steer", "yaw rate gain", 1e-3}, Watched{"pulse_steer", "yaw rate gain", 1e-3},
        Watched{"random_steer", "yaw rate gain at the lowest line", 1e-3},
        Watched{"weave", "steering sensitivity", 1e-3},
        Watched{"double_lane_change", "largest lateral acceleration", 0.02},
        Watched{"obstacle_avoidance", "largest lateral acceleration", 0.05},
        Watched{"braking_in_turn", "lateral acceleration", 5e-3},
        Watched{"sine_with_dwell", "steering wheel angle at 0.3 g", 1e-3},
        Watched{"fishhook", "largest roll angle", 0.02}, Watched{"straight_braking", "stopping distance", 5e-3},
        Watched{"split_braking", "yaw rate after 1 s", 0.02}, Watched{"acceleration", "0 to 100 km/h", 5e-3},
        Watched{"coast_down", "drag area", 1e-3}, Watched{"cleat", "peak acceleration upward", 0.02},
        Watched{"rough_road", "a_wz", 5e-3}),
    [](const auto& watched) { return std::string(watched.param.maneuver); });

}  // namespace
}  // namespace hamilcar
