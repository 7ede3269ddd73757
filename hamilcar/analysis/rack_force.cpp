#include "hamilcar/analysis/rack_force.hpp"

#include "hamilcar/analysis/acceleration.hpp"
#include "hamilcar/block/rhs.hpp"

namespace hamilcar {

namespace {

// Long against round-off; half as long changes nothing that could be felt [s].
constexpr double difference = 2e-5;

// What a chassis lends its suspensions.
struct ChassisMotion {
    Vec3<double> gravity;    // [m/s^2]
    Spatial<double> motion;  // v_chassis
};

Spatial<double> weight_of(const SpatialInertia<double>& body, const ChassisMotion& chassis) {
    return spatial<double>(chassis.gravity * body.mass, body.first_moment.cross(chassis.gravity));
}

Spatial<double> wrench_of(const TireForces<double>& f, const Tire<double>& any_tire, const Vec3<double>& axis) {
    return dispatch(any_tire, [&](const auto& tire) { return carrier_wrench(tire, f, axis); });
}

State<double> rate_at(const Model<double>& model, const State<double>& state, const Velocity<double>& velocity,
                      const Momenta<double>& momenta) {
    State<double> rate;
    rate_of_state(model, state, velocity, momenta, rate);
    return rate;
}

// One instant with its neighbors on both sides, and what the rack feels of each suspension.
class RackForce {
public:
    RackForce(const Model<double>& model, const State<double>& state, const Input<double>& input,
              const Velocity<double>& velocity, const Momenta<double>& momenta)
        : vehicle_(model.vehicle),
          state_(state),
          unit_rate_{input.rack.displacement, 1, 0},
          velocity_(velocity),
          momenta_(momenta),
          rate_(rate_at(model, state, velocity, momenta)),
          before_(
              velocity_block(model, state_after(model, state, rate_, -difference), input_after(input, -difference))),
          after_(velocity_block(model, state_after(model, state, rate_, difference), input_after(input, difference))) {}

    double of_suspension(std::size_t s) const {
        const Suspension<double>& suspension = vehicle_.suspensions[s];
        const SuspensionMomenta<double>& f = momenta_.suspensions[s];
        const auto numbers = suspension.state(state_.values.data());
        const ChassisMotion chassis = chassis_of(suspension.unit);
        LinkagePosition<double> moved;
        suspension.linkage.find_position(numbers.independent, numbers.dependent, unit_rate_, 0.0, moved);
        double force = 0;
        for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
            const auto frame = static_cast<std::size_t>(suspension.bodies[i].frame);
            const Spatial<double> h_rate = rate_of(chassis, [&](const Velocity<double>& then) -> Spatial<double> {
                return then.suspensions[s].inertia[i] * then.suspensions[s].motion[frame];
            });
            const Spatial<double> weight = weight_of(velocity_.suspensions[s].inertia[i], chassis);
            force += moved.motion.x[frame].dot(h_rate - weight);
        }
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) force += of_wheel(suspension, s, i, moved, chassis);
        const auto rate_of = [&](const ForceLine<double>& line) {
            return suspension.linkage.line(line, moved, numbers.independent, numbers.dependent).prescribed_rate;
        };
        for (std::size_t i = 0; i < suspension.springs.size(); ++i) {
            force -= f.springs[i].force * rate_of(suspension.springs[i].line);
        }
        for (std::size_t i = 0; i < suspension.dampers.size(); ++i) {
            force -= f.dampers[i].force * rate_of(suspension.dampers[i].line);
        }
        return force;
    }

private:
    double of_wheel(const Suspension<double>& suspension, std::size_t s, std::size_t i,
                    const LinkagePosition<double>& moved, const ChassisMotion& chassis) const {
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
        return xi.dot(unbalanced) - f.drive_torque * at.axis[i].dot(angular(xi) - angular(reaction)) -
               (f.stop + f.bar) * travel.prescribed_rate;
    }

    // h' + v_chassis x* h
    template <class Momentum>
    Spatial<double> rate_of(const ChassisMotion& chassis, const Momentum& momentum) const {
        return (momentum(after_) - momentum(before_)) / (2 * difference) +
               cross_force<double>(chassis.motion, momentum(velocity_));
    }

    ChassisMotion chassis_of(int unit) const {
        if (unit == 0) return {velocity_.R_GC.row(2).transpose() * -vehicle_.gravity, velocity_.chassis};
        const auto& world = momenta_.trailers[static_cast<std::size_t>(unit) - 1].surroundings;
        return {world.gravity, world.chassis};
    }

    const Vehicle<double>& vehicle_;
    const State<double>& state_;
    RackMotion<double> unit_rate_;
    const Velocity<double>& velocity_;
    const Momenta<double>& momenta_;
    State<double> rate_;
    Velocity<double> before_, after_;
};

}  // namespace

double rack_force(const Model<double>& model, const State<double>& state, const Input<double>& input,
                  const Velocity<double>& velocity, const Momenta<double>& momenta) {
    const RackForce of(model, state, input, velocity, momenta);
    double force = 0;
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) force += of.of_suspension(s);
    return force;
}

double steering_torque(const Column& column, double displacement, double force) {
    return force * column.rack(column.angle(displacement)).slope;  // by the power of both
}

}  // namespace hamilcar
