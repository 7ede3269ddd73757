// The ranges within which a vehicle's models are valid, and how to read from a sample where a run stands in them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct RangeCheck {
    std::string kind, where, quantity, unit;
    double min, max;      // in that unit, ends included
    double patience = 0;  // how long it may be beyond them without a word [s]
    std::string meaning, advice;
    std::function<double(const Sample&)> read;  // NaN where there is nothing to judge
};

// Of the linear tire's friction the share up to which real tires are linear: a brush with uniform pressure is so exactly up to
// one half, where its contact begins to slide, and one with parabolic pressure lies a sixth below the line there.
inline constexpr double linear_share = 0.5;
// Below this speed of a wheel a slip is no measure of the tire's force [m/s].
inline constexpr double min_slip_speed = 2;
// How long all wheels of an axle or a side may be off the ground: longer than over a bump [s].
inline constexpr double lift_patience = 0.2;
// Between the vertical axis of a unit and the road's normal, up to which the ground contact means something [deg].
inline constexpr double max_inclination = 45;
// How far from a measured road a wheel may be: the width of a tire, which the road's edge cuts [m].
inline constexpr double road_margin = 0.1;

std::vector<RangeCheck> range_checks(const VehicleDescription& vehicle, const ScenarioDescription& scenario);

}  // namespace hamilcar
