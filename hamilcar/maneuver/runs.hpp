// A maneuver of several runs: how each tells its share, and how what it found is kept.
#pragma once

#include <cmath>

#include "hamilcar/maneuver/common.hpp"

namespace hamilcar {

// What one of several runs tells the maneuver's listener while its own share goes from 0 to 1.
inline std::function<bool(double)> share(const ManeuverOptions& options, double from, double to) {
    return [&options, from, to](double done) { return options.keep_going(from + (to - from) * done); };
}

// Lateral acceleration at which the vehicle would tip over were it rigid: g track / (2 height of the center of mass), of the
// narrowest axle and everything that the vehicle carries [m/s^2].
double tipping_acceleration(const VehicleDescription& vehicle);

// A steering wheel that is turned evenly from corner to corner of (time [s], angle [rad]), finely enough that the rack's
// rate is continuous and the ramps are straight.
SignalDescription turned(const std::vector<std::array<double, 2>>& corners);

// The driver holds `speed` [m/s] up to `time` [s] and then takes the foot off the throttle; nobody brakes.
void lift_foot(ScenarioDescription& scenario, double speed, double time);

// To a whole multiple of `step`, downward: usual values that a person would type.
inline double rounded_down(double value, double step) {
    return step * std::floor(value / step + 1e-9);
}

}  // namespace hamilcar
