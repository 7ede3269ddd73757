// The car's bodies in Simbody: a free chassis, trailers on their hitches, spindles that are free and held by
// constraints (or on their struts), pinned arms, and a wheel on each.

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

// Its slide axis runs through T.
MobilizedBody add_free_spindle(Parts& parts, const Linkage& linkage, const SimTK::MassProperties& mass) {
    const Vec3 center = linkage.wheel_center;
    MobilizedBody spindle = MobilizedBody::Free(parts.chassis, Transform(center), Body::Rigid(mass), Transform());
    SimTK::Constraint::PointOnLine(spindle, linkage.slide_axis, linkage.slide - center, parts.chassis, linkage.top);
    return spindle;
}

// The massless control arm's plane and radius, and the tie rod, in Simbody's own constraints.
void add_arm_and_tie_rod(Parts& parts, const Linkage& linkage, MobilizedBody& spindle) {
    const Vec3 center = linkage.wheel_center;
    SimTK::Constraint::PointInPlane(parts.chassis, linkage.arm_axis, ~linkage.arm_axis * linkage.arm_foot, spindle,
                                    linkage.ball - center);
    SimTK::Constraint::Rod(parts.chassis, linkage.arm_foot, spindle, linkage.ball - center, linkage.arm_length);
    MobilizedBody rack = add_rack(parts, parts.chassis, linkage.rack_end, Vec3(linkage.rack_axis));
    SimTK::Constraint::Rod(rack, Vec3(0), spindle, linkage.tie_rod - center, linkage.tie_rod_length);
}

SimTK::MassProperties corner_mass(const CornerDescription& corner) {
    return carrier_mass(corner.name, {corner.carrier}, {corner.wheel}, to_vec3(corner.wheel.center));
}

void add_spindle(Parts& parts, const CornerDescription& corner, CornerParts& bodies) {
    const Linkage linkage(corner);
    const SimTK::MassProperties mass = corner_mass(corner);
    if (parts.spindle_model == SpindleModel::free) {
        bodies.carrier = add_free_spindle(parts, linkage, mass);
    } else {
        add_strut(parts, linkage, mass, bodies);
    }
    if (parts.spindle_model != SpindleModel::strut_one_constraint) add_arm_and_tie_rod(parts, linkage, bodies.carrier);
}

// The pin's axis points to the left on both sides: a trailing wheel then rises with a positive angle.
MobilizedBody add_arm(Parts& parts, const CornerDescription& corner) {
    const auto& arm = std::get<SemiTrailingArmDescription>(corner.suspension);
    const Vec3 bush = to_vec3(arm.inner_bush);
    Vec3 axis = to_vec3(arm.outer_bush) - bush;
    if (axis[1] < 0) axis = -axis;
    const Rotation pin_frame(UnitVec3(axis), SimTK::ZAxis);
    return MobilizedBody::Pin(parts.chassis, Transform(pin_frame, bush), Body::Rigid(corner_mass(corner)),
                              Transform(pin_frame, bush - to_vec3(corner.wheel.center)));
}

// On a strut both act along it; on an arm each has its own line.
void add_axial_elements(Parts& parts, const CornerDescription& corner, std::size_t carrier) {
    const auto add = [&](const Point& on_carrier, const Point& on_chassis, const SpringDescription& spring,
                         const DamperDescription& damper) {
        const double length = (to_vec3(on_chassis) - to_vec3(on_carrier)).norm();
        parts.axial.push_back(
            {carrier, 0, parts.bodies[carrier].station(on_carrier), to_vec3(on_chassis), {}, spring, damper, length});
    };
    if (const auto* strut = std::get_if<MacPhersonDescription>(&corner.suspension))
        return add(strut->slide_point, strut->strut_top, corner.spring, corner.damper);
    const auto& arm = std::get<SemiTrailingArmDescription>(corner.suspension);
    add(arm.spring_arm, arm.spring_body, corner.spring, {});
    add(arm.damper_arm, arm.damper_body, {}, corner.damper);
}

void add_corner(Parts& parts, const CornerDescription& corner) {
    CornerParts bodies;
    if (std::holds_alternative<SemiTrailingArmDescription>(corner.suspension)) {
        bodies.carrier = add_arm(parts, corner);
    } else {
        add_spindle(parts, corner, bodies);
    }
    parts.corners.push_back(bodies);
    const std::size_t carrier = parts.place(bodies.carrier, to_vec3(corner.wheel.center));
    ComposedWheelDescription wheel;
    wheel.name = corner.name, wheel.wheel = corner.wheel, wheel.bump = corner.bump, wheel.rebound = corner.rebound;
    wheel.tire = corner.tire, wheel.brake = corner.brake, wheel.drive_share = corner.drive_share;
    add_wheel(parts, wheel, 0, carrier, 0, wheel_mass_of(corner.carrier.mass, 1));
    add_axial_elements(parts, corner, carrier);
}

// A ball turns about z, x', y'', a fifth wheel about y, z'; the trailer's frame sits at the hitch.
void add_trailer(Parts& parts, const TrailerDescription& trailer) {
    const Vec3 hitch = to_vec3(trailer.hitch_point);
    const Placed& tow = parts.bodies.at(trailer.tow);
    const Body chassis = Body::Rigid(mass_about(trailer.chassis, hitch));
    TreeParts bodies;
    const auto turn = [&](const MobilizedBody& on, const Vec3& station, const UnitVec3& axis, const Body& body) {
        bodies.coordinates.push_back(add_coordinate(on, station, false, axis, body));
        return bodies.coordinates.back();
    };
    const Vec3 station = tow.station(trailer.hitch_point);
    if (trailer.hitch == Hitch::ball) {
        turn(tow.body, station, SimTK::ZAxis, Body::Massless());
        turn(bodies.coordinates.back(), Vec3(0), SimTK::XAxis, Body::Massless());
        turn(bodies.coordinates.back(), Vec3(0), SimTK::YAxis, chassis);
        bodies.yaw = 0;
    } else {
        turn(tow.body, station, SimTK::YAxis, Body::Massless());
        turn(bodies.coordinates.back(), Vec3(0), SimTK::ZAxis, chassis);
        bodies.yaw = 1;
    }
    parts.hitches.push_back(bodies);
    parts.place(bodies.coordinates.back(), hitch);
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

MobilizedBody add_rack(const Parts& parts, MobilizedBody base, const Vec3& station, const Vec3& drive) {
    MobilizedBody rack = add_coordinate(base, station, true, UnitVec3(drive), Body::Massless());
    SimTK::Motion::Custom(rack, new RackMotion(parts.inputs, drive.norm()));
    return rack;
}

void add_wheel(Parts& parts, const ComposedWheelDescription& description, std::size_t hub, std::size_t carrier,
               std::size_t drive_base, double mass) {
    const WheelDescription& wheel = description.wheel;
    const Rotation spin_frame(UnitVec3(to_vec3(wheel.spin_axis)), SimTK::ZAxis);
    MobilizedBody& on = parts.bodies[carrier].body;
    const Transform place(spin_frame, parts.bodies[carrier].station(wheel.center));
    const MobilizedBody body = MobilizedBody::Pin(on, place, Body::Rigid(wheel_mass(wheel, mass)), Transform());
    parts.wheels.push_back(
        {description, hub, carrier, parts.place(body, to_vec3(wheel.center)), drive_base, parts.z_count});
    parts.z_count = parts.wheels.back().windup_z() + 1;
}

void add_bodies(Parts& parts, MobilizedBody& ground) {
    const VehicleDescription& car = parts.description;
    parts.chassis = MobilizedBody::Free(ground, Body::Rigid(mass_about(car.chassis, Vec3(0))));
    parts.place(parts.chassis, Vec3(0));
    for (const TrailerDescription& trailer : car.trailers) add_trailer(parts, trailer);
    bool any_spindle = false;
    for (const CornerDescription& corner : car.corners) {
        add_corner(parts, corner);
        any_spindle = any_spindle || std::holds_alternative<MacPhersonDescription>(corner.suspension);
    }
    if (any_spindle && parts.spindle_model == SpindleModel::strut_one_constraint) add_arms_and_tie_rods(parts);
    add_composed(parts);
    for (const AntiRollBarDescription& bar : car.anti_roll_bars) parts.bars.push_back({bar.left, bar.right, bar.rate});
    for (const ComposedBarDescription& bar : car.composed_bars) {
        const std::size_t first = car.corners.size();
        parts.bars.push_back({first + bar.left, first + bar.right, bar.rate});
    }
}

}  // namespace hamilcar::oracle
