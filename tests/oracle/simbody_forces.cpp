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
        for (std::size_t i = 0; i < parts_.corners.size(); ++i) {
            add_spring_and_damper(state, i, loads);
            add_stops(state, i, loads);
            add_road(state, i, loads);
            add_drive_and_brake(state, i, loads, mobility_forces);
        }
        for (const AntiRollBarDescription& bar : parts_.description.anti_roll_bars) {
            const double force = bar.rate * (travel(state, bar.left) - travel(state, bar.right));
            lift(state, bar.left, -force, loads);
            lift(state, bar.right, force, loads);
        }
        add_drag(state, loads);
    }

    double calcPotentialEnergy(const State& state) const override {
        double energy = 0;
        for (std::size_t i = 0; i < parts_.corners.size(); ++i) {
            const CornerDescription& corner = parts_.description.corners[i];
            const double compression = spring_line(state, i).design - spring_line(state, i).line.length;
            energy += compression * (corner.spring.force_at_design + corner.spring.rate * compression / 2);
            const double z = travel(state, i);
            energy += stop_energy(corner.bump, z) + stop_energy(corner.rebound, -z) + tire_energy(parts_, state, i);
        }
        for (const AntiRollBarDescription& bar : parts_.description.anti_roll_bars) {
            const double difference = travel(state, bar.left) - travel(state, bar.right);
            energy += bar.rate * difference * difference / 2;
        }
        return energy;
    }

private:
    struct SpringLine {
        Line line;
        double design;  // its length at design [m]
    };

    SpringLine between(const State& state, std::size_t i, const Point& on_carrier, const Point& on_chassis) const {
        const double design = (to_vec3(on_chassis) - to_vec3(on_carrier)).norm();
        return {line_between(parts_, state, i, on_carrier, on_chassis), design};
    }

    SpringLine spring_line(const State& state, std::size_t i) const {
        const SuspensionDescription& suspension = parts_.description.corners[i].suspension;
        if (const auto* strut = std::get_if<MacPhersonDescription>(&suspension))
            return between(state, i, strut->slide_point, strut->strut_top);
        const auto& arm = std::get<SemiTrailingArmDescription>(suspension);
        return between(state, i, arm.spring_arm, arm.spring_body);
    }

    SpringLine damper_line(const State& state, std::size_t i) const {
        const SuspensionDescription& suspension = parts_.description.corners[i].suspension;
        if (std::holds_alternative<MacPhersonDescription>(suspension)) return spring_line(state, i);
        const auto& arm = std::get<SemiTrailingArmDescription>(suspension);
        return between(state, i, arm.damper_arm, arm.damper_body);
    }

    void add_spring_and_damper(const State& state, std::size_t i, Loads& loads) const {
        const CornerDescription& corner = parts_.description.corners[i];
        const auto spread = [&](const Line& line, double force) {
            push(parts_.corners[i].carrier, state, line.on_carrier, -force * line.direction, loads);
            push(parts_.chassis, state, line.on_chassis, force * line.direction, loads);
        };
        const SpringLine spring = spring_line(state, i);
        spread(spring.line, corner.spring.force_at_design + corner.spring.rate * (spring.design - spring.line.length));
        const Line damper = damper_line(state, i).line;
        spread(damper, -damper_force(corner.damper, damper.rate));
    }

    // Wheel center above its design height, in vehicle axes.
    double travel(const State& state, std::size_t i) const {
        const Vec3 center = parts_.corners[i].carrier.getBodyOriginLocation(state);
        const Vec3 in_chassis = parts_.chassis.findStationAtGroundPoint(state, center);
        return in_chassis[2] - parts_.description.corners[i].wheel.center[2];
    }

    // A force up along vehicle z on the wheel center, with its reaction on the chassis.
    void lift(const State& state, std::size_t i, double force, Loads& loads) const {
        const Vec3 center = parts_.corners[i].carrier.getBodyOriginLocation(state);
        const Vec3 up = force * parts_.chassis.getBodyRotation(state).z();
        push(parts_.corners[i].carrier, state, center, up, loads);
        push(parts_.chassis, state, center, -up, loads);
    }

    void add_stops(const State& state, std::size_t i, Loads& loads) const {
        const CornerDescription& corner = parts_.description.corners[i];
        const double z = travel(state, i);
        lift(state, i, stop_force(corner.rebound, -z) - stop_force(corner.bump, z), loads);
    }

    void add_road(const State& state, std::size_t i, Loads& loads) const {
        const int z = 3 * static_cast<int>(i);
        const Vector& deflection = subsystem_.getZ(state);
        const Deflection rate = add_tire(parts_, state, i, {deflection[z], deflection[z + 1]}, loads);
        Vector& z_rate = subsystem_.updZDot(state);
        z_rate[z] = rate.u;
        z_rate[z + 1] = rate.v;
    }

    void add_drive_and_brake(const State& state, std::size_t i, Loads& loads, Vector& mobility_forces) const {
        const CornerDescription& corner = parts_.description.corners[i];
        const MobilizedBody& wheel = parts_.corners[i].wheel;
        const Vec3 drive = corner.drive_share * parts_.inputs.drive_torque * parts_.spin_axis(state, i);
        twist(wheel, drive, loads);
        twist(parts_.chassis, -drive, loads);

        const BrakeDescription& brake = corner.brake;
        const double limit = parts_.inputs.brake * brake.max_torque;
        const double windup_limit = brake.windup_stiffness > 0 ? limit / brake.windup_stiffness : 0;  // 0: no brake
        const int z = 3 * static_cast<int>(i) + 2;
        const double windup = subsystem_.getZ(state)[z];
        const double excess = windup - std::clamp(windup, -windup_limit, windup_limit);
        const double slowest = windup_return * windup_limit;
        const double turned = std::clamp(wheel.getOneU(state, 0), -slowest - unwinding * std::max(windup, 0.0),
                                         slowest + unwinding * std::max(-windup, 0.0));
        const double windup_rate = turned - windup_return * excess;
        subsystem_.updZDot(state)[z] = windup_rate;
        const double torque = brake.windup_stiffness * windup + brake.windup_damping * windup_rate;
        wheel.applyOneMobilityForce(state, 0, -std::clamp(torque, -limit, limit), mobility_forces);
    }

    void add_drag(const State& state, Loads& loads) const {
        const AerodynamicsDescription& air = parts_.description.aerodynamics;
        const Vec3 center = parts_.chassis.findStationLocationInGround(state, to_vec3(air.center));
        const Vec3 velocity = velocity_at(parts_.chassis, state, center);
        push(parts_.chassis, state, center, -0.5 * air.air_density * air.drag_area * velocity.norm() * velocity, loads);
    }

    const Parts& parts_;
    const SimTK::GeneralForceSubsystem& subsystem_;
};

}  // namespace

void push(const MobilizedBody& body, const State& state, const Vec3& point, const Vec3& force, Loads& loads) {
    const Vec3 lever = point - body.getBodyOriginLocation(state);
    loads[body.getMobilizedBodyIndex()] += SpatialVec(lever % force, force);
}

void twist(const MobilizedBody& body, const Vec3& moment, Loads& loads) {
    loads[body.getMobilizedBodyIndex()] += SpatialVec(moment, Vec3(0));
}

Vec3 velocity_at(const MobilizedBody& body, const State& state, const Vec3& point) {
    const Vec3 lever = point - body.getBodyOriginLocation(state);
    return body.getBodyOriginVelocity(state) + body.getBodyAngularVelocity(state) % lever;
}

Line line_between(const Parts& parts, const State& state, std::size_t corner, const Point& on_carrier,
                  const Point& on_chassis) {
    const MobilizedBody& carrier = parts.corners[corner].carrier;
    const Vec3 start = carrier.findStationLocationInGround(state, parts.station(corner, on_carrier));
    const Vec3 end = parts.chassis.findStationLocationInGround(state, to_vec3(on_chassis));
    const UnitVec3 direction(end - start);
    const Vec3 relative = velocity_at(parts.chassis, state, end) - velocity_at(carrier, state, start);
    return {start, end, direction, (end - start).norm(), ~direction * relative};
}

SimTK::Force::Custom::Implementation* make_forces(const Parts& parts, const SimTK::GeneralForceSubsystem& subsystem) {
    return new CarForces(parts, subsystem);
}

}  // namespace hamilcar::oracle
