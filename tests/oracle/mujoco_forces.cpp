// The page docs/models/forces.md once more, all but the tire, on bodies as vectors in ground axes.

#include <algorithm>

#include "support/hardpoints.hpp"
#include "tests/oracle/mujoco_parts.hpp"

namespace hamilcar::oracle {

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
    return (stop.rate + stop.progression * x) * x;
}

// A point of the carrier and one of the chassis, which a force along the line between them pushes apart.
class Line {
public:
    Line(const Point& wheel_center, const Point& on_carrier, const Point& on_chassis, Body& carrier, Body& chassis)
        : carrier_(carrier),
          chassis_(chassis),
          start_(carrier.place(to_vector(on_carrier) - to_vector(wheel_center))),
          end_(chassis.place(to_vector(on_chassis))),
          direction_((end_ - start_).normalized()),
          design_((to_vector(on_chassis) - to_vector(on_carrier)).norm()) {}

    double shortening() const { return design_ - (end_ - start_).norm(); }
    double rate() const { return direction_.dot(chassis_.velocity_at(end_) - carrier_.velocity_at(start_)); }
    void push_apart(double force) {
        carrier_.push(start_, -force * direction_);
        chassis_.push(end_, force * direction_);
    }

private:
    Body& carrier_;
    Body& chassis_;
    Vector3d start_, end_, direction_;
    double design_;
};

// From the carrier to the chassis. What acts along a strut's slide acts between slide point and top.
Line line_of(const SuspensionDescription& suspension, const LineDescription& line, Body& carrier, Body& chassis) {
    const Point& center = suspension.wheels[0].wheel.center;
    if (!line.coordinate) return Line(center, line.on_part, line.on_base, carrier, chassis);
    const test::MacPhersonPoints strut = test::strut_points(suspension);
    return Line(center, strut.slide_point, strut.strut_top, carrier, chassis);
}

void add_springs_and_dampers(const SuspensionDescription& suspension, Body& carrier, Body& chassis) {
    for (const auto& [name, where, spring] : suspension.springs) {
        Line line = line_of(suspension, where, carrier, chassis);
        line.push_apart(spring.force_at_design + spring.rate * line.shortening());
    }
    for (const auto& [name, where, damper] : suspension.dampers) {
        Line line = line_of(suspension, where, carrier, chassis);
        line.push_apart(-damper_force(damper, line.rate()));
    }
}

// Wheel center above its design height, in vehicle axes.
double travel(const SuspensionDescription& suspension, const Body& carrier, const Body& chassis) {
    return chassis.rotation.col(2).dot(carrier.origin - chassis.origin) - suspension.wheels[0].wheel.center[2];
}

// A force up along vehicle z on the wheel center, with its reaction on the chassis.
void lift(double force, Body& carrier, Body& chassis) {
    const Vector3d up = force * chassis.rotation.col(2);
    carrier.push(carrier.origin, up);
    chassis.push(carrier.origin, -up);
}

void add_drive_and_brake(const SuspensionDescription& suspension, const Inputs& inputs, SuspensionMotion& motion,
                         Body& chassis) {
    const Vector3d spin_axis = motion.carrier.rotation * to_vector(suspension.wheels[0].wheel.spin_axis).normalized();
    const Vector3d drive = suspension.wheels[0].drive_share * inputs.drive_torque * spin_axis;
    motion.wheel_moment += drive;
    chassis.moment -= drive;

    const BrakeDescription& brake = suspension.wheels[0].brake;
    const double command = inputs.brake, past_valve = std::max(command - brake.valve_command, 0.0);
    const double limit = brake.max_torque * (command - (1 - brake.valve_slope) * past_valve);
    const double windup_limit = brake.windup_stiffness > 0 ? limit / brake.windup_stiffness : 0;  // 0: no brake
    const double b = motion.states.b;
    const double slowest = windup_return * windup_limit;
    const double turned =
        std::clamp(motion.spin, -slowest - unwinding * std::max(b, 0.0), slowest + unwinding * std::max(-b, 0.0));
    motion.rates.b = turned - windup_return * (b - std::clamp(b, -windup_limit, windup_limit));
    const double torque = brake.windup_stiffness * b + brake.windup_damping * motion.rates.b;
    motion.spin_torque -= std::clamp(torque, -limit, limit);
}

void add_air(const AerodynamicsDescription& air, Body& chassis) {
    const Vector3d center = chassis.place(to_vector(air.center));
    const Vector3d velocity = chassis.velocity_at(center), along = chassis.rotation.transpose() * velocity;
    const double pressure = 0.5 * air.air_density * velocity.squaredNorm();
    const double pull = 0.5 * air.air_density * velocity.norm();
    chassis.push(center, -pull * air.drag_area * velocity);
    const double more = air.side_area.value_or(air.drag_area) - air.drag_area;
    chassis.push(center, chassis.rotation * Vector3d(0, -pull * more * along[1], 0));
    for (std::size_t i = 0; i < 2; ++i) {
        const Vector3d place(air.lift_place[i], air.center[1], air.center[2]);
        chassis.push(chassis.place(place), chassis.rotation * Vector3d(0, 0, pressure * air.lift_area[i]));
    }
    chassis.moment += chassis.rotation * Vector3d(0, 0, -pull * air.yaw_volume * along[1]);
}

}  // namespace

void add_forces(const VehicleDescription& description, const Road& road, const Inputs& inputs, CarMotion& car) {
    Body& chassis = car.chassis;
    for (std::size_t i = 0; i < car.suspensions.size(); ++i) {
        const SuspensionDescription& suspension = description.suspensions[i];
        SuspensionMotion& motion = car.suspensions[i];
        add_springs_and_dampers(suspension, motion.carrier, chassis);
        const double z = travel(suspension, motion.carrier, chassis);
        lift(stop_force(suspension.wheels[0].rebound, -z) - stop_force(suspension.wheels[0].bump, z), motion.carrier,
             chassis);
        add_tire(suspension, road, motion);
        add_drive_and_brake(suspension, inputs, motion, chassis);
    }
    for (const AntiRollBarDescription& bar : description.anti_roll_bars) {
        Body &left = car.suspensions[bar.left].carrier, &right = car.suspensions[bar.right].carrier;
        const double force = bar.rate * (travel(description.suspensions[bar.left], left, chassis) -
                                         travel(description.suspensions[bar.right], right, chassis));
        lift(-force, left, chassis);
        lift(force, right, chassis);
    }
    add_air(description.aerodynamics, chassis);
}

}  // namespace hamilcar::oracle
