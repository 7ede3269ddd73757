// Suspension kinematics: an axle moved through bump, roll and steer while the chassis is held at its design attitude, and
// what engineers read off. Angles in radians, ISO 8855; a wheel's figures are those of its own side (toe-in, camber top
// outboard, scrub with the axis inboard of the contact are positive on either side).
#pragma once

#include <string>
#include <vector>

#include "hamilcar/analysis/wheel_motion.hpp"

namespace hamilcar {

// One wheel at one position. What needs a steering axis is NaN on an axle without one.
struct WheelFigures {
    double travel;                      // [m] of the wheel center against design
    double toe, camber, steer;          // [rad]; steer to the left
    double caster, inclination;         // of the steering axis [rad]
    double scrub, trail;                // of its foot on the road against the contact: inboard, ahead [m]
    double center_x, contact_y;         // movement of center and contact point, forward and outward [m]
    double spring_ratio, damper_ratio;  // of the first spring and damper: shortening per wheel travel [1]
    double wheel_rate;               // of the vertical force that the springs need, both wheels moving together [N/m]
    double dive_slope, drive_slope;  // forward movement per travel: of the contact, of where the drive pushes [1]
};

struct AxleFigures {
    double travel, roll, rack;  // what was asked for [m], [rad], [m]
    WheelFigures left, right;
    double track_change;    // [m]
    double roll_center;     // height over the road at design [m]
    double roll_stiffness;  // moment of the springs against the body's roll per angle, without bars [N m/rad]
    double bar_twist;       // of an anti-roll bar with arms per difference of the wheels' travels [rad/m]; NaN without
    double ackermann;       // inner wheel's steer less what the outer one's calls for [rad]; NaN while straight
};

struct Sweep {
    std::string name;  // "bump", "roll", "steer"
    std::vector<AxleFigures> rows;
    std::size_t design = 0;  // the row at design, where there are rows
    std::string ended;       // empty, or why it ends before the range was through
};

struct AxleReport {
    std::string name;
    AxleFigures design;
    std::vector<Sweep> sweeps;
    double anti_brake;  // NaN with a trailer; anti-dive of a front axle, anti-lift of a rear one [percent of full]
    double anti_drive;  // anti-lift of a front axle, anti-squat of a rear one [percent of full]
};

struct SweepRange {
    double travel = 0.08;  // each way [m]
    double roll = 0.07;    // [rad]
    int steps = 40;        // from end to end
};

// Every axle of the vehicle that has two wheels. Throws NoSolution where the vehicle does not assemble at design.
std::vector<AxleReport> kinematics(const VehicleDescription& vehicle, const SweepRange& range);

}  // namespace hamilcar
