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
    SimTK::MobilizedBody wheel;       // turns about its own z, the spin axis
    SimTK::MobilizedBody piston_rod;  // of a spindle on its strut
};

struct Parts {
    VehicleDescription description;
    Road road;
    SpindleModel spindle_model;
    Inputs inputs;
    SimTK::MobilizedBody chassis;
    std::vector<CornerParts> corners;

    SimTK::Vec3 station(std::size_t corner, const Point& point) const {
        return to_vec3(point) - to_vec3(description.corners[corner].wheel.center);
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

// A carrier of that mass on its piston rod.
void add_strut(Parts&, const Linkage&, const SimTK::MassProperties&, CornerParts&);

// SpindleModel::strut_one_constraint: what holds all carriers on piston rods, once they are there.
void add_arms_and_tie_rods(Parts&);

// From spindle stations to the vehicle frame; throws std::runtime_error where there is no such pose.
SimTK::Transform spindle_pose(const Linkage&, double strut_length, double rack);

// Relative to the chassis, in its axes: angular velocity and velocity of the wheel center.
SimTK::SpatialVec spindle_twist(const Linkage&, const SimTK::Transform& pose, double strut_rate, const Inputs&);

// A body in ground axes, at one instant, and what pushes on it. Simbody is asked for each pose and velocity once per
// evaluation, as its answers cost more than the arithmetic on them.
class MovingBody {
public:
    MovingBody(const SimTK::MobilizedBody&, const SimTK::State&);

    SimTK::Vec3 velocity_at(const SimTK::Vec3& point) const;
    void push(const SimTK::Vec3& point, const SimTK::Vec3& force);
    void twist(const SimTK::Vec3& moment) { load_[0] += moment; }
    void add_load(Loads& loads) const { loads[index_] += load_; }

    const SimTK::Transform& pose;
    const SimTK::SpatialVec& velocity;

private:
    SimTK::MobilizedBodyIndex index_;
    SimTK::SpatialVec load_{SimTK::Vec3(0), SimTK::Vec3(0)};
};

struct CornerMotion {
    MovingBody carrier, wheel;
    SimTK::Vec3 spin_axis;
    double spin;  // relative to the carrier
};

struct CarMotion {
    CarMotion(const Parts&, const SimTK::State&);

    MovingBody chassis;
    std::vector<CornerMotion> corners;
};

// A point of the carrier and one of the chassis with the distance between them; all vectors in ground axes.
struct Line {
    SimTK::Vec3 on_carrier, on_chassis;
    SimTK::UnitVec3 direction;  // from carrier to chassis
    double length, rate;
};

Line line_between(const Parts&, const CarMotion&, std::size_t corner, const Point& on_carrier, const Point& on_chassis);

// Contact deflections or their rates.
struct Deflection {
    double u = 0, v = 0;
};

// Loads the wheel with everything the road does to it, and returns the rates of the deflections.
Deflection add_tire(const Parts&, std::size_t corner, const Deflection&, CornerMotion&);

double tire_energy(const Parts&, std::size_t corner, const CornerMotion&);

// Everything of docs/models/forces.md but gravity, which Simbody has itself. The contact deflections and the brake
// wind-up are three z-variables per corner in the order u, v, b. The force subsystem takes ownership.
SimTK::Force::Custom::Implementation* make_forces(const Parts&, const SimTK::GeneralForceSubsystem&);

}  // namespace hamilcar::oracle
