// Steering column: the ratio from steering wheel to rack, constant or varying with the angle.
#pragma once

#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/math/signal.hpp"

namespace hamilcar {

// Rack displacement as an odd function of the steering wheel's angle, with a continuous slope: monotone cubics through the points
// of a table (Fritsch and Butland 1984), straight beyond them.
class Column {
public:
    Column() = default;
    explicit Column(const SteeringDescription& steering);

    bool exists() const { return center_ratio_ > 0; }
    // Rack displacement [m] and its derivatives [m/rad], [m/rad^2] at an angle [rad].
    struct Rack {
        double displacement, slope, curvature;
    };
    Rack rack(double angle) const;
    // The angle for a rack displacement [rad].
    double angle(double displacement) const;
    // Motion of the rack for a motion of the steering wheel.
    SignalValue<double> rack_motion(const SignalValue<double>& angle) const;
    double center_ratio() const { return center_ratio_; }  // rack per angle, straight ahead [m/rad]

private:
    double center_ratio_ = 0;
    std::vector<double> angle_, rack_, slope_;  // of the curve's points, both sides; empty: constant ratio
};

}  // namespace hamilcar
