// What drives a vehicle and what resists it, without driving: the pull at the wheels in each gear, the resistance of air and
// tires, and the speed at which they balance.
#pragma once

#include <optional>
#include <vector>

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

// Speed of what each power unit drives over the vehicle's speed, all wheels rolling [rad/m].
std::vector<double> output_speeds(const VehicleDescription& vehicle);

// Highest forward gear of the first power unit; 0 without power units.
int highest_gear(const VehicleDescription& vehicle);
// At the ground with all pedals down, steadily and without slip of tires, clutch or converter [N].
double full_pull(const VehicleDescription& vehicle, int gear, double speed);

// At a steady speed straight ahead: that of the air, by the file's area, and the rest, by the torque that holds the speed in
// the linear model's operating point. Without a driven wheel the rest is by the tires' coefficients.
struct Resistance {
    double air, rest;  // [N]
    double sum() const { return air + rest; }
};
Resistance resistance(const VehicleDescription& vehicle, double speed);
double air_resistance(const VehicleDescription& vehicle, double speed);

struct Balance {
    int gear;
    double speed;  // [m/s]
};
// The gear that is fastest, and how fast; none where nothing drives.
std::optional<Balance> fastest(const VehicleDescription& vehicle);

// Mass that a change of speed moves: with wheels that turn, the rest of the driveline disconnected [kg].
double rolling_mass(const VehicleDescription& vehicle);

}  // namespace hamilcar
