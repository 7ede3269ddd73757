// Maneuvers, most of them of lateral dynamics, driven with some settings of one's own, and their figures by name.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/scenarios.hpp"
#include "support/fleet.hpp"

namespace hamilcar::test {

inline Outcome driven(const Maneuver& maneuver, const VehicleDescription& car, const Settings& chosen,
                      double friction = 1) {
    ManeuverOptions options;
    options.keep_runs = false;
    options.road.friction = friction;
    return maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
}

// A name that no figure has is a mistake of the test: NaN is also what a drive did not show.
inline double figure(const Outcome& outcome, const std::string& name) {
    const auto found = std::ranges::find(outcome.figures, name, &Figure::name);
    if (found != outcome.figures.end()) return found->value;
    ADD_FAILURE() << "no figure " << name;
    return std::numeric_limits<double>::quiet_NaN();
}

inline void expect_share(double value, double wanted, double tolerance, const std::string& what) {
    EXPECT_NEAR(value, wanted, tolerance * std::abs(wanted)) << what;
}

// The curve of a chart, by the chart's title and the curve's place.
inline const io::Curve& curve(const Outcome& outcome, const std::string& title, std::size_t place = 0) {
    const auto found = std::ranges::find(outcome.charts, title, &io::Chart::title);
    if (found == outcome.charts.end()) throw std::out_of_range("no chart " + title);
    return found->curves.at(place);
}

// A setting out of range, and one that does not exist, are a person's mistakes.
inline void expect_settings_checked(const Maneuver& maneuver, const std::string& setting, double value) {
    const VehicleDescription car = shipped_car();
    EXPECT_THROW(complete_settings(maneuver, car, {{setting, value}}), io::Error) << setting;
    EXPECT_THROW(complete_settings(maneuver, car, {{"no_such_setting", 1}}), io::Error);
}

// Where nothing steers, or nothing drives, there is no test.
inline void expect_obstacles(const Maneuver& maneuver) {
    VehicleDescription car = shipped_car();
    EXPECT_EQ(maneuver.unsupported_reason(car), "");
    car.steering = {};
    EXPECT_NE(maneuver.unsupported_reason(car), "");
}

// Told to stop at the first occasion.
inline void expect_interruptible(const Maneuver& maneuver, const Settings& chosen) {
    const VehicleDescription car = shipped_car();
    ManeuverOptions options;
    options.keep_runs = false;
    options.keep_going = [](double) { return false; };
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
    EXPECT_EQ(outcome.failed, "interrupted");
    EXPECT_FALSE(outcome.passed());
}

// Gains and phases of the diagrams against linear theory, which stands beside them, from `lowest` to `highest` Hz.
inline void expect_linear_response(const Outcome& outcome, double lowest, double highest, double tolerance) {
    for (const std::string of : {"yaw rate", "lateral acceleration"}) {
        const io::Curve &gain = curve(outcome, of + " gain"), &linear = curve(outcome, of + " gain", 1);
        const io::Curve &phase = curve(outcome, of + " phase"), &linear_phase = curve(outcome, of + " phase", 1);
        std::size_t compared = 0;
        for (std::size_t i = 0; i < gain.x.size(); ++i) {
            if (gain.x[i] < lowest || gain.x[i] > highest) continue;
            const std::string where = of + " at " + std::to_string(gain.x[i]) + " Hz";
            expect_share(gain.y[i], linear.y[i], tolerance, where);
            EXPECT_NEAR(phase.y[i], linear_phase.y[i], tolerance / degree) << where;
            ++compared;
        }
        EXPECT_GT(compared, 5u) << of;
    }
}

}  // namespace hamilcar::test
