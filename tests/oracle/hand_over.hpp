// From a Simulation to the other engines: where its car is, and what its driver does.
#pragma once

#include "hamilcar/run/simulation.hpp"
#include "oracle/simbody_car.hpp"

namespace hamilcar::oracle {

inline TreeState tree_state_of(const Sample& s, std::size_t i) {
    const Suspension<double>& suspension = s.model.vehicle.suspensions[i];
    const SuspensionVelocity<double>& velocity = s.velocity.suspensions[i];
    const auto state = suspension.state(s.state.values.data());
    LinkageRates<double> rates;
    suspension.linkage.find_rates(velocity.at, velocity.own.V_rate, s.input.rack, rates);
    const auto count = static_cast<std::size_t>(suspension.linkage.nq());
    TreeState tree{std::vector<double>(count), std::vector<double>(rates.q.begin(), rates.q.begin() + count), {}};
    for (std::size_t k = 0; k < suspension.linkage.independent.size(); ++k)
        tree.coordinates[static_cast<std::size_t>(suspension.linkage.independent[k])] = state.independent[k];
    for (std::size_t k = 0; k < suspension.linkage.dependent.size(); ++k)
        tree.coordinates[static_cast<std::size_t>(suspension.linkage.dependent[k])] = state.dependent[k];
    for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
        const auto wheel = suspension.wheel_state(static_cast<int>(w), s.state.values.data());
        WheelState& to = tree.wheels.emplace_back();
        to.spin = s.momenta.suspensions[i].wheels[w].spin;
        to.b = wheel.brake_windup;
        for (int k = 0; k < suspension.wheels[w].tires; ++k)
            to.tires.push_back({wheel.deflection[2 * k], wheel.deflection[2 * k + 1]});
    }
    return tree;
}

inline HitchState hitch_state_of(const Sample& s, std::size_t i) {
    const Trailer<double>& trailer = s.model.vehicle.trailers[i];
    const double* angles = s.state.values.data() + trailer.offset;
    const auto& rates = s.velocity.trailers[i].own.V_rate;
    const int n = trailer.freedoms();
    return {std::vector<double>(angles, angles + n), std::vector<double>(rates.begin(), rates.begin() + n)};
}

// Where a point of the motor vehicle (unit 0) or of a trailer is on the ground.
inline Vec3<double> ground_point(const Sample& s, std::size_t unit, const Point& point) {
    Vec3<double> at(point.data());
    for (std::size_t tow; unit > 0; unit = tow) {
        at = s.velocity.trailers[unit - 1].pose.point(at);
        tow = static_cast<std::size_t>(s.model.vehicle.trailers[unit - 1].tow);
    }
    return s.state.position() + s.velocity.R_GC * at;
}

inline CarState state_of(const Simulation& simulation) {
    const Sample s = simulation.sample();
    const Mat3<double>& R = s.velocity.R_GC;
    CarState car;
    for (std::size_t i = 0; i < 3; ++i) {
        car.position[i] = s.state.position()[static_cast<int>(i)];
        car.velocity[i] = R.row(static_cast<int>(i)).dot(s.velocity.chassis.head<3>());
        car.angular_velocity[i] = R.row(static_cast<int>(i)).dot(s.velocity.chassis.tail<3>());
        for (std::size_t j = 0; j < 3; ++j) car.rotation[3 * i + j] = R(static_cast<int>(i), static_cast<int>(j));
    }
    for (std::size_t i = 0; i < simulation.model().vehicle.suspensions.size(); ++i)
        car.suspensions.push_back(tree_state_of(s, i));
    for (std::size_t i = 0; i < simulation.model().vehicle.trailers.size(); ++i)
        car.trailers.push_back(hitch_state_of(s, i));
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
