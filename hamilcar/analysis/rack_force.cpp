#include "hamilcar/analysis/rack_force.hpp"

#include "hamilcar/analysis/unbalanced.hpp"

namespace hamilcar {

double rack_force(const Model<double>& model, const State<double>& state, const Input<double>& input,
                  const Velocity<double>& velocity, const Momenta<double>& momenta) {
    const Unbalanced unbalanced(model, state, input, velocity, momenta);
    double force = 0;
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
        force += unbalanced.along(s, unbalanced.position(s, 1));
    }
    return force;
}

double steering_torque(const Column& column, double displacement, double force) {
    return force * column.rack(column.angle(displacement)).slope;  // by the power of both
}

}  // namespace hamilcar
