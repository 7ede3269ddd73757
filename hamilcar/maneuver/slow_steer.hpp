// The slowly increasing steer test of FMVSS 126 (S7.6) and NHTSA's rollover test: at a held speed the steering wheel turns at
// 13.5 deg/s, and a straight line through steering wheel angle over lateral acceleration tells the angle A for 0.3 g. All
// amplitudes of sine with dwell and fishhook are multiples of it.
#pragma once

#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar {

// Of FMVSS 126's data: phaseless, 12 poles, 6 Hz. Order 6 forward and backward.
std::vector<double> smoothed(const Series& series);

struct SlowSteer {
    double angle = 0;      // A: of the steering wheel at 0.3 g [deg]
    double r_squared = 0;  // of the line, the worse of both directions
    double reached = 0;    // largest lateral acceleration, the lesser of both directions [m/s^2]
    std::vector<io::Curve>
        over;  // |lateral acceleration| over |steering wheel angle|, [m/s^2] over [deg], a curve a direction
};

// To the left and to the right at a speed [m/s], as a share of the maneuver. Adds its energy, the line's figure and diagram,
// and a note where the line had to be drawn further than the vehicle went; nothing, and the maneuver has failed, where there is
// no line.
std::optional<SlowSteer> slow_steer(TestRun& test, double speed, Share share);

}  // namespace hamilcar
