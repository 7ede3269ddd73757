// The page docs/models/forces.md written a second time, all but the tire: one Simbody force on vectors in ground axes.

#include "tests/oracle/simbody_parts.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar::oracle {

using SimTK::State;
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

    void realizeTopology(State& state) const override { subsystem_.allocateZ(state, Vector(parts_.z_count, 0.0)); }

    void calcForce(const State& state, Loads& loads, SimTK::Vector_<Vec3>&, Vector& mobility_forces) const override {
        CarMotion car(parts_, state);
        for (const AxialElement& element : parts_.axial) add_spring_and_damper(state, element, car, mobility_forces);
        for (std::size_t i = 0; i < parts_.wheels.size(); ++i) {
            add_stops(i, car);
            add_road(state, i, car);
            add_drive_and_brake(state, i, car, mobility_forces);
        }
        for (const AntiRollBarDescription& bar : parts_.description.anti_roll_bars) {
            const double force = bar.rate * (bar_end(state, car, bar.left) - bar_end(state, car, bar.right));
            push_bar_end(state, bar.left, -force, car, mobility_forces);
            push_bar_end(state, bar.right, force, car, mobility_forces);
        }
        for (std::size_t i = 0; i < parts_.hitches.size(); ++i) {
            const Coordinate& yaw = parts_.hitches[i].coordinates[parts_.hitches[i].yaw];
            yaw.push(-parts_.description.trailers[i].yaw_damping * yaw.rate(state), state, mobility_forces);
        }
        add_air(car.bodies.front());
        for (const MovingBody& body : car.bodies) body.add_load(loads);
    }

    double calcPotentialEnergy(const State& state) const override {
        const CarMotion car(parts_, state);
        double energy = 0;
        for (const AxialElement& element : parts_.axial) {
            const double length =
                element.coordinate ? element.coordinate->value(state) : line_between(element, car).length;
            const double compression = element.design_length - length;
            energy += compression * (element.spring.force_at_design + element.spring.rate * compression / 2);
        }
        for (std::size_t i = 0; i < parts_.wheels.size(); ++i) {
            const SuspensionWheelDescription& wheel = parts_.wheels[i].description;
            const double z = travel(car, i);
            energy += stop_energy(wheel.bump, z) + stop_energy(wheel.rebound, -z);
            for (int k = 0; k < parts_.wheels[i].tires(); ++k) energy += tire_energy(parts_, i, k, car);
        }
        for (const AntiRollBarDescription& bar : parts_.description.anti_roll_bars) {
            const double difference = bar_end(state, car, bar.left) - bar_end(state, car, bar.right);
            energy += bar.rate * difference * difference / 2;
        }
        return energy;
    }

private:
    void add_spring_and_damper(const State& state, const AxialElement& element, CarMotion& car,
                               Vector& mobility_forces) const {
        const auto force = [&](double length, double rate) {
            return element.spring.force_at_design + element.spring.rate * (element.design_length - length) -
                   damper_force(element.damper, rate);
        };
        if (element.coordinate) {
            const Coordinate& along = *element.coordinate;
            along.push(force(along.value(state), along.rate(state)), state, mobility_forces);
            return;
        }
        const Line line = line_between(element, car);
        const Vec3 push = force(line.length, line.rate) * line.direction;
        car.bodies[element.part].push(line.on_part, -push);
        car.bodies[element.base].push(line.on_base, push);
    }

    // Wheel center above its design height, in the axes of its unit.
    double travel(const CarMotion& car, std::size_t i) const {
        const RoadWheel& wheel = parts_.wheels[i];
        const MovingBody& unit = car.bodies[wheel.unit];
        return ~unit.pose.z() * (car.wheels[i].center - unit.pose.p()) -
               parts_.bodies[wheel.unit].station(wheel.description.wheel.center)[2];
    }

    // A force up along the unit's z on the wheel center, with its reaction on the unit.
    void lift(std::size_t i, double force, CarMotion& car) const {
        MovingBody& unit = car.bodies[parts_.wheels[i].unit];
        const Vec3 up = force * unit.pose.z();
        car.bodies[parts_.wheels[i].carrier].push(car.wheels[i].center, up);
        unit.push(car.wheels[i].center, -up);
    }

    // The mobilizer of a bar's arm, or null where the bar acts along the wheel's travel.
    const Coordinate* bar_arm(std::size_t i) const {
        const std::optional<int>& arm = parts_.wheels[i].description.bar_arm;
        if (!arm) return nullptr;
        std::size_t tree = 0;
        while (tree + 1 < parts_.suspensions.size() && parts_.suspensions[tree + 1].first_wheel <= i) ++tree;
        return &parts_.suspensions[tree].coordinates[static_cast<std::size_t>(*arm)];
    }
    double bar_end(const State& state, const CarMotion& car, std::size_t i) const {
        const Coordinate* arm = bar_arm(i);
        return arm ? arm->value(state) : travel(car, i);
    }
    void push_bar_end(const State& state, std::size_t i, double force, CarMotion& car, Vector& mobility_forces) const {
        if (const Coordinate* arm = bar_arm(i)) return arm->push(force, state, mobility_forces);
        lift(i, force, car);
    }

    void add_stops(std::size_t i, CarMotion& car) const {
        const SuspensionWheelDescription& wheel = parts_.wheels[i].description;
        const double z = travel(car, i);
        lift(i, stop_force(wheel.rebound, -z) - stop_force(wheel.bump, z), car);
    }

    void add_road(const State& state, std::size_t i, CarMotion& car) const {
        const Vector& deflection = subsystem_.getZ(state);
        Vector& z_rate = subsystem_.updZDot(state);
        for (int k = 0; k < parts_.wheels[i].tires(); ++k) {
            const int z = parts_.wheels[i].first_z + 2 * k;
            const Deflection rate = add_tire(parts_, i, k, {deflection[z], deflection[z + 1]}, car);
            z_rate[z] = rate.u;
            z_rate[z + 1] = rate.v;
        }
    }

    void add_drive_and_brake(const State& state, std::size_t i, CarMotion& car, Vector& mobility_forces) const {
        const RoadWheel& wheel = parts_.wheels[i];
        const WheelMotion& motion = car.wheels[i];
        const Vec3 drive = wheel.description.drive_share * parts_.inputs.drive_torque * motion.spin_axis;
        car.bodies[wheel.wheel].twist(drive);
        car.bodies[wheel.drive_base].twist(-drive);

        const BrakeDescription& brake = wheel.description.brake;
        const double command = parts_.inputs.brake, past_valve = std::max(command - brake.valve_command, 0.0);
        const double limit = brake.max_torque * (command - (1 - brake.valve_slope) * past_valve);
        const double windup_limit = brake.windup_stiffness > 0 ? limit / brake.windup_stiffness : 0;  // 0: no brake
        const double windup = subsystem_.getZ(state)[wheel.windup_z()];
        const double excess = windup - std::clamp(windup, -windup_limit, windup_limit);
        const double slowest = windup_return * windup_limit;
        const double turned = std::clamp(motion.spin, -slowest - unwinding * std::max(windup, 0.0),
                                         slowest + unwinding * std::max(-windup, 0.0));
        const double windup_rate = turned - windup_return * excess;
        subsystem_.updZDot(state)[wheel.windup_z()] = windup_rate;
        const double torque = brake.windup_stiffness * windup + brake.windup_damping * windup_rate;
        Coordinate{parts_.bodies[wheel.wheel].body}.push(-std::clamp(torque, -limit, limit), state, mobility_forces);
    }

    void add_air(MovingBody& chassis) const {
        const AerodynamicsDescription& air = parts_.description.aerodynamics;
        const Vec3 center = chassis.pose * to_vec3(air.center);
        const SimTK::Rotation& R = chassis.pose.R();
        const Vec3 velocity = ~R * chassis.velocity_at(center);
        const double speed = velocity.norm(), half = 0.5 * air.air_density;
        const double side = air.side_area.value_or(air.drag_area);
        chassis.push(center, R * (-half * speed *
                                  Vec3(air.drag_area * velocity[0], side * velocity[1], air.drag_area * velocity[2])));
        double pitch = 0;
        for (std::size_t i = 0; i < 2; ++i) {
            const double lift = half * speed * speed * air.lift_area[i];
            chassis.push(center, R * Vec3(0, 0, lift));
            pitch -= lift * (air.lift_place[i] - air.center[0]);
        }
        chassis.twist(R * Vec3(0, pitch, -half * speed * air.yaw_volume * velocity[1]));
    }

    const Parts& parts_;
    const SimTK::GeneralForceSubsystem& subsystem_;
};

}  // namespace

SimTK::Force::Custom::Implementation* make_forces(const Parts& parts, const SimTK::GeneralForceSubsystem& subsystem) {
    return new CarForces(parts, subsystem);
}

}  // namespace hamilcar::oracle
