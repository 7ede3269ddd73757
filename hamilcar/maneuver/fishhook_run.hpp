// One run of the fishhook, and how near it came to tipping over.
#pragma once

#include "hamilcar/maneuver/runs.hpp"

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
    double roll = 0;                  // largest [rad]
    double lateral_acceleration = 0;  // largest, smoothed [m/s^2]
};

class Fishhook {
public:
    // `angle`: of the steering wheel, each way [rad].
    Fishhook(const VehicleDescription& vehicle, const ManeuverOptions& options, double angle, bool feedback);

    // Fills in what was found; `from` and `to`: the run's share of the maneuver.
    Trial drive(Run& run, bool film, double from, double to) const;

private:
    Trial turn(const Run& run, bool film, bool first_turn_only, std::function<bool(double)> keep_going) const;

    const VehicleDescription& vehicle_;
    const ManeuverOptions& options_;
    double angle_;
    bool feedback_;
};

// How long after the wheel has reached its first angle, at `reached` [s], the roll rate has come down to 1.5 deg/s; 1.5 s if
// it does not [s].
double calm_after(const History& history, double reached);

// Lift, roll and lateral acceleration.
void evaluate(const VehicleDescription& vehicle, const Trial& trial, Run& run);

}  // namespace hamilcar::fishhook_run
