// Where a vehicle starts: the plane through the ground under its wheels, and its axes along it.
#pragma once

#include "hamilcar/block/model.hpp"
#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

// Chassis axes along the ground: z the normal, x the heading laid into the plane.
Mat3<double> heading_on(const Vec3<double>& normal, double yaw);

struct StartingGround {
    Vec3<double> normal;
    double height;  // at the vehicle's origin [m]
};

// By least squares through the ground under the wheels.
StartingGround starting_ground(const Model<double>& model, const VehicleDescription& vehicle,
                               const InitialDescription& initial);

}  // namespace hamilcar
