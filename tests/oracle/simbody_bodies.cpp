// The car's bodies in Simbody: a free chassis, spindles that are free and held by constraints (or on their struts),
// pinned arms, and a wheel on each.

#include "tests/oracle/simbody_parts.hpp"

#include <stdexcept>

namespace hamilcar::oracle {

using SimTK::Body;
using SimTK::Inertia;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::State;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

namespace {

// The split between carrier and wheel does not change the motion, as the wheel is a body of revolution; it only has to
// leave two bodies that can exist. A disc without thickness has 0.5 here.
constexpr double wheel_mass_share = 0.1;
constexpr double transverse_over_spin_inertia = 0.55;

SimTK::SymMat33 inertia_about_own_center(const BodyDescription& body) {
    const auto& [xx, yy, zz] = body.inertia;
    const auto& [xy, yz, xz] = body.products;
    return SimTK::SymMat33(xx, xy, yy, xz, yz, zz);
}

// scale (|a|^2 1 - a a^T): of a point mass at `a`; for a unit vector, `scale` about every axis across it.
SimTK::SymMat33 across(double scale, const Vec3& a) {
    return scale * (SimTK::SymMat33(a.normSqr()) -
                    SimTK::SymMat33(a[0] * a[0], a[0] * a[1], a[1] * a[1], a[0] * a[2], a[1] * a[2], a[2] * a[2]));
}

SimTK::MassProperties chassis_mass(const BodyDescription& body) {
    const Vec3 center = to_vec3(body.center_of_mass);
    return {body.mass, center, Inertia(inertia_about_own_center(body) + across(body.mass, center))};
}

SimTK::MassProperties wheel_mass(const CornerDescription& corner) {
    const double spin = corner.wheel.spin_inertia;
    const double transverse = transverse_over_spin_inertia * spin;
    return {wheel_mass_share * corner.carrier.mass, Vec3(0), Inertia(transverse, transverse, spin)};
}

// What the wheel's body leaves of the carrier, about the wheel center.
SimTK::MassProperties carrier_mass(const CornerDescription& corner) {
    const BodyDescription& body = corner.carrier;
    const Vec3 arm = to_vec3(body.center_of_mass) - to_vec3(corner.wheel.center);
    const Vec3 axis(UnitVec3(to_vec3(corner.wheel.spin_axis)));
    const double transverse = transverse_over_spin_inertia * corner.wheel.spin_inertia;
    const double mass = (1 - wheel_mass_share) * body.mass;
    const Vec3 center = arm * body.mass / mass;
    const SimTK::SymMat33 about_wheel =
        inertia_about_own_center(body) + across(body.mass, arm) - across(transverse, axis);
    if (!Inertia::isValidInertiaMatrix(about_wheel - across(mass, center)))
        throw std::invalid_argument(corner.name + ": the carrier's inertia has no room for the wheel's");
    return {mass, center, Inertia(about_wheel)};
}

// The rack has no mass and moves as the inputs say.
class RackMotion : public SimTK::Motion::Custom::Implementation {
public:
    explicit RackMotion(const Inputs& inputs) : inputs_(inputs) {}

    SimTK::Motion::Level getLevel(const State&) const override { return SimTK::Motion::Position; }
    void calcPrescribedPosition(const State&, int, double* q) const override { *q = inputs_.rack; }
    void calcPrescribedPositionDot(const State&, int, double* rate) const override { *rate = inputs_.rack_rate; }
    void calcPrescribedPositionDotDot(const State&, int, double* acceleration) const override {
        *acceleration = inputs_.rack_acceleration;
    }

private:
    const Inputs& inputs_;
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

    const Transform rack_frame(Rotation(linkage.rack_axis, SimTK::XAxis), linkage.rack_end);
    MobilizedBody rack = MobilizedBody::Slider(parts.chassis, rack_frame, Body::Massless(), Transform());
    SimTK::Motion::Custom(rack, new RackMotion(parts.inputs));
    SimTK::Constraint::Rod(rack, Vec3(0), spindle, linkage.tie_rod - center, linkage.tie_rod_length);
}

void add_spindle(Parts& parts, const CornerDescription& corner, CornerParts& bodies) {
    const Linkage linkage(corner);
    const SimTK::MassProperties mass = carrier_mass(corner);
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
    return MobilizedBody::Pin(parts.chassis, Transform(pin_frame, bush), Body::Rigid(carrier_mass(corner)),
                              Transform(pin_frame, bush - to_vec3(corner.wheel.center)));
}

}  // namespace

void add_bodies(Parts& parts, MobilizedBody& ground) {
    parts.chassis = MobilizedBody::Free(ground, Body::Rigid(chassis_mass(parts.description.chassis)));
    bool any_spindle = false;
    for (const CornerDescription& corner : parts.description.corners) {
        CornerParts bodies;
        if (std::holds_alternative<SemiTrailingArmDescription>(corner.suspension)) {
            bodies.carrier = add_arm(parts, corner);
        } else {
            add_spindle(parts, corner, bodies);
            any_spindle = true;
        }
        const Rotation spin_frame(UnitVec3(to_vec3(corner.wheel.spin_axis)), SimTK::ZAxis);
        bodies.wheel =
            MobilizedBody::Pin(bodies.carrier, Transform(spin_frame), Body::Rigid(wheel_mass(corner)), Transform());
        parts.corners.push_back(bodies);
    }
    if (any_spindle && parts.spindle_model == SpindleModel::strut_one_constraint) add_arms_and_tie_rods(parts);
}

}  // namespace hamilcar::oracle
