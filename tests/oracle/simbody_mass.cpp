// Mass properties: the description gives a carrier with its wheel but for the spin inertia; Simbody wants two bodies.

#include "tests/oracle/simbody_parts.hpp"

#include <stdexcept>

namespace hamilcar::oracle {

using SimTK::Inertia;
using SimTK::MassProperties;
using SimTK::SymMat33;
using SimTK::UnitVec3;
using SimTK::Vec3;

namespace {

// The split between carrier and wheel does not change the motion, as the wheel is a body of revolution; it only has to
// leave bodies that can exist. A disc without thickness has 0.5 here; much more, and a light knuckle is left with less
// than nothing.
constexpr double wheel_mass_share = 0.1;
constexpr double transverse_over_spin_inertia = 0.505;

SymMat33 inertia_about_own_center(const BodyDescription& body) {
    const auto& [xx, yy, zz] = body.inertia;
    const auto& [xy, yz, xz] = body.products;
    return SymMat33(xx, xy, yy, xz, yz, zz);
}

// scale (|a|^2 1 - a a^T): of a point mass at `a`; for a unit vector, `scale` about every axis across it.
SymMat33 across(double scale, const Vec3& a) {
    return scale * (SymMat33(a.normSqr()) -
                    SymMat33(a[0] * a[0], a[0] * a[1], a[1] * a[1], a[0] * a[2], a[1] * a[2], a[2] * a[2]));
}

}  // namespace

MassProperties mass_about(const BodyDescription& body, const Vec3& origin) {
    const Vec3 center = to_vec3(body.center_of_mass) - origin;
    return {body.mass, center, Inertia(inertia_about_own_center(body) + across(body.mass, center))};
}

MassProperties wheel_mass(const WheelDescription& wheel, double mass) {
    const double transverse = transverse_over_spin_inertia * wheel.spin_inertia;
    return {mass, Vec3(0), Inertia(transverse, transverse, wheel.spin_inertia)};
}

double wheel_mass_of(double described_mass, std::size_t wheels) {
    return wheel_mass_share * described_mass / static_cast<double>(wheels);
}

MassProperties carrier_mass(const std::string& name, const std::vector<BodyDescription>& bodies,
                            const std::vector<WheelDescription>& wheels, const Vec3& origin) {
    double described = 0;
    for (const BodyDescription& body : bodies) described += body.mass;
    double mass = described;
    Vec3 moment(0);
    SymMat33 about_origin(0);
    for (const BodyDescription& body : bodies) {
        const Vec3 arm = to_vec3(body.center_of_mass) - origin;
        moment += body.mass * arm;
        about_origin += inertia_about_own_center(body) + across(body.mass, arm);
    }
    for (const WheelDescription& wheel : wheels) {
        const double wheel_mass = wheel_mass_of(described, wheels.size());
        const Vec3 arm = to_vec3(wheel.center) - origin;
        mass -= wheel_mass;
        moment -= wheel_mass * arm;
        about_origin -= across(wheel_mass, arm) + across(transverse_over_spin_inertia * wheel.spin_inertia,
                                                         Vec3(UnitVec3(to_vec3(wheel.spin_axis))));
    }
    if (mass <= 0) throw std::invalid_argument(name + ": Simbody moves no body without mass that carries no other");
    const Vec3 center = moment / mass;
    if (!Inertia::isValidInertiaMatrix(about_origin - across(mass, center)))
        throw std::invalid_argument(name + ": the carrier's inertia has no room for the wheel's");
    return {mass, center, Inertia(about_origin)};
}

}  // namespace hamilcar::oracle
