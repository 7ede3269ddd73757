// All wheels of a vehicle in one list: for the Initial Process and equilibria, outside the step.
#pragma once

#include <vector>

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// A tire on the road: a wheel has one, or two (dual tires).
struct RoadTire {
    const Tire<double>* tire;
    const TireForces<double>* forces;
    double *u, *v;  // deflections in the state [m]
};

struct RoadWheel {
    int unit;
    std::size_t number;  // in the vehicle's order
    const Brake<double>* brake;
    double* windup;  // in the state
    std::vector<RoadTire> tires;
};

// In the vehicle's order. The list points into `momenta` and `state`, which must outlive it.
std::vector<RoadWheel> road_wheels(const Model<double>& model, const Momenta<double>& momenta, State<double>& state);

// Acceleration of gravity in a unit's axes [m/s^2].
Vec3<double> gravity_in_unit(const Model<double>& model, const Velocity<double>& velocity,
                             const Momenta<double>& momenta, int unit);

double rolling_radius(const Tire<double>& tire);

// Mass times center of mass of the whole vehicle, in chassis axes about the chassis origin [kg m].
Vec3<double> mass_moment(const Model<double>& model, const Velocity<double>& velocity);

}  // namespace hamilcar
