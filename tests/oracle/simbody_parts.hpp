// What the pieces of the Simbody car share: its bodies, the frames its points are given in, and how to push on them.
//
// Every body frame has the vehicle's axes at design and sits at some point of the design position, so a point of the
// description becomes a station by one subtraction. To the forces there are only wheels, each with its carrier and its unit,
// and lines between bodies.
#pragma once

#include "tests/oracle/simbody_car.hpp"

// Debian's library is built with assertions, and some of Simbody's classes lose a member without them.
#ifdef NDEBUG
#error "compile the Simbody car without -DNDEBUG: it crashes otherwise"
#endif

#include <Simbody.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hamilcar::oracle {

using Loads = SimTK::Vector_<SimTK::SpatialVec>;  // moment about the body's origin and force in ground axes, per body

inline SimTK::Vec3 to_vec3(const std::array<double, 3>& a) {
    return {a[0], a[1], a[2]};
}

// A body that forces may act on, with the point that its frame sits at.
struct Placed {
    SimTK::MobilizedBody body;
    SimTK::Vec3 origin{0};

    SimTK::Vec3 station(const Point& point) const { return to_vec3(point) - origin; }
};

// One of a mobilizer's coordinates; its rate is the speed of the same number.
struct Coordinate {
    SimTK::MobilizedBody body;
    int number = 0;

    double value(const SimTK::State& state) const { return body.getOneQ(state, number); }
    double rate(const SimTK::State& state) const { return body.getOneU(state, number); }
    void set(double value, double rate, SimTK::State& state) const {
        body.setOneQ(state, number, value);
        body.setOneU(state, number, rate);
    }
    void push(double force, const SimTK::State& state, SimTK::Vector& mobility_forces) const {
        body.applyOneMobilityForce(state, number, force, mobility_forces);
    }
};

struct RoadWheel {
    SuspensionWheelDescription description;
    std::size_t unit, carrier, wheel;  // among Parts::bodies; the wheel turns about its own z, the spin axis
    std::size_t drive_base;            // the body that the drive torque reacts on
    int first_z;                       // of its z-variables: u, v of each tire, then the brake wind-up

    int tires() const { return description.dual_spacing > 0 ? 2 : 1; }
    int windup_z() const { return first_z + 2 * tires(); }
};

// A spring and a damper on one line: between two stations, or along a coordinate.
struct AxialElement {
    std::size_t part, base;  // among Parts::bodies
    SimTK::Vec3 on_part, on_base;
    std::optional<Coordinate> coordinate;
    SpringDescription spring;
    DamperDescription damper;
    double design_length = 0;
};

// A suspension, or a hitch, with its coordinates in the description's order.
struct TreeParts {
    std::vector<Coordinate> coordinates;
    std::size_t first_wheel = 0;  // among Parts::wheels
    std::size_t yaw = 0;          // of a hitch: which coordinate

    void add(const SimTK::MobilizedBody& mobilizer, int count) {
        for (int k = 0; k < count; ++k) coordinates.push_back({mobilizer, k});
    }
};

struct Parts {
    VehicleDescription description;
    Road road;
    SpindleModel spindle_model;
    Inputs inputs;
    SimTK::MobilizedBody chassis;
    std::vector<Placed> bodies;     // every body that forces act on; first the units: chassis, trailers
    std::vector<RoadWheel> wheels;  // in the description's order
    std::vector<AxialElement> axial;
    std::vector<TreeParts> suspensions, hitches;
    int z_count = 0;

    // Adds a body at the point it was placed at.
    std::size_t place(const SimTK::MobilizedBody& body, const SimTK::Vec3& origin) {
        bodies.push_back({body, origin});
        return bodies.size() - 1;
    }
};

// Adds every body and constraint to the matter that `ground` belongs to.
void add_bodies(Parts&, SimTK::MobilizedBody& ground);

// The suspensions, on units that are there; with their wheels, springs and dampers.
void add_suspensions(Parts&);

// A wheel of that mass, and its z-variables, on a carrier that is there.
void add_wheel(Parts&, const SuspensionWheelDescription&, std::size_t unit, std::size_t carrier, std::size_t drive_base,
               double mass);

// One coordinate as a mobilizer of its own: the child's frame sits at `station` of the parent at design and slides
// along the axis or turns about it.
SimTK::MobilizedBody add_coordinate(SimTK::MobilizedBody parent, const SimTK::Vec3& station, bool slides,
                                    const SimTK::UnitVec3& axis, const SimTK::Body& body);

// The three angles of a ball, about z, x', y'', in one mobilizer.
SimTK::MobilizedBody add_ball(SimTK::MobilizedBody parent, const SimTK::Vec3& station, const SimTK::Body& body);

// A massless slider at `station` of `base`, displaced by `drive` times the rack.
SimTK::MobilizedBody add_rack(const Parts&, SimTK::MobilizedBody base, const SimTK::Vec3& station,
                              const SimTK::Vec3& drive);

// Of one body about a point of the design position.
SimTK::MassProperties mass_about(const BodyDescription&, const SimTK::Vec3& origin);

// A wheel takes its transverse inertia, and a share of the mass, from the bodies that are described with it.
SimTK::MassProperties wheel_mass(const WheelDescription&, double mass);
double wheel_mass_of(double described_mass, std::size_t wheels);
// What the wheels leave of the bodies; throws std::invalid_argument if that is not a body.
SimTK::MassProperties carrier_mass(const std::string& name, const std::vector<BodyDescription>& bodies,
                                   const std::vector<WheelDescription>& wheels, const SimTK::Vec3& origin);

bool is_strut(const SuspensionDescription&);

// The suspension whose tree and cut joints a model asks for; a strut's spindle may be free instead, or lack its links.
SuspensionDescription modelled(const SuspensionDescription&, SpindleModel);

// Coordinates of a strut as those of its spindle free in space, and back.
TreeState freed(const SuspensionDescription&, const TreeState& strut);
TreeState on_its_strut(const SuspensionDescription&, const TreeState& spindle);

// SpindleModel::strut_one_constraint: what holds all spindles on their struts, once they are there.
void add_arms_and_tie_rods(Parts&);

// Coordinates, speeds and z-variables in and out.
void set_suspension(const Parts&, std::size_t suspension, const TreeState&, SimTK::State&, SimTK::Vector& z);
TreeState suspension_of(const Parts&, std::size_t suspension, const SimTK::State&, const SimTK::Vector& z);
void set_hitch(const Parts&, std::size_t trailer, const HitchState&, SimTK::State&);
HitchState hitch_of(const Parts&, std::size_t trailer, const SimTK::State&);

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

struct WheelMotion {
    SimTK::Vec3 center, spin_axis;
    double spin;  // relative to the carrier
};

struct CarMotion {
    CarMotion(const Parts&, const SimTK::State&);

    std::vector<MovingBody> bodies;   // as in Parts
    std::vector<WheelMotion> wheels;  // likewise
};

// Two stations of two bodies with the distance between them; all vectors in ground axes.
struct Line {
    SimTK::Vec3 on_part, on_base;
    SimTK::UnitVec3 direction;  // from part to base
    double length, rate;
};

Line line_between(const AxialElement&, const CarMotion&);

// Contact deflections or their rates.
struct Deflection {
    double u = 0, v = 0;
};

// Loads the wheel with everything the road does to one of its tires, and returns the rates of the deflections.
Deflection add_tire(const Parts&, std::size_t wheel, int tire, const Deflection&, CarMotion&);

double tire_energy(const Parts&, std::size_t wheel, int tire, const CarMotion&);

// Everything of docs/models/forces.md but gravity, which Simbody has itself, and the hull. The force subsystem takes
// ownership.
SimTK::Force::Custom::Implementation* make_forces(const Parts&, const SimTK::GeneralForceSubsystem&);

}  // namespace hamilcar::oracle
