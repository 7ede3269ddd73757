#include "hamilcar/analysis/acceleration.hpp"

#include <cmath>

#include "hamilcar/block/rhs.hpp"

namespace hamilcar {

namespace {

constexpr double difference = 1e-4;  // short for the car, long against round-off [s]

// Of the motor vehicle alone, with its suspensions as they stand, in chassis axes [m].
Vec3<double> motor_vehicle_center(const Vehicle<double>& vehicle, const Velocity<double>& velocity) {
    Vec3<double> moment = vehicle.chassis_inertia.first_moment;
    double mass = vehicle.chassis_inertia.mass;
    for (std::size_t i = 0; i < vehicle.suspensions.size(); ++i) {
        if (vehicle.suspensions[i].unit != 0) continue;
        for (std::size_t b = 0; b < vehicle.suspensions[i].bodies.size(); ++b) {
            const SpatialInertia<double>& inertia = velocity.suspensions[i].inertia[b];
            moment += inertia.first_moment, mass += inertia.mass;
        }
    }
    return moment / mass;
}

}  // namespace

std::array<double, 2> horizontal_acceleration(const Model<double>& model, const State<double>& state,
                                              const Input<double>& input, const Velocity<double>& velocity,
                                              const Momenta<double>& momenta) {
    if (model.vehicle.trailers.empty()) return horizontal_acceleration_alone(model, velocity, momenta);
    const Mat3<double>& R = velocity.R_GC;
    const Vec3<double> a =
        R * acceleration_at(model, state, input, velocity, momenta, motor_vehicle_center(model.vehicle, velocity));
    const double length = std::sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
    const double c = R(0, 0) / length, s = R(1, 0) / length;  // of the heading
    return {c * a[0] + s * a[1], c * a[1] - s * a[0]};
}

State<double> state_after(const Model<double>& model, const State<double>& state, const State<double>& rate,
                          double time) {
    State<double> out = state;
    for (int i = 0; i < model.vehicle.state_size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        out.values[k] += time * rate.values[k];
    }
    return out;
}

Input<double> input_after(const Input<double>& input, double time) {
    Input<double> out = input;
    out.rack.displacement += time * (input.rack.rate + 0.5 * time * input.rack.acceleration);
    out.rack.rate += time * input.rack.acceleration;
    out.time += time;
    return out;
}

Vec3<double> acceleration_at(const Model<double>& model, const State<double>& state, const Input<double>& input,
                             const Velocity<double>& velocity, const Momenta<double>& momenta,
                             const Vec3<double>& point) {
    State<double> rate;
    rate_of_state(model, state, velocity, momenta, rate);
    const auto moving = [&](double time) -> Vec3<double> {
        const Velocity<double> then =
            velocity_block(model, state_after(model, state, rate, time), input_after(input, time));
        return then.R_GC * velocity_at<double>(then.chassis, point);  // ground axes
    };
    return velocity.R_GC.transpose() * (moving(difference) - moving(-difference)) / (2 * difference);
}

}  // namespace hamilcar
