// The tire of docs/models/forces.md, from the contact with a plane to the load on the wheel.

#include "tests/oracle/simbody_parts.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar::oracle {

using SimTK::UnitVec3;
using SimTK::Vec3;

namespace {

constexpr double sliding_transport = 20;  // w_s [m/s]

struct Contact {
    Vec3 lowest, point;  // P0 and P
    Vec3 normal, longitudinal, lateral;
    double depth;
    double lever;  // r, of a longitudinal force about the spin axis
};

Contact find_contact(const Parts& parts, std::size_t i, int tire, const CarMotion& car) {
    const SuspensionWheelDescription& wheel = parts.wheels[i].description;
    const double radius = casing_of(wheel.tire).radius;
    const Vec3& axis = car.wheels[i].spin_axis;
    const Vec3 center = car.wheels[i].center + (tire == 0 ? 0.5 : -0.5) * wheel.dual_spacing * axis;
    Contact result;
    result.normal = Vec3(UnitVec3(-parts.road.grade, -parts.road.bank, 1));
    const double s = ~result.normal * axis;
    const double c = std::sqrt(std::max(1 - s * s, 1e-6));
    const Vec3 radial = (result.normal - s * axis) / c;
    result.depth = radius * c - ~result.normal * center;
    result.lowest = center - radius * radial;
    result.point = result.lowest + result.depth * result.normal;
    result.longitudinal = Vec3(UnitVec3(axis % result.normal));
    result.lateral = result.normal % result.longitudinal;
    result.lever = -(~axis * ((result.point - center) % result.longitudinal));
    return result;
}

double vertical_load(const TireDescription& description, const MovingBody& carrier, const Contact& at) {
    if (const auto* spring = std::get_if<SpringTireDescription>(&description))
        return spring->vertical_stiffness * at.depth;
    const auto& tire = std::get<LinearTireDescription>(description);
    if (at.depth <= 0) return 0;
    const double closing = -(~at.normal * carrier.velocity_at(at.lowest));
    return std::max(0.0, tire.vertical_stiffness * at.depth + tire.vertical_damping * closing);
}

struct Slip {
    double longitudinal, lateral, travel;  // v_sx, v_sy, v_x [m/s]
};

struct Tangential {
    double longitudinal = 0, lateral = 0;  // [N]
    Deflection rate;                       // [m/s]
};

Tangential tangential(const LinearTireDescription& tire, double road_friction, double load, const Slip& slip,
                      const Deflection& deflection) {
    const double x = load / tire.cornering_load;
    const double cx = tire.longitudinal_stiffness;
    const double cy = 2 * (tire.cornering_reference / tire.cornering_load) / (1 + x * x);
    const double mu = tire.friction * road_friction;
    const double kx = deflection.u / tire.relaxation_longitudinal, ky = deflection.v / tire.relaxation_lateral;
    const double elastic = std::hypot(cx * kx, cy * ky);
    const double stick = elastic > mu ? mu / elastic : 1;
    const double transport = std::abs(slip.travel) + sliding_transport * (1 - stick);

    Tangential result;
    result.rate = {-slip.longitudinal - transport * kx, -slip.lateral - transport * ky};
    const double common = std::max(cx, cy);
    const double gx = kx + tire.carcass_damping * result.rate.u / tire.relaxation_longitudinal;
    const double gy = ky + tire.carcass_damping * result.rate.v / tire.relaxation_lateral;
    const double own = std::max(2 * stick - 1, 0.0);
    const double fx = (own * cx + (1 - own) * common) * gx, fy = (own * cy + (1 - own) * common) * gy;
    const double f = std::hypot(fx, fy);
    const double cut = f > mu ? mu / f : 1;
    result.longitudinal = load * cut * fx;
    result.lateral = load * cut * fy;
    return result;
}

}  // namespace

// Normal and lateral force have no moment about the spin axis, so all of the load may go to the wheel's body.
Deflection add_tire(const Parts& parts, std::size_t i, int which, const Deflection& deflection, CarMotion& car) {
    const TireDescription& description = parts.wheels[i].description.tire;
    const Contact at = find_contact(parts, i, which, car);
    const WheelMotion& motion = car.wheels[i];
    const MovingBody& carrier = car.bodies[parts.wheels[i].carrier];
    MovingBody& wheel = car.bodies[parts.wheels[i].wheel];
    const double load = vertical_load(description, carrier, at);
    wheel.push(at.point, load * at.normal);
    const auto* tire = std::get_if<LinearTireDescription>(&description);
    if (!tire) return {};

    const Vec3 velocity = carrier.velocity_at(at.point);
    const double carrier_spin = ~motion.spin_axis * carrier.velocity[0];
    const double spin = carrier_spin + motion.spin;  // Omega
    Slip slip;
    slip.travel = ~at.longitudinal * velocity;
    slip.longitudinal = slip.travel + at.lever * carrier_spin - tire->rolling_radius * spin;
    slip.lateral = ~at.lateral * velocity;
    const Tangential force = tangential(*tire, parts.road.friction, load, slip, deflection);

    wheel.push(at.point, force.longitudinal * at.longitudinal + force.lateral * at.lateral);
    const double transfer = -(tire->rolling_radius - at.lever) * force.longitudinal;
    const double rolling = -tire->rolling_resistance * load * tire->rolling_radius * spin / std::hypot(spin, 1.0);
    wheel.twist((transfer + rolling) * motion.spin_axis);
    return force.rate;
}

double tire_energy(const Parts& parts, std::size_t i, int which, const CarMotion& car) {
    const double depth = find_contact(parts, i, which, car).depth;
    const TireDescription& description = parts.wheels[i].description.tire;
    if (std::holds_alternative<LinearTireDescription>(description) && depth <= 0) return 0;
    return casing_of(description).vertical_stiffness * depth * depth / 2;
}

}  // namespace hamilcar::oracle
