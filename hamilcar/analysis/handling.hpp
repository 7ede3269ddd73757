// Handling of a vehicle at small deviations from a steady motion: what it answers to the steering wheel in the end (ISO 4138)
// and on the way (ISO 7401), from the exact linearization.
#pragma once

#include <complex>
#include <vector>

#include "hamilcar/analysis/linear_model.hpp"

namespace hamilcar {

// Where steady motions go when the steering changes a little. Gains are those at constant speed; left is positive. What needs
// the steering wheel's ratio is NaN for a vehicle without one.
struct SteadyHandling {
    double speed, lateral_acceleration;  // of the motion itself [m/s], [m/s^2]
    double drive_torque;                 // that keeps its speed [N m]

    // Per displacement of the rack.
    double yaw_rate_gain;              // [rad/s/m]
    double lateral_acceleration_gain;  // [m/s^2/m]
    double roll_gain;                  // [rad/m]
    double sideslip_gain;              // of the chassis' center of mass [rad/m]

    double rack_per_angle;  // rack over steering wheel, here [m/rad]
    double steering_ratio;  // kinematic: steering wheel over the mean steer angle of the foremost steered axle [1]
    double wheelbase;       // from that axle to the mean of the motor vehicle's unsteered ones [m]

    // ISO 4138. The understeer gradient is d delta_H / d a_y less steering_ratio wheelbase / v^2, what the steering wheel turns
    // by beyond the geometry of the circle; over the steering ratio it is that of the road wheels. What geometry leaves out at
    // any speed, the camber of wheels steered about a caster or axles that scrub against each other, stands in it over v^2.
    double understeer_gradient;  // [rad/(m/s^2)]
    double roll_gradient;        // [rad/(m/s^2)]
    double sideslip_gradient;    // [rad/(m/s^2)]
    // With this gradient at all speeds: where the gain of yaw rate is half that of a neutral vehicle, and largest; where the
    // gain of an oversteering vehicle has no bound. The other one is NaN [m/s].
    double characteristic_speed, critical_speed;
};

// At any steady motion that has a speed.
SteadyHandling steady_handling(const Linearizer& linearizer, const OperatingPoint& at);

// Straight ahead. Throws NoSolution with the reason where there is no such motion.
SteadyHandling steady_handling(const VehicleDescription& vehicle, double speed);

// The test on a circle: how the angle of the steering wheel grows with lateral acceleration as the vehicle goes round the
// circle of `at` faster, R = v^2 / a_y; ISO 4138's understeer gradient at constant radius [rad/(m/s^2)]. On a wide circle it
// is the slope, over v^2, of the angle per curvature, hence at constant speed the same where that is a straight line from the
// geometry on; lift, drag and what drives against it bend it.
double constant_radius_gradient(const Linearizer& linearizer, const OperatingPoint& at);

// The same from a circle's radius and a speed; negative radii turn to the right. Throws NoSolution.
double constant_radius_gradient(const VehicleDescription& vehicle, double radius, double speed);

// Response of an output to the steering wheel, per radian of it, at angular frequencies [rad/s]. Displacement and rate of the
// rack are all that acts: states are momenta, in which the rack's rate stands already, so that its acceleration is no input.
std::vector<std::complex<double>> steering_response(const LinearModel& model, double rack_per_angle,
                                                    LinearOutput output, const std::vector<double>& frequencies);

}  // namespace hamilcar
