// The page docs/models/forces.md written a second time, all but the tire: one Simbody force on vectors in ground axes.

#include "tests/oracle/simbody_parts.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar::oracle {

using SimTK::MobilizedBody;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::UnitVec3;
using SimTK::Vec3;
using SimTK::Vector;

namespace {

constexpr double windup_return = 100;  // [1/s]
constexpr double unwinding = 300;      // [1/s]

double damper_force(const DamperDescription& damper, double velocity) {
    const auto& x = damper.velocity;
    const auto& f = damper.force;
    if (x.size() < 2) return 0;
    std::size_t i = 1;  // right end of the segment; the first and the last one reach to infinity
    while (i + 1 < x.size() && velocity > x[i]) ++i;
    return f[i - 1] + (f[i] - f[i - 1]) * (velocity - x[i - 1]) / (x[i] - x[i - 1]);
}

double stop_force(const StopDescription& stop, double travel) {
    const double x = std::max(0.0, travel - stop.gap);
    return stop.rate * x + stop.progression * x * x;
}

double stop_energy(const StopDescription& stop, double travel) {
    const double x = std::max(0.0, travel - stop.gap);
    return stop.rate * x * x / 2 + stop.progression * x * x * x / 3;
}

class CarForces : public SimTK::Force::Custom::Implementation {
public:
    CarForces(const Parts& parts, const SimTK::GeneralForceSubsystem& subsystem)
        : parts_(parts), subsystem_(subsystem) {}

    void realizeTopology(State& state) const override {
        subsystem_.allocateZ(state, Vector(3 * static_cast<int>(parts_.corners.size()), 0.0));
    }

    void calcForce(const State& state, Loads& loads, SimTK::Vector_<Vec3>&, Vector& mobility_forces) const override {
        CarMotion car(parts_, state);
        for (std::size_t i = 0; i < parts_.corners.size(); ++i) {
            add_spring_and_damper(i, car);
            add_stops(i, car);
            add_road(state, i, car.corners[i]);
            add_drive_and_brake(state, i, car, mobility_forces);
        }
        for (const AntiRollBarDescription& bar : parts_.description.anti_roll_bars) {
            const double force = bar.rate * (travel(car, bar.left) - travel(car, bar.right));
            lift(bar.left, -force, car);
            lift(bar.right, force, car);
        }
        add_drag(car.chassis);
        car.chassis.add_load(loads);
        for (const CornerMotion& corner : car.corners) {
            corner.carrier.add_load(loads);
            corner.wheel.add_load(loads);
        }
    }

    double calcPotentialEnergy(const State& state) const override {
        const CarMotion car(parts_, state);
        double energy = 0;
        for (std::size_t i = 0; i < parts_.corners.size(); ++i) {
            const CornerDescription& corner = parts_.description.corners[i];
            const SpringLine spring = spring_line(car, i);
            const double compression = spring.design - spring.line.length;
            energy += compression * (corner.spring.force_at_design + corner.spring.rate * compression / 2);
            const double z = travel(car, i);
            energy += stop_energy(corner.bump, z) + stop_energy(corner.rebound, -z);
            energy += tire_energy(parts_, i, car.corners[i]);
        }
        for (const AntiRollBarDescription& bar : parts_.description.anti_roll_bars) {
            const double difference = travel(car, bar.left) - travel(car, bar.right);
            energy += bar.rate * difference * difference / 2;
        }
        return energy;
    }

private:
    struct SpringLine {
        Line line;
        double design;  // its length at design [m]
    };

    SpringLine between(const CarMotion& car, std::size_t i, const Point& on_carrier, const Point& on_chassis) const {
        const double design = (to_vec3(on_chassis) - to_vec3(on_carrier)).norm();
        return {line_between(parts_, car, i, on_carrier, on_chassis), design};
    }

    SpringLine spring_line(const CarMotion& car, std::size_t i) const {
        const SuspensionDescription& suspension = parts_.description.corners[i].suspension;
        if (const auto* strut = std::get_if<MacPhersonDescription>(&suspension))
            return between(car, i, strut->slide_point, strut->strut_top);
        const auto& arm = std::get<SemiTrailingArmDescription>(suspension);
        return between(car, i, arm.spring_arm, arm.spring_body);
    }

    void add_spring_and_damper(std::size_t i, CarMotion& car) const {
        const CornerDescription& corner = parts_.description.corners[i];
        const auto spread = [&](const Line& line, double force) {
            car.corners[i].carrier.push(line.on_carrier, -force * line.direction);
            car.chassis.push(line.on_chassis, force * line.direction);
        };
        const SpringLine spring = spring_line(car, i);
        const double spring_force =
            corner.spring.force_at_design + corner.spring.rate * (spring.design - spring.line.length);
        const auto* arm = std::get_if<SemiTrailingArmDescription>(&corner.suspension);
        if (!arm) return spread(spring.line, spring_force - damper_force(corner.damper, spring.line.rate));
        spread(spring.line, spring_force);
        const Line damper = line_between(parts_, car, i, arm->damper_arm, arm->damper_body);
        spread(damper, -damper_force(corner.damper, damper.rate));
    }

    // Wheel center above its design height, in vehicle axes.
    double travel(const CarMotion& car, std::size_t i) const {
        const Vec3 from_chassis = car.corners[i].carrier.pose.p() - car.chassis.pose.p();
        return ~car.chassis.pose.z() * from_chassis - parts_.description.corners[i].wheel.center[2];
    }

    // A force up along vehicle z on the wheel center, with its reaction on the chassis.
    void lift(std::size_t i, double force, CarMotion& car) const {
        MovingBody& carrier = car.corners[i].carrier;
        const Vec3 up = force * car.chassis.pose.z();
        carrier.push(carrier.pose.p(), up);
        car.chassis.push(carrier.pose.p(), -up);
    }

    void add_stops(std::size_t i, CarMotion& car) const {
        const CornerDescription& corner = parts_.description.corners[i];
        const double z = travel(car, i);
        lift(i, stop_force(corner.rebound, -z) - stop_force(corner.bump, z), car);
    }

    void add_road(const State& state, std::size_t i, CornerMotion& corner) const {
        const int z = 3 * static_cast<int>(i);
        const Vector& deflection = subsystem_.getZ(state);
        const Deflection rate = add_tire(parts_, i, {deflection[z], deflection[z + 1]}, corner);
        Vector& z_rate = subsystem_.updZDot(state);
        z_rate[z] = rate.u;
        z_rate[z + 1] = rate.v;
    }

    void add_drive_and_brake(const State& state, std::size_t i, CarMotion& car, Vector& mobility_forces) const {
        const CornerDescription& corner = parts_.description.corners[i];
        CornerMotion& motion = car.corners[i];
        const Vec3 drive = corner.drive_share * parts_.inputs.drive_torque * motion.spin_axis;
        motion.wheel.twist(drive);
        car.chassis.twist(-drive);

        const BrakeDescription& brake = corner.brake;
        const double limit = parts_.inputs.brake * brake.max_torque;
        const double windup_limit = brake.windup_stiffness > 0 ? limit / brake.windup_stiffness : 0;  // 0: no brake
        const int z = 3 * static_cast<int>(i) + 2;
        const double windup = subsystem_.getZ(state)[z];
        const double excess = windup - std::clamp(windup, -windup_limit, windup_limit);
        const double slowest = windup_return * windup_limit;
        const double turned = std::clamp(motion.spin, -slowest - unwinding * std::max(windup, 0.0),
                                         slowest + unwinding * std::max(-windup, 0.0));
        const double windup_rate = turned - windup_return * excess;
        subsystem_.updZDot(state)[z] = windup_rate;
        const double torque = brake.windup_stiffness * windup + brake.windup_damping * windup_rate;
        parts_.corners[i].wheel.applyOneMobilityForce(state, 0, -std::clamp(torque, -limit, limit), mobility_forces);
    }

    void add_drag(MovingBody& chassis) const {
        const AerodynamicsDescription& air = parts_.description.aerodynamics;
        const Vec3 center = chassis.pose * to_vec3(air.center);
        const Vec3 velocity = chassis.velocity_at(center);
        chassis.push(center, -0.5 * air.air_density * air.drag_area * velocity.norm() * velocity);
    }

    const Parts& parts_;
    const SimTK::GeneralForceSubsystem& subsystem_;
};

}  // namespace

MovingBody::MovingBody(const MobilizedBody& body, const State& state)
    : pose(body.getBodyTransform(state)), velocity(body.getBodyVelocity(state)), index_(body.getMobilizedBodyIndex()) {}

Vec3 MovingBody::velocity_at(const Vec3& point) const {
    return velocity[1] + velocity[0] % (point - pose.p());
}

void MovingBody::push(const Vec3& point, const Vec3& force) {
    load_ += SpatialVec((point - pose.p()) % force, force);
}

CarMotion::CarMotion(const Parts& parts, const State& state) : chassis(parts.chassis, state) {
    corners.reserve(parts.corners.size());
    for (std::size_t i = 0; i < parts.corners.size(); ++i) {
        const auto& [carrier, wheel, unused] = parts.corners[i];
        const MovingBody moving_carrier(carrier, state);
        const UnitVec3 at_design(to_vec3(parts.description.corners[i].wheel.spin_axis));
        corners.push_back({moving_carrier, MovingBody(wheel, state), moving_carrier.pose.R() * Vec3(at_design),
                           wheel.getOneU(state, 0)});
    }
}

Line line_between(const Parts& parts, const CarMotion& car, std::size_t corner, const Point& on_carrier,
                  const Point& on_chassis) {
    const MovingBody& carrier = car.corners[corner].carrier;
    const Vec3 start = carrier.pose * parts.station(corner, on_carrier);
    const Vec3 end = car.chassis.pose * to_vec3(on_chassis);
    const double length = (end - start).norm();
    const UnitVec3 direction((end - start) / length, true);
    return {start, end, direction, length, ~direction * (car.chassis.velocity_at(end) - carrier.velocity_at(start))};
}

SimTK::Force::Custom::Implementation* make_forces(const Parts& parts, const SimTK::GeneralForceSubsystem& subsystem) {
    return new CarForces(parts, subsystem);
}

}  // namespace hamilcar::oracle
