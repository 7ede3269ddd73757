// A tire by itself, rolling steadily: its curves, and the figures that tires are compared by. What is evaluated is the tire
// as a step does, its deflections settled, so these are the curves that a simulation drives on.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/tire/list.hpp"

namespace hamilcar {

// Steady rolling on a plane of friction factor one.
struct SteadyRolling {
    double load = 0;              // [N]
    double kappa = 0, alpha = 0;  // longitudinal slip [1]; slip angle, positive for a motion to the left [rad]
    double camber = 0;            // top to the right positive [rad]
    double speed = 16.7;          // negative: backward [m/s]
};

TireForce<double> steady_force(const Tire<double>& tire, const SteadyRolling& rolling);

// At one load.
struct TireFigures {
    double load;                 // [N]
    double cornering_stiffness;  // -dFy/dalpha at zero [N/rad]
    double slip_stiffness;       // dFx/dkappa at zero [N]
    double camber_stiffness;     // -dFy/dgamma at zero [N/rad]
    double peak_y, peak_alpha;   // largest |Fy| / Fz to the one side, and where [1, rad]
    double peak_x, peak_kappa;   // largest Fx / Fz in driving [1, 1]
    double sliding_x;            // |Fx| / Fz of a locked wheel [1]
    double trail;                // pneumatic, at small slip angles [m]; NaN without cornering stiffness
};

TireFigures tire_figures(const Tire<double>& tire, double load);

// One of a family of curves: a quantity over slip, at a load.
struct TireCurve {
    double load;
    std::vector<double> slip;  // kappa [1], or alpha [rad]
    std::vector<TireForce<double>> force;
};

struct TireCurves {
    std::vector<TireCurve> longitudinal, lateral;  // pure slip
    std::vector<TireCurve> combined;               // over kappa at fixed slip angles; `load` the middle one's
    std::vector<double> combined_alpha;            // [rad]
};

TireCurves tire_curves(const Tire<double>& tire, const std::vector<double>& loads);

}  // namespace hamilcar
