// How one wheel stands and can move in its linkage, whatever carries it; the chassis held still.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/block/integration.hpp"

namespace hamilcar {

// A length that the independent coordinates change: a spring's or a damper's.
struct LineMotion {
    std::string name;              // of the wheel it belongs to
    double length;                 // [m]
    std::vector<double> gradient;  // per independent coordinate of the suspension
    double force;                  // of a spring at this length [N]; 0 of a damper
};

struct WheelMotion {
    std::string name;
    Vec3<double> center, axis;  // [m]; spin axis
    Vec3<double> design_center, design_axis;
    double radius;                                        // unloaded [m]
    std::vector<int> coordinates;                         // of the suspension's independent ones, in the state
    std::vector<Spatial<double>> J;                       // motion of the carrier per independent coordinate
    Spatial<double> steer = Spatial<double>::Zero();      // and per unit of rack, these held still
    Spatial<double> own_steer = Spatial<double>::Zero();  // likewise of the rack of an axle that has its own
    std::vector<LineMotion> springs, dampers;             // its own, or all of a suspension that carries both wheels
    std::vector<double> bar_arm;  // angle of an anti-roll bar's arm per independent coordinate; empty without one
    bool own_differential;  // the axle holds it: drive acts at the contact as a brake does, not at the wheel's center
};

// Wheels of the motor vehicle and its trailers in the order of the description.
std::vector<WheelMotion> wheel_motions(const VehicleDescription& description, const Model<double>& model,
                                       const State<double>& state, double rack);

}  // namespace hamilcar
