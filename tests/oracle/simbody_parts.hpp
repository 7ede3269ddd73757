// What the pieces of the Simbody car share: its bodies, the frames its points are given in, and how to push on them.
//
// Every carrier's body frame sits at the wheel center with the vehicle's axes at design, so a point of the description
// becomes a station by one subtraction; the chassis frame is the vehicle frame itself.
#pragma once

#include "tests/oracle/simbody_car.hpp"

// Debian's library is built with assertions, and some of Simbody's classes lose a member without them.
#ifdef NDEBUG
#error "compile the Simbody car without -DNDEBUG: it crashes otherwise"
#endif

#include <Simbody.h>

#include <array>
#include <cstddef>
#include <vector>

namespace hamilcar::oracle {

using Loads = SimTK::Vector_<SimTK::SpatialVec>;  // moment about the body's origin and force in ground axes, per body

inline SimTK::Vec3 to_vec3(const std::array<double, 3>& a) {
    return {a[0], a[1], a[2]};
}

struct CornerParts {
    SimTK::MobilizedBody carrier;
    SimTK::MobilizedBody wheel;  // turns about its own z, the spin axis
};

struct Parts {
    VehicleDescription description;
    Road road;
    Inputs inputs;
    SimTK::MobilizedBody chassis;
    std::vector<CornerParts> corners;

    SimTK::Vec3 station(std::size_t corner, const Point& point) const {
        return to_vec3(point) - to_vec3(description.corners[corner].wheel.center);
    }

    SimTK::Vec3 spin_axis(const SimTK::State& state, std::size_t corner) const {
        const SimTK::UnitVec3 at_design(to_vec3(description.corners[corner].wheel.spin_axis));
        return corners[corner].carrier.getBodyRotation(state) * SimTK::Vec3(at_design);
    }
};

// Adds every body and constraint to the matter that `ground` belongs to.
void add_bodies(Parts&, SimTK::MobilizedBody& ground);

// A MacPherson corner as points and lengths in design coordinates, spindle points included.
struct Linkage {
    explicit Linkage(const CornerDescription&);

    SimTK::Vec3 wheel_center;
    SimTK::Vec3 top, slide;
    SimTK::UnitVec3 slide_axis;  // on the spindle, from S to T
    SimTK::Vec3 arm_foot, ball;
    SimTK::UnitVec3 arm_axis;
    double arm_length;
    SimTK::Vec3 rack_end, tie_rod;
    SimTK::UnitVec3 rack_axis;
    double tie_rod_length;
};

// From spindle stations to the vehicle frame; throws std::runtime_error where there is no such pose.
SimTK::Transform spindle_pose(const Linkage&, double strut_length, double rack);

// Relative to the chassis, in its axes: angular velocity and velocity of the wheel center.
SimTK::SpatialVec spindle_twist(const Linkage&, const SimTK::Transform& pose, double strut_rate, const Inputs&);

// A force at a point given in ground axes.
void push(const SimTK::MobilizedBody&, const SimTK::State&, const SimTK::Vec3& point, const SimTK::Vec3& force, Loads&);
void twist(const SimTK::MobilizedBody&, const SimTK::Vec3& moment, Loads&);
SimTK::Vec3 velocity_at(const SimTK::MobilizedBody&, const SimTK::State&, const SimTK::Vec3& point);

// A point of the carrier and one of the chassis with the distance between them; all vectors in ground axes.
struct Line {
    SimTK::Vec3 on_carrier, on_chassis;
    SimTK::UnitVec3 direction;  // from carrier to chassis
    double length, rate;
};

Line line_between(const Parts&, const SimTK::State&, std::size_t corner, const Point& on_carrier,
                  const Point& on_chassis);

// Contact deflections or their rates.
struct Deflection {
    double u = 0, v = 0;
};

// Loads the wheel with everything the road does to it, and returns the rates of the deflections.
Deflection add_tire(const Parts&, const SimTK::State&, std::size_t corner, const Deflection&, Loads&);

double tire_energy(const Parts&, const SimTK::State&, std::size_t corner);

// Everything of docs/models/forces.md but gravity, which Simbody has itself. The contact deflections and the brake
// wind-up are three z-variables per corner in the order u, v, b. The force subsystem takes ownership.
SimTK::Force::Custom::Implementation* make_forces(const Parts&, const SimTK::GeneralForceSubsystem&);

}  // namespace hamilcar::oracle
