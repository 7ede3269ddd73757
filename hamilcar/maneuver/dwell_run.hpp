// One run of the sine with dwell, and what FMVSS 126 reads off it.
#pragma once

#include <limits>

#include "hamilcar/maneuver/runs.hpp"

namespace hamilcar::dwell {

inline constexpr double frequency = 0.7, pause = 0.5;  // [Hz], [s]
inline constexpr double steering = 1, lift = 0.9;      // when the wheel begins to turn, when the foot leaves [s]
inline constexpr double end = steering + 1 / frequency + pause;  // completion of steer [s]
inline constexpr double early = 1, late = 1.75;                  // after completion of steer [s]
inline constexpr double displacement_time = 1.07;                // after the beginning of steer [s]
inline constexpr double begun = 5 * degree;                      // of the wheel: where steering counts as begun
inline constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

struct Run {
    double amplitude;                        // with the sign of the first half wave [rad]
    double factor;                           // over A [1]
    double early = nowhere, late = nowhere;  // yaw rate over its peak [%]
    double peak = nowhere;                   // of the yaw rate [rad/s]
    double displacement = nowhere;           // twice the integral of lateral acceleration, as the standard has it [m]
    double path = nowhere;                   // of the center of mass across the first heading, for comparison [m]
    double sideslip = 0;                     // largest [rad]
};

// The steering wheel over time [s], [rad].
SignalDescription sine(double amplitude);

// From a straight drive at a speed [m/s], coasting.
Trial drive_run(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed, const Run& run,
                bool film, std::function<bool(double)> keep_going);

// What the standard evaluates; what the history does not show stays NaN.
void evaluate(const History& history, Run& run);

}  // namespace hamilcar::dwell
