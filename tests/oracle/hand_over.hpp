// From a Simulation to the other engines: where its car is, and what its driver does.
#pragma once

#include "hamilcar/run/simulation.hpp"
#include "oracle/simbody_car.hpp"

namespace hamilcar::oracle {

inline CarState state_of(const Simulation& simulation) {
    const Sample s = simulation.sample();
    const Mat3<double>& R = s.velocity.R_GC;
    CarState car;
    for (std::size_t i = 0; i < 3; ++i) {
        car.position[i] = s.state.position()[static_cast<int>(i)];
        car.velocity[i] = R.row(static_cast<int>(i)).dot(s.velocity.hub.head<3>());
        car.angular_velocity[i] = R.row(static_cast<int>(i)).dot(s.velocity.hub.tail<3>());
        for (std::size_t j = 0; j < 3; ++j) car.rotation[3 * i + j] = R(static_cast<int>(i), static_cast<int>(j));
    }
    for (int i = 0; i < simulation.model().vehicle.spoke_count(); ++i) {
        const auto spoke = s.state.spoke(i);
        const auto& momenta = s.momenta.spokes[static_cast<std::size_t>(i)];
        car.corners.push_back({.independent = spoke.independent[0],
                               .independent_rate = momenta.V_rate[0],
                               .spin = momenta.forces.spin,
                               .u = spoke.deflection_x,
                               .v = spoke.deflection_y,
                               .b = spoke.brake_windup});
    }
    return car;
}

// The simulation must outlive the answer.
inline std::function<Inputs(double)> inputs_of(const Simulation& simulation) {
    return [&simulation](double t) -> Inputs {
        const Input<double> in = simulation.schedule()(t);
        return {in.rack.displacement, in.rack.rate, in.rack.acceleration, in.drive_torque, in.brake};
    };
}

}  // namespace hamilcar::oracle
