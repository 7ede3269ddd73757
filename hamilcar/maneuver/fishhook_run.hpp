// One run of the fishhook, and how near it came to tipping over.
#pragma once

#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar::fishhook_run {

// That a side is off the road, to count as two-wheel lift. NHTSA asks for two inches under both wheels; one thrown up and
// falling back at two thirds of g is that high after so long a flight [s].
inline constexpr double tip_up_time = 0.25;
inline constexpr double fixed_dwell = 0.25;  // of the wheel at its first angle [s]

struct Run {
    double speed;                     // [km/h]
    double side;                      // 1: to the left first, -1: to the right
    double dwell = fixed_dwell;       // [s]
    bool tips = false;                // two-wheel lift, or worse
    double lightest = 1;              // least load of a side of any unit over what it carries standing [1]
    double lifted = 0;                // how long a side of any unit was off the road [s]
    double roll = 0;                  // largest [deg]
    double lateral_acceleration = 0;  // largest, smoothed [m/s^2]
};

// Turns the steering wheel by `angle` each way [rad], and fills in what was found. With feedback it is driven twice: the first
// time the wheel stays at its first angle, and its roll rate tells the dwell.
Drive drive(const TestRun& test, Run& run, double angle, bool feedback, Share share);

// How long after the wheel has reached its first angle, at `reached` [s], the roll rate has come down to 1.5 deg/s; 1.5 s if
// it does not [s].
double calm_after(const Recording& recording, double reached);

// Lift, roll and lateral acceleration.
void evaluate(const VehicleDescription& vehicle, const Drive& drive, Run& run);

}  // namespace hamilcar::fishhook_run
