// Sizes, masses and forces of a vehicle that follow from its description alone; each is defined here and nowhere else.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

// Of everything, trailers too [kg].
double total_mass(const VehicleDescription& vehicle);
// Beyond the 3.5 t that regulations divide cars and trucks by: UN R.E.3's categories N2, N3, M2 and M3.
bool is_heavy(const VehicleDescription& vehicle);

// At full command, of all brakes at the ground [N].
double full_brake_force(const VehicleDescription& vehicle);
// The same per pedal, where a booster still helps [N].
double brake_force_per_command(const VehicleDescription& vehicle);
// Of every wheel, in the vehicle's order.
std::vector<std::string> wheel_names(const VehicleDescription& vehicle);
// Likewise [m].
std::vector<double> rolling_radii(const VehicleDescription& vehicle);
// Between the outermost wheels, at least half a meter [m].
double track_width(const VehicleDescription& vehicle);

// Lateral acceleration at which the vehicle would tip over were it rigid: g track / (2 height of the center of mass), of the
// narrowest axle and everything that the vehicle carries [m/s^2].
double tipping_acceleration(const VehicleDescription& vehicle);

// An axle of the vehicle or of a trailer: the names of the wheels at one place along it.
struct Axle {
    std::string name;  // "axle 1 (front)"
    std::vector<std::string> wheels;
    double x;  // of its wheel centers in the vehicle frame [m]
    bool of_trailer;
};
// From the foremost on.
std::vector<Axle> axles(const VehicleDescription& vehicle);

// Half the width of the vehicle's widest tire, of which files say nothing: 0.27 of the radius, as of truck tires, at least
// 0.1 as of a car's [m].
double half_tire(const VehicleDescription& vehicle);
// The box around the motor vehicle on the ground, from its hull and its tires; x and y from its center of mass [m].
struct Footprint {
    double front, rear, left, right;
    double width() const { return left - right; }
    double length() const { return front - rear; }
};
Footprint footprint(const VehicleDescription& vehicle);
// x of what comes last, trailers' wheels too, from there while the combination stands straight [m].
double rear_end(const VehicleDescription& vehicle);

}  // namespace hamilcar
