#include "hamilcar/analysis/acceleration.hpp"

#include "hamilcar/block/rhs.hpp"

namespace hamilcar {

namespace {

constexpr double moment = 1e-4;  // short for the car, long against round-off [s]

}  // namespace

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
    return velocity.R_GC.transpose() * (moving(moment) - moving(-moment)) / (2 * moment);
}

}  // namespace hamilcar
