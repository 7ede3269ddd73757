// What the pieces of the MuJoCo car share: where its bodies and coordinates are, and what acts on them.
//
// Every carrier's body frame sits at the wheel center with the vehicle's axes at design; the chassis frame is the vehicle
// frame itself.
#pragma once

#include "tests/oracle/mujoco_car.hpp"

#include <mujoco/mujoco.h>
#include <Eigen/Dense>

#include <cstddef>
#include <string>
#include <vector>

namespace hamilcar::oracle {

using Eigen::Matrix3d;
using Eigen::Vector3d;

inline Vector3d to_vector(const Point& a) {
    return {a[0], a[1], a[2]};
}

inline constexpr int rods_per_strut = 3;  // two to the control arm's bushes, one to the rack

// MuJoCo numbers its coordinates (q) and speeds (v) apart.
struct SuspensionIndices {
    int carrier = -1, wheel = -1;                // bodies
    int spin_v = -1;                             // wheel relative to carrier
    int independent_q = -1, independent_v = -1;  // arm angle, or the strut's slide
    int states = -1;                             // u, v, b among the activations

    // Of a strut.
    int ball_q = -1, ball_v = -1;  // at its top
    int rack_q = -1, rack_v = -1;
    int first_rod = -1;                         // of the tendons
    std::array<double, rods_per_strut> rods{};  // their lengths [m]

    bool is_strut() const { return ball_q >= 0; }
    // Its place among the description's coordinates; a strut's begin with the ball's.
    std::size_t independent() const { return is_strut() ? 3 : 0; }
};

// The car in MuJoCo's XML format.
std::string write_model(const VehicleDescription&, const MujocoOptions&);

// Owns what mj_loadXML gives for the text; throws std::runtime_error with its complaint.
using ModelPointer = std::unique_ptr<mjModel, void (*)(mjModel*)>;
ModelPointer load_model(const std::string& text);

SuspensionIndices find_suspension(const mjModel&, const SuspensionDescription&);

// A rack's mass is what any body of MuJoCo must have; its armature is inertia that only the rack's own guide feels. So it
// has the acceleration it is told to, whatever the tie rod does: 5 kN are 5e-6 m/s^2. Displacement and rate are set
// anew before every step.
inline constexpr double rack_mass = 1e-6;     // [kg]
inline constexpr double rack_armature = 1e9;  // [kg]

// A rigid body's motion in ground axes, and what has been gathered to act on it.
struct Body {
    Matrix3d rotation = Matrix3d::Identity();
    Vector3d origin{0, 0, 0}, velocity{0, 0, 0}, angular_velocity{0, 0, 0};
    Vector3d force{0, 0, 0}, moment{0, 0, 0};  // moment about the origin

    Vector3d place(const Vector3d& station) const { return origin + rotation * station; }
    Vector3d velocity_at(const Vector3d& point) const { return velocity + angular_velocity.cross(point - origin); }
    void push(const Vector3d& point, const Vector3d& by) {
        force += by;
        moment += (point - origin).cross(by);
    }
};

// A wheel's states beyond motion, or their rates: contact deflections [m] and brake wind-up [rad].
struct WheelStates {
    double u = 0, v = 0, b = 0;
};

struct SuspensionMotion {
    Body carrier;
    double spin = 0;  // of the wheel relative to the carrier [rad/s]
    WheelStates states, rates;
    Vector3d wheel_force{0, 0, 0}, wheel_moment{0, 0, 0};  // on the wheel's body, at its center
    double spin_torque = 0;                                // between carrier and wheel [N m]

    void push_wheel(const Vector3d& point, const Vector3d& by) {
        wheel_force += by;
        wheel_moment += (point - carrier.origin).cross(by);
    }
};

struct CarMotion {
    Body chassis;
    std::vector<SuspensionMotion> suspensions;
};

// Everything of docs/models/forces.md but gravity, which MuJoCo has itself, and the hull: adds the loads, sets the
// rates.
void add_forces(const VehicleDescription&, const Road&, const Inputs&, CarMotion&);

// Everything the road does to the wheel, and the rates of the contact deflections.
void add_tire(const SuspensionDescription&, const Road&, SuspensionMotion&);

}  // namespace hamilcar::oracle
