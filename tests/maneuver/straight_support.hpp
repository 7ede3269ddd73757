// A maneuver straight ahead on the shipped car, with some settings chosen.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "support/car.hpp"

namespace hamilcar::test {

inline Outcome driven_straight(
    const Maneuver& maneuver, const VehicleDescription& car, const Settings& chosen = {},
    std::function<bool(double)> keep_going = [](double) { return true; }) {
    ManeuverOptions options;
    options.keep_runs = false;
    options.keep_going = std::move(keep_going);
    return maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
}

inline double figure_named(const Outcome& outcome, const std::string& name) {
    const auto figure = std::ranges::find(outcome.figures, name, &Figure::name);
    if (figure == outcome.figures.end()) ADD_FAILURE() << "no figure " << name;
    return figure == outcome.figures.end() ? std::numeric_limits<double>::quiet_NaN() : figure->value;
}

inline const Verdict* verdict_about(const Outcome& outcome, const std::string& words) {
    const auto verdict = std::ranges::find_if(
        outcome.verdicts, [&](const Verdict& one) { return one.criterion.find(words) != std::string::npos; });
    return verdict == outcome.verdicts.end() ? nullptr : &*verdict;
}

inline void expect_bad_settings(const Maneuver& maneuver, const Settings& chosen) {
    try {
        driven_straight(maneuver, shipped_car(), chosen);
        ADD_FAILURE() << "settings are taken that make no sense";
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::bad_file);
    }
}

// Where somebody says stop.
inline void expect_interruptible(const Maneuver& maneuver) {
    const Outcome outcome = driven_straight(maneuver, shipped_car(), {}, [](double done) { return done < 0.01; });
    ASSERT_TRUE(outcome.failed);
    EXPECT_EQ(*outcome.failed, "interrupted");
    EXPECT_FALSE(outcome.passed());
}

}  // namespace hamilcar::test
