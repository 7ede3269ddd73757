// The bodies at one instant, in ground axes, and the lines between them.

#include "tests/oracle/simbody_parts.hpp"

namespace hamilcar::oracle {

using SimTK::MobilizedBody;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::UnitVec3;
using SimTK::Vec3;

MovingBody::MovingBody(const MobilizedBody& body, const State& state)
    : pose(body.getBodyTransform(state)), velocity(body.getBodyVelocity(state)), index_(body.getMobilizedBodyIndex()) {}

Vec3 MovingBody::velocity_at(const Vec3& point) const {
    return velocity[1] + velocity[0] % (point - pose.p());
}

void MovingBody::push(const Vec3& point, const Vec3& force) {
    load_ += SpatialVec((point - pose.p()) % force, force);
}

// A wheel's own z is its axis, and its frame sits at its center, wherever the carrier's does.
CarMotion::CarMotion(const Parts& parts, const State& state) {
    bodies.reserve(parts.bodies.size());
    for (const Placed& placed : parts.bodies) bodies.emplace_back(placed.body, state);
    wheels.reserve(parts.wheels.size());
    for (const RoadWheel& wheel : parts.wheels) {
        const MovingBody& body = bodies[wheel.wheel];
        wheels.push_back({body.pose.p(), Vec3(body.pose.z()), parts.bodies[wheel.wheel].body.getOneU(state, 0)});
    }
}

Line line_between(const AxialElement& element, const CarMotion& car) {
    const MovingBody &part = car.bodies[element.part], &base = car.bodies[element.base];
    const Vec3 start = part.pose * element.on_part, end = base.pose * element.on_base;
    const double length = (end - start).norm();
    const UnitVec3 direction((end - start) / length, true);
    return {start, end, direction, length, ~direction * (base.velocity_at(end) - part.velocity_at(start))};
}

}  // namespace hamilcar::oracle
