// The tire of docs/models/forces.md once more, from the contact with a plane to the load on the wheel.

#include "tests/oracle/mujoco_parts.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar::oracle {

namespace {

constexpr double sliding_transport = 20;  // w_s [m/s]

struct Contact {
    Vector3d lowest, point;  // P0 and P
    Vector3d normal, longitudinal, lateral, spin_axis;
    double depth;
    double lever;  // r, of a longitudinal force about the spin axis
};

Contact find_contact(const SuspensionDescription& suspension, const Road& road, const Body& carrier) {
    const double radius = casing_of(suspension.wheels[0].tire).radius;
    Contact at;
    at.normal = Vector3d(-road.grade, -road.bank, 1).normalized();
    at.spin_axis = carrier.rotation * to_vector(suspension.wheels[0].wheel.spin_axis).normalized();
    const double s = at.normal.dot(at.spin_axis);
    const double c = std::sqrt(std::max(1 - s * s, 1e-6));
    at.depth = radius * c - at.normal.dot(carrier.origin);
    at.lowest = carrier.origin - radius / c * (at.normal - s * at.spin_axis);
    at.point = at.lowest + at.depth * at.normal;
    at.longitudinal = at.spin_axis.cross(at.normal).normalized();
    at.lateral = at.normal.cross(at.longitudinal);
    at.lever = -at.spin_axis.dot((at.point - carrier.origin).cross(at.longitudinal));
    return at;
}

double vertical_load(const TireDescription& description, const Contact& at, const Body& carrier) {
    if (const auto* spring = std::get_if<SpringTireDescription>(&description))
        return spring->vertical_stiffness * at.depth;
    const auto& tire = std::get<LinearTireDescription>(description);
    if (at.depth <= 0) return 0;
    const double opening = at.normal.dot(carrier.velocity_at(at.lowest));
    return std::max(0.0, tire.vertical_stiffness * at.depth - tire.vertical_damping * opening);
}

struct Slip {
    double longitudinal, lateral, travel;  // v_sx, v_sy, v_x [m/s]
};

struct Tangential {
    double longitudinal, lateral;  // [N]
};

// Also sets the rates of u and v.
Tangential tangential_force(const LinearTireDescription& tire, double road_friction, double load, const Slip& slip,
                            const WheelStates& states, WheelStates& rates) {
    const double x = load / tire.cornering_load;
    const double c_x = tire.longitudinal_stiffness;
    const double c_y = 2 * (tire.cornering_reference / tire.cornering_load) / (1 + x * x);
    const double mu = tire.friction * road_friction;
    const double k_x = states.u / tire.relaxation_longitudinal, k_y = states.v / tire.relaxation_lateral;
    const double asked = std::hypot(c_x * k_x, c_y * k_y);
    const double s = asked > mu ? mu / asked : 1;
    const double w = std::abs(slip.travel) + sliding_transport * (1 - s);
    rates.u = -slip.longitudinal - w * k_x;
    rates.v = -slip.lateral - w * k_y;

    const double q = std::max(2 * s - 1, 0.0);
    const double sliding = (1 - q) * std::max(c_x, c_y);
    const double f_x = (q * c_x + sliding) * (k_x + tire.carcass_damping * rates.u / tire.relaxation_longitudinal);
    const double f_y = (q * c_y + sliding) * (k_y + tire.carcass_damping * rates.v / tire.relaxation_lateral);
    const double f = std::hypot(f_x, f_y);
    const double cut = f > mu ? mu / f : 1;
    return {load * cut * f_x, load * cut * f_y};
}

}  // namespace

void add_tire(const SuspensionDescription& suspension, const Road& road, SuspensionMotion& motion) {
    const Body& carrier = motion.carrier;
    const Contact at = find_contact(suspension, road, carrier);
    const double load = vertical_load(suspension.wheels[0].tire, at, carrier);
    motion.push_wheel(at.point, load * at.normal);
    const auto* tire = std::get_if<LinearTireDescription>(&suspension.wheels[0].tire);
    if (!tire) return;

    const Vector3d velocity = carrier.velocity_at(at.point);
    const double carrier_spin = at.spin_axis.dot(carrier.angular_velocity);
    const double spin = carrier_spin + motion.spin;  // Omega
    Slip slip;
    slip.travel = at.longitudinal.dot(velocity);
    slip.longitudinal = slip.travel + at.lever * carrier_spin - tire->rolling_radius * spin;
    slip.lateral = at.lateral.dot(velocity);
    const Tangential force = tangential_force(*tire, road.friction, load, slip, motion.states, motion.rates);

    motion.push_wheel(at.point, force.longitudinal * at.longitudinal + force.lateral * at.lateral);
    const double transfer = -(tire->rolling_radius - at.lever) * force.longitudinal;
    const double rolling = -tire->rolling_resistance * load * tire->rolling_radius * spin / std::hypot(spin, 1.0);
    motion.wheel_moment += (transfer + rolling) * at.spin_axis;
}

}  // namespace hamilcar::oracle
