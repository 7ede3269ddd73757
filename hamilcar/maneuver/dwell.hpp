// One run of the sine with dwell, what FMVSS 126 reads off it, and what it and UN R140 ask of all runs.
#pragma once

#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar::dwell {

inline constexpr double frequency = 0.7, pause = 0.5;  // [Hz], [s]
inline constexpr double steering = 1, lift = 0.9;      // when the wheel begins to turn, when the foot leaves [s]
inline constexpr double end = steering + 1 / frequency + pause;  // completion of steer [s]
inline constexpr double early = 1, late = 1.75;                  // after completion of steer [s]
inline constexpr double displacement_time = 1.07;                // after the beginning of steer [s]
inline constexpr double begun = 5;                               // of the wheel: where steering counts as begun [deg]
inline constexpr double early_limit = 35, late_limit = 20;       // of the yaw rate's peak [%]
inline constexpr double answering = 5;                           // from which on the displacement counts [A]
inline constexpr double stopped = 3;  // slower a vehicle hardly turns whatever it did before [m/s]

struct Run {
    double amplitude;                            // with the sign of the first half wave [deg]
    double factor;                               // over A [1]
    double early = not_shown, late = not_shown;  // yaw rate over its peak [%]
    double peak = not_shown;                     // of the yaw rate [deg/s]
    double displacement = not_shown;  // twice the integral of lateral acceleration, as the standard has it [m]
    double path = not_shown;          // of the center of mass across the first heading, for comparison [m]
    double sideslip = 0;              // largest [deg]
    double last_speed = not_shown;    // over the ground, when the later yaw rate is read [m/s]
    double size() const { return std::abs(amplitude); }
};

// The steering wheel over time [s], [rad].
SignalDescription sine(double amplitude);

// From a straight drive at a speed [m/s], coasting.
Drive drive(const TestRun& test, double speed, const Run& run, const DriveOptions& options);

// What the standard evaluates; what the recording does not show stays NaN.
Run evaluated(const Recording& recording, double amplitude, double factor);

// 1.83 m, or 1.52 m of a heavy vehicle.
double displacement_limit(const VehicleDescription& vehicle);

// Three verdicts, two where no run went to 5 A, each telling the run that is farthest from passing; notes beside them.
void add_verdicts(TestRun& test, const std::vector<Run>& runs);

}  // namespace hamilcar::dwell
