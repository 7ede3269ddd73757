// What engineers ask of a vehicle before they drive it: its dimensions and masses, how it stands, steers and rides. Of the motor
// vehicle alone where trailers are behind it, but for the mass of everything and the tipping acceleration.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamilcar/analysis/kinematics.hpp"
#include "hamilcar/analysis/linear_model.hpp"
#include "hamilcar/analysis/modes.hpp"

namespace hamilcar {

// What is not defined of an axle (a track of one wheel) is NaN.
struct StandingAxle {
    std::string name;  // of `axles`: "axle 1 (front)"
    bool of_trailer;
    double track;           // between its outermost wheel centers at design [m]
    double load;            // on the road [N]
    double left_load;       // the left wheels' part of it [N]
    double travel;          // of its wheel that is farthest from design [m]
    double roll_stiffness;  // of springs and anti-roll bars against the body's roll, tires rigid [N m/rad]
    double bar_stiffness;   // the bars' part of it
    double ride_frequency;  // of its load on its springs alone [Hz]
};

struct SteeringFigures {
    double ratio;         // steering wheel over the mean steer angle, at the middle; negative: turns the wrong way [1]
    double inner, outer;  // steer angles at full lock [rad]
    double turning_circle;  // diameter between walls on the ground that the outermost tire touches, by Ackermann [m]
};

struct VehicleFigures {
    double total_mass, mass;         // of everything, of the motor vehicle [kg]
    double wheelbase;                // from the first axle to the last [m]
    Point center_of_mass;            // behind the first axle, to the left of the middle, over the road as it stands [m]
    Point inertia;                   // about it, at design, along the vehicle's axes [kg m^2]
    double static_stability_factor;  // track over twice the height of the center of mass, of the narrowest axle [1]
    double cross_weight;             // share of front right and rear left in the load of two axles; NaN of others [1]
    double full_brake_deceleration;  // all brakes at full command, were the road to take it [m/s^2]
    std::vector<StandingAxle> axles;  // trailers' as well
    std::optional<SteeringFigures> steering;
    std::vector<Mode> rides;  // heave, pitch, roll, hop and tramp of the wheels, where they oscillate; at rest
};

// Of a vehicle that stands: `rest` as `linearizer.operating_point({})` found it, and the kinematics of its axles.
VehicleFigures vehicle_figures(const Linearizer& linearizer, const OperatingPoint& rest,
                               const std::vector<AxleReport>& kinematics);

}  // namespace hamilcar
