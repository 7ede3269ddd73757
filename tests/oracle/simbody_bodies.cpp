// The car's bodies in Simbody: a free chassis, trailers on their hitches, and the mobilizers that suspensions are made of.

#include "tests/oracle/simbody_parts.hpp"

namespace hamilcar::oracle {

using SimTK::Body;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::State;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

namespace {

// The rack has no mass and moves as the inputs say.
class RackMotion : public SimTK::Motion::Custom::Implementation {
public:
    RackMotion(const Inputs& inputs, double ratio) : inputs_(inputs), ratio_(ratio) {}

    SimTK::Motion::Level getLevel(const State&) const override { return SimTK::Motion::Position; }
    void calcPrescribedPosition(const State&, int, double* q) const override { *q = ratio_ * inputs_.rack; }
    void calcPrescribedPositionDot(const State&, int, double* rate) const override {
        *rate = ratio_ * inputs_.rack_rate;
    }
    void calcPrescribedPositionDotDot(const State&, int, double* acceleration) const override {
        *acceleration = ratio_ * inputs_.rack_acceleration;
    }

private:
    const Inputs& inputs_;
    double ratio_;
};

// A ball turns about z, x', y'', a fifth wheel about y, z'; the trailer's frame sits at the hitch.
void add_trailer(Parts& parts, const TrailerDescription& trailer) {
    const Vec3 hitch = to_vec3(trailer.hitch_point);
    const Placed& tow = parts.bodies.at(trailer.tow);
    const Body chassis = Body::Rigid(mass_about(trailer.chassis, hitch));
    const Vec3 station = tow.station(trailer.hitch_point);
    TreeParts bodies;
    if (trailer.hitch == Hitch::ball) {
        bodies.add(add_ball(tow.body, station, chassis), 3);
        bodies.yaw = 0;
    } else {
        bodies.add(add_coordinate(tow.body, station, false, SimTK::YAxis, Body::Massless()), 1);
        bodies.add(add_coordinate(bodies.coordinates[0].body, Vec3(0), false, SimTK::ZAxis, chassis), 1);
        bodies.yaw = 1;
    }
    parts.hitches.push_back(bodies);
    parts.place(bodies.coordinates.back().body, hitch);
}

}  // namespace

MobilizedBody add_coordinate(MobilizedBody parent, const Vec3& station, bool slides, const UnitVec3& axis,
                             const Body& body) {
    if (slides) {
        const Rotation frame(axis, SimTK::XAxis);
        return MobilizedBody::Slider(parent, Transform(frame, station), body, Transform(frame));
    }
    const Rotation frame(axis, SimTK::ZAxis);
    return MobilizedBody::Pin(parent, Transform(frame, station), body, Transform(frame));
}

// Simbody's own order is x, y', z'': its x is the vehicle's z, its y the x, its z the y.
MobilizedBody add_ball(MobilizedBody parent, const Vec3& station, const Body& body) {
    const Rotation frame(UnitVec3(SimTK::ZAxis), SimTK::XAxis, Vec3(UnitVec3(SimTK::XAxis)), SimTK::YAxis);
    return MobilizedBody::Gimbal(parent, Transform(frame, station), body, Transform(frame));
}

MobilizedBody add_rack(const Parts& parts, MobilizedBody base, const Vec3& station, const Vec3& drive) {
    MobilizedBody rack = add_coordinate(base, station, true, UnitVec3(drive), Body::Massless());
    SimTK::Motion::Custom(rack, new RackMotion(parts.inputs, drive.norm()));
    return rack;
}

void add_wheel(Parts& parts, const SuspensionWheelDescription& description, std::size_t unit, std::size_t carrier,
               std::size_t drive_base, double mass) {
    const WheelDescription& wheel = description.wheel;
    const Rotation spin_frame(UnitVec3(to_vec3(wheel.spin_axis)), SimTK::ZAxis);
    MobilizedBody& on = parts.bodies[carrier].body;
    const Transform place(spin_frame, parts.bodies[carrier].station(wheel.center));
    const MobilizedBody body = MobilizedBody::Pin(on, place, Body::Rigid(wheel_mass(wheel, mass)), Transform());
    parts.wheels.push_back(
        {description, unit, carrier, parts.place(body, to_vec3(wheel.center)), drive_base, parts.z_count});
    parts.z_count = parts.wheels.back().windup_z() + 1;
}

void add_bodies(Parts& parts, MobilizedBody& ground) {
    const VehicleDescription& car = parts.description;
    parts.chassis = MobilizedBody::Free(ground, Body::Rigid(mass_about(car.chassis, Vec3(0))));
    parts.place(parts.chassis, Vec3(0));
    for (const TrailerDescription& trailer : car.trailers) add_trailer(parts, trailer);
    add_suspensions(parts);
}

}  // namespace hamilcar::oracle
