#include "hamilcar/analysis/unbalanced.hpp"

#include <algorithm>

#include "hamilcar/analysis/acceleration.hpp"
#include "hamilcar/block/rhs.hpp"

namespace hamilcar {

namespace {

// Long against round-off; half as long changes nothing that could be felt [s].
constexpr double difference = 2e-5;

Spatial<double> wrench_of(const TireForces<double>& f, const Tire<double>& any_tire, const Vec3<double>& axis) {
    return dispatch(any_tire, [&](const auto& tire) { return carrier_wrench(tire, f, axis); });
}

State<double> rate_at(const Model<double>& model, const State<double>& state, const Velocity<double>& velocity,
                      const Momenta<double>& momenta) {
    State<double> rate;
    rate_of_state(model, state, velocity, momenta, rate);
    return rate;
}

Velocity<double> velocity_at(const Model<double>& model, const State<double>& state, const State<double>& rate,
                             const Input<double>& input, double time) {
    return velocity_block(model, state_after(model, state, rate, time), input_after(input, time));
}

}  // namespace

Unbalanced::Unbalanced(const Model<double>& model, const State<double>& state, const Input<double>& input,
                       const Velocity<double>& velocity, const Momenta<double>& momenta)
    : vehicle_(model.vehicle),
      state_(state),
      rack_(velocity.rack.displacement),
      velocity_(velocity),
      momenta_(momenta) {
    const State<double> rate = rate_at(model, state, velocity, momenta);
    before_ = velocity_at(model, state, rate, input, -difference);
    after_ = velocity_at(model, state, rate, input, difference);
}

LinkagePosition<double> Unbalanced::position(std::size_t suspension, double rack_rate) const {
    const Suspension<double>& s = vehicle_.suspensions[suspension];
    const auto numbers = s.state(state_.values.data());
    LinkagePosition<double> out;
    RackMotion<double> rack = rack_at(vehicle_, s, {rack_, 0, 0}, state_.values.data());
    if (s.follows_rack()) rack.rate = rack_rate;
    s.linkage.find_position(numbers.independent, numbers.dependent, rack, 0.0, out);
    return out;
}

double Unbalanced::along(std::size_t s, const LinkagePosition<double>& moved) const {
    const Suspension<double>& suspension = vehicle_.suspensions[s];
    const SuspensionMomenta<double>& f = momenta_.suspensions[s];
    const auto numbers = suspension.state(state_.values.data());
    const ChassisMotion chassis = chassis_of(suspension.unit);
    double force = of_bodies(s, moved, chassis);
    for (std::size_t i = 0; i < suspension.wheels.size(); ++i) force += of_wheel(s, i, moved, chassis);
    const auto rate_of = [&](const ForceLine<double>& line) {
        return suspension.linkage.line(line, moved, numbers.independent, numbers.dependent).prescribed_rate;
    };
    for (std::size_t i = 0; i < suspension.springs.size(); ++i) {
        force -= f.springs[i].force * rate_of(suspension.springs[i].line);
    }
    for (std::size_t i = 0; i < suspension.dampers.size(); ++i) {
        force -= f.dampers[i].force * rate_of(suspension.dampers[i].line);
    }
    return force - of_shaft(s, moved);
}

// Of the shaft to a differential on a live axle.
double Unbalanced::of_shaft(std::size_t s, const LinkagePosition<double>& moved) const {
    const Suspension<double>& suspension = vehicle_.suspensions[s];
    if (suspension.shaft_frame == 0) return 0;
    const auto& all = vehicle_.powertrain.differentials;
    const auto on_it = std::ranges::find(all, static_cast<int>(s), &Differential<double>::on_axle);
    const double torque = momenta_.powertrain.inputs[static_cast<std::size_t>(on_it - all.begin())];
    return torque *
           suspension.shaft_axis.dot(angular(moved.motion.x[static_cast<std::size_t>(suspension.shaft_frame)]));
}

double Unbalanced::of_bodies(std::size_t s, const LinkagePosition<double>& moved, const ChassisMotion& chassis) const {
    const Suspension<double>& suspension = vehicle_.suspensions[s];
    double force = 0;
    for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
        const auto frame = static_cast<std::size_t>(suspension.bodies[i].frame);
        const Spatial<double> h_rate = rate_of(chassis, [&](const Velocity<double>& then) -> Spatial<double> {
            return then.suspensions[s].inertia[i] * then.suspensions[s].motion[frame];
        });
        const SpatialInertia<double>& body = velocity_.suspensions[s].inertia[i];
        const Vec3<double>& g = chassis.gravity;
        force += moved.motion.x[frame].dot(h_rate - spatial<double>(g * body.mass, body.first_moment.cross(g)));
    }
    return force;
}

double Unbalanced::of_wheel(std::size_t s, std::size_t i, const LinkagePosition<double>& moved,
                            const ChassisMotion& chassis) const {
    const Suspension<double>& suspension = vehicle_.suspensions[s];
    const SuspensionWheel<double>& wheel = suspension.wheels[i];
    const WheelForces<double>& f = momenta_.suspensions[s].wheels[i];
    const SuspensionVelocity<double>& at = velocity_.suspensions[s];
    const Spatial<double>& xi = moved.motion.x[static_cast<std::size_t>(wheel.frame)];
    const Spatial<double>& reaction = moved.motion.x[static_cast<std::size_t>(wheel.reaction)];
    Spatial<double> unbalanced = rate_of(chassis, [&](const Velocity<double>& then) {
        return spatial<double>(Vec3<double>::Zero(), then.suspensions[s].spin_momentum[i]);
    });
    for (std::size_t k = 0; k < static_cast<std::size_t>(wheel.tires); ++k) {
        unbalanced -= wrench_of(f.tires[k], wheel.tire, at.axis[i]);
    }
    LineOfAction<double> travel;
    suspension.linkage.along(Vec3<double>::UnitZ(), at.center[i], wheel.frame, 0, moved.own, travel);
    const double bar_rate =
        wheel.bar_arm < 0 ? travel.prescribed_rate : moved.X[static_cast<std::size_t>(wheel.bar_arm)];
    return xi.dot(unbalanced) - f.drive_torque * at.axis[i].dot(angular(xi) - angular(reaction)) -
           f.stop * travel.prescribed_rate - f.bar * bar_rate;
}

template <class Momentum>
Spatial<double> Unbalanced::rate_of(const ChassisMotion& chassis, const Momentum& momentum) const {
    return (momentum(after_) - momentum(before_)) / (2 * difference) +
           cross_force<double>(chassis.motion, momentum(velocity_));
}

Unbalanced::ChassisMotion Unbalanced::chassis_of(int unit) const {
    if (unit == 0) return {velocity_.R_GC.row(2).transpose() * -vehicle_.gravity, velocity_.chassis};
    const auto& world = momenta_.trailers[static_cast<std::size_t>(unit) - 1].surroundings;
    return {world.gravity, world.chassis};
}

}  // namespace hamilcar
