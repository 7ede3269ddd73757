#include "hamilcar/driver/observe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

// atan2 within (-pi, pi], with the same bits on every machine, which the C library does not guarantee.
double angle_of(double y, double x) {
    if (x > 0) return arctangent(y, x);
    const double half_pi = 0.5 * std::numbers::pi;
    if (x == 0) return y > 0 ? half_pi : y < 0 ? -half_pi : 0;
    return (y < 0 ? -std::numbers::pi : std::numbers::pi) - arctangent(y, -x);
}

// Of what each power unit drives [rad/s].
std::array<double, max_power_units> output_speeds(const Model<double>& model, const State<double>& state,
                                                  const Velocity<double>& velocity) {
    const Powertrain<double>& powertrain = model.vehicle.powertrain;
    const PowertrainMotion<double> motion = powertrain_motion(model.vehicle, state, velocity);
    const auto inputs = powertrain.input_speeds(motion);
    std::array<double, max_power_units> out{};
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        out[i] = powertrain.value(powertrain.units[i].output, motion.wheels, inputs);
    }
    return out;
}

// Total wheel torque per torque at a differential's input: the product of all ratios on the way.
double torque_ratio(const Powertrain<double>& powertrain, int output) {
    if (output >= 0) return 1;
    const Differential<double>& d = powertrain.differentials[static_cast<std::size_t>(-1 - output)];
    return d.ratio *
           (d.share * torque_ratio(powertrain, d.outputs[0]) + (1 - d.share) * torque_ratio(powertrain, d.outputs[1]));
}

PowerUnitObservation observe_power_unit(const Powertrain<double>& powertrain, std::size_t i, const State<double>& state,
                                        const Input<double>& input, const Velocity<double>& velocity, double shaft) {
    const PowerUnit<double>& unit = powertrain.units[i];
    const double ratio = unit.gears.at(input.gear).ratio;
    PowerUnitObservation out;
    const auto at = unit.state(state.values.data());
    out.shaft_speed = ratio * shaft;
    out.speed = unit.rotor_is_free ? at.momentum * unit.inverse_inertia - unit.axis.dot(angular(velocity.chassis))
                                   : out.shaft_speed;
    out.wheel_ratio = ratio * torque_ratio(powertrain, unit.output);
    const double voltage =
        powertrain.battery.exists() ? powertrain.battery.state(state.values.data()).voltage : powertrain.supply_voltage;
    const auto [min_torque, max_torque] = unit.torque_range(out.speed, voltage);
    out.min_torque = min_torque, out.max_torque = max_torque;
    return out;
}

}  // namespace

Observation observe(const Model<double>& model, const State<double>& state, const Input<double>& input) {
    const Velocity<double> velocity = velocity_block(model, state, input);
    const Mat3<double>& R = velocity.R_GC;
    const Vec3<double> center = Vec3<double>(state.position()) + R * model.vehicle.chassis.center;
    const Vec3<double> v = R * velocity_at<double>(velocity.chassis, model.vehicle.chassis.center);
    Observation out;
    out.time = input.time;
    out.x = center[0], out.y = center[1];
    const double length = std::sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
    const double c = R(0, 0) / length, s = R(1, 0) / length;  // of the heading
    out.yaw = angle_of(R(1, 0), R(0, 0));
    out.roll = angle_of(R(2, 1), R(2, 2));
    out.speed = c * v[0] + s * v[1];
    out.lateral_velocity = c * v[1] - s * v[0];
    out.yaw_rate = Vec3<double>(R * angular(velocity.chassis))[2];
    out.gear = input.gear;
    const Powertrain<double>& powertrain = model.vehicle.powertrain;
    if (!powertrain.exists()) return out;
    const auto speeds = output_speeds(model, state, velocity);
    out.unit_count = static_cast<int>(powertrain.units.size());
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        out.units[i] = observe_power_unit(powertrain, i, state, input, velocity, speeds[i]);
    }
    return out;
}

double initial_speed(const PowerUnit<double>& unit, double gear, double clutch, double shaft) {
    const auto engaged = unit.gears.at(gear);
    const double coupled = unit.capacity > 0 && clutch < 1 ? engaged.ratio * shaft : 0.0;
    const auto* engine = std::get_if<CombustionEngine<double>>(&unit.source);
    if (!engine) return engaged.ratio * shaft;
    const double fluid = unit.converter.present > 0 ? engaged.ratio * shaft : 0.0;
    return std::max({engine->idle_speed, coupled, fluid});
}

void set_rotors(const Model<double>& model, const Input<double>& input, State<double>& state) {
    const Powertrain<double>& powertrain = model.vehicle.powertrain;
    if (!powertrain.exists()) return;
    const Velocity<double> velocity = velocity_block(model, state, input);
    const auto speeds = output_speeds(model, state, velocity);
    Vec3<double> gained = Vec3<double>::Zero();
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        const PowerUnit<double>& unit = powertrain.units[i];
        const auto to = unit.state(state.values.data());
        to.throttle = std::clamp(input.throttle, 0.0, 1.0);
        if (!unit.rotor_is_free) continue;
        const double turning = unit.axis.dot(angular(velocity.chassis));
        const double spin = initial_speed(unit, input.gear, input.clutch, speeds[i]);
        const auto turn = [&](double inertia, double speed, double& of) {
            const double momentum = inertia * (speed + turning);
            gained += unit.axis * (momentum - of);
            of = momentum;
        };
        turn(unit.inertia, spin, to.momentum);
        if (!unit.shafts.exist()) continue;
        const auto engaged = unit.gears.at(input.gear);
        const bool turns_along = input.clutch < 1;  // in neutral
        const double driven = engaged.connected > 0 ? engaged.ratio * speeds[i] : turns_along ? spin : 0;
        turn(unit.shafts.inertia, driven, to.shafts[0]);
    }
    const Vec3<double> gained_ground = velocity.R_GC * gained;
    with_chart(model, [&](auto chart) {
        const Vector<double, 4> orientation = state.orientation();
        Spatial<double> momentum = chart.momentum(orientation, Spatial<double>(state.momentum()));
        momentum.tail<3>() += gained_ground;
        state.momentum() = chart.stored_momentum(orientation, momentum);
    });
}

}  // namespace hamilcar
