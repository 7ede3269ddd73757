// The slowly increasing steer test of FMVSS 126 (S7.6) and NHTSA's rollover test: at a held speed the steering wheel turns at
// 13.5 deg/s, and a straight line through steering wheel angle over lateral acceleration tells the angle A for 0.3 g. All
// amplitudes of sine with dwell and fishhook are multiples of it.
#pragma once

#include "hamilcar/maneuver/runs.hpp"

namespace hamilcar {

// Of FMVSS 126's data: phaseless, 12 poles, 6 Hz. Order 6 forward and backward.
std::vector<double> smoothed(const std::vector<double>& values, double rate);

// The rate of a history's rows [Hz].
double row_rate(const History& history);

struct SlowSteer {
    double angle = 0;      // A: of the steering wheel at 0.3 g [rad]
    double r_squared = 0;  // of the line, the worse of both directions
    double reached = 0;    // largest lateral acceleration, the lesser of both directions [m/s^2]
    std::vector<io::Curve>
        over;  // |lateral acceleration| over |steering wheel angle|, [m/s^2] over [deg], a curve a direction
    std::optional<std::string> failed;  // why there is no angle
};

// To the left and to the right at a speed [m/s]; `from` and `to`: its share of the maneuver. Adds its energy, and a note where
// the line had to be drawn further than the vehicle went.
SlowSteer slow_steer(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed, double from,
                     double to, Outcome& outcome);

// The line's figure and diagram.
void add_slow_steer(const SlowSteer& test, Outcome& outcome);

}  // namespace hamilcar
