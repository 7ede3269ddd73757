// A vehicle as a person writes it down: hardpoints, masses, rates, in the vehicle frame at the design position.
//
// Vehicle frame: ISO 8855 (x forward, y left, z up), origin wherever the file puts it. SI units, radians. Nothing here is
// precomputed and nothing is templated: `Vehicle` turns this into the constants of the equations, and any
// independent program (our Simbody check is one) can build the same car from the same numbers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hamilcar/description/brakes.hpp"
#include "hamilcar/description/control.hpp"
#include "hamilcar/description/linkage.hpp"
#include "hamilcar/description/places.hpp"
#include "hamilcar/description/powertrain.hpp"
#include "hamilcar/description/steering.hpp"
#include "hamilcar/description/tire.hpp"

namespace hamilcar {

inline constexpr int max_suspensions = 40;
inline constexpr int max_trailers = 8;

// A rigid body; inertia about its own center of mass, axes parallel to the vehicle frame at design.
struct BodyDescription {
    double mass = 0;         // [kg]
    Point center_of_mass{};  // [m]
    Point inertia{};         // Ixx, Iyy, Izz [kg m^2]
    Point products{};        // Ixy, Iyz, Ixz as matrix entries (the off-diagonal elements themselves) [kg m^2]
};

// The carrier's inertia in BodyDescription excludes the part `spin_inertia * e e^T` that turns with the wheel.
struct WheelDescription {
    Point center{};           // [m]
    Point spin_axis{};        // unit, toward +y: a wheel rolling forward spins positive about it
    double spin_inertia = 0;  // wheel, tire and disc about the spin axis [kg m^2]
};

// Axial force F = force_at_design + rate (seat + design length - length), positive in compression.
struct SpringDescription {
    double rate = 0;             // [N/m]
    double force_at_design = 0;  // [N]
    bool carries = false;        // that force was found such that the vehicle stands at design (block/preload.hpp)
    double seat = 0;             // how much a seat compresses it beyond that force [m]
};

// Force against velocity of extension, piecewise linear through the points, continued with the outer slopes.
// A linear damper is two points. Velocities increase and the curve passes through the origin.
struct DamperDescription {
    std::vector<double> velocity;  // [m/s], positive in rebound (extension)
    std::vector<double> force;     // [N], positive opposes extension
    // Adjustable where firm > soft, from 0 to 1 and from 1 on: between these shares of the force, by a command from 0 to 1 that it follows
    // with a lag.
    double soft = 1, firm = 1;
    double response_time = 0.01;  // [s]
    bool is_adjustable() const { return firm > soft; }
};

// Stops act on wheel travel (wheel center, vehicle z, relative to design): F = rate x + progression x^2 beyond the gap.
struct StopDescription {
    double gap = 0;          // free travel from design [m], positive
    double rate = 0;         // [N/m]
    double progression = 0;  // [N/m^2]
};

// A proportioning valve lets the torque grow by a smaller share from some pedal command on.
struct BrakeDescription {
    double max_torque = 0;        // at full command, without a valve [N m]
    double windup_stiffness = 0;  // of caliper and mounting, seen by a locked wheel [N m/rad]
    double windup_damping = 0;    // [N m s/rad]
    double valve_command = 1;     // from which on the valve acts; 1: no valve [1]
    double valve_slope = 1;       // share of the growth that it lets through [1]
    // The rest is for a vehicle with a brake system (BrakeSystemDescription).
    double volume = 0, line_flow = 0;  // of fluid: taken, and through the line, at the reference pressure [m^3, m^3/s]
    double fill_time = 0, release_time = 0;  // of air: time constants of the chamber [s]
    double self_energizing = 0;              // share of a drum's torque that its own friction brings; 0: a disc [1]
    BrakeHeatDescription heat;
    std::vector<double> temperature, friction;  // relative friction over temperature [degree C, 1]; empty: 1
    double friction_loss_per_speed = 0;         // share of the friction lost per sliding speed of the pads [s/m]
    double friction_radius = 0;                 // where the pads act; of that speed [m]
    double parking_torque = 0;                  // of the parking brake fully applied; in any vehicle [N m]
};

// A suspension as a composition of parts: an axle with two wheels, or one wheel's own. The motor vehicle is unit 0,
// trailer i unit i + 1.
struct SuspensionBodyDescription {
    std::size_t part = 1;
    BodyDescription body;
};

struct SuspensionWheelDescription {
    std::string name;      // "rear_left": prefix of its channels
    std::size_t part = 1;  // the carrier
    WheelDescription wheel;
    double dual_spacing = 0;  // two tires that far apart along the spin axis; zero: one tire [m]
    StopDescription bump, rebound;
    TireDescription tire;
    BrakeDescription brake;
    double drive_share = 0;  // of the drive torque at this wheel [1]
    std::size_t drive_reaction =
        0;  // part that the drive torque reacts on: the chassis, or where the differential sits
    std::optional<int>
        bar_arm;  // coordinate of the linkage, the angle of an anti-roll bar's arm; none: the bar acts on travel

    int tires() const { return dual_spacing > 0 ? 2 : 1; }
};

// What a spring or a damper acts along: between two points, or along (about) a coordinate of the linkage.
struct LineDescription {
    std::size_t part = 1, base = 0;
    Point on_part{}, on_base{};
    std::optional<int> coordinate;
    double at_design = 0;  // length along the coordinate there [m or rad]
};

struct SuspensionSpringDescription {
    std::string name;  // of the wheel it belongs to, prefix of its channels
    LineDescription line;
    SpringDescription spring;  // along a rotation: [N m/rad], [N m]
};

struct SuspensionDamperDescription {
    std::string name;
    LineDescription line;
    DamperDescription damper;
};

struct SuspensionDescription {
    std::string name;      // "rear", or "rear_left" where each wheel has its own
    std::string keyword;   // "macpherson"
    std::size_t unit = 0;  // what it hangs on
    LinkageDescription linkage;
    std::vector<SuspensionBodyDescription> bodies;
    std::vector<SuspensionWheelDescription> wheels;
    std::vector<SuspensionSpringDescription> springs;
    std::vector<SuspensionDamperDescription> dampers;
    std::optional<std::size_t> steered_by;  // of the vehicle's axle_steers; none: the rack of the steering wheel
};

// An axle whose rack an actuator moves by a command.
inline constexpr std::size_t max_axle_steers = 4;
struct AxleSteerDescription {
    std::string axle;
    double travel = 0;         // of its rack at a command of 1 [m]
    double frequency = 0;      // of the actuator, undamped [rad/s]
    double damping_ratio = 1;  // [1]
};

// Couples two wheels, numbered through all suspensions in order: force rate * (z_left - z_right) on their travels pushes the higher
// one down; where the bar's arms are parts of the linkages (SuspensionWheelDescription::bar_arm), a moment on their angles likewise.
struct AntiRollBarDescription {
    std::size_t left = 0, right = 0;
    double rate = 0;  // of the difference of travels [N/m], or of the arms' angles [N m/rad]
    // Active where above zero: what pushes the left wheel down and the right one up besides, at a command of 1; it follows with a lag.
    double max_force = 0;         // [N]
    double response_time = 0.03;  // [s]
};

// ball: yaw, roll and pitch; fifth_wheel: its plate pitches on what pulls, the trailer yaws on the plate, roll is passed on.
enum class Hitch { ball, fifth_wheel };

// The hitch's coordinates in order.
inline std::vector<std::string> hitch_angles(Hitch hitch) {
    if (hitch == Hitch::ball) return {"yaw", "roll", "pitch"};
    return {"pitch", "yaw"};
}
inline int hitch_yaw(Hitch hitch) {
    return hitch == Hitch::ball ? 0 : 1;
}

// What a body looks like from outside, for pictures alone: nothing is calculated from it.
enum class BodyStyle { sedan, hatchback, off_roader, pickup, van, truck, box, open_wheeler };
inline constexpr std::array<std::string_view, 8> body_style_names{"sedan", "hatchback", "off_roader", "pickup",
                                                                  "van",   "truck",     "box",        "open_wheeler"};

struct BodyworkDescription {
    BodyStyle style = BodyStyle::sedan;
    double front = 0;            // along x, of its foremost point [m]
    double length = 0;           // [m]
    double width = 0;            // without mirrors [m]
    double bottom = 0, top = 0;  // along z, of its floor and of its highest point [m]
};

struct TrailerDescription {
    std::string name;
    Hitch hitch = Hitch::ball;
    std::size_t tow = 0;     // the unit that pulls it, one of those before
    Point hitch_point{};     // in the motor vehicle's frame while the combination stands straight, as all its points
    double yaw_damping = 0;  // [N m s/rad]
    BodyDescription chassis;
    std::optional<BodyworkDescription> bodywork = {};
};

// Forces in the flow v of the air against the chassis, with q = rho |v| / 2 at `center`:
// along x -q drag_area v_x, along y -q side_area v_y; lift upward q |v| lift_area at each axle; yaw moment -q yaw_volume v_y.
struct AerodynamicsDescription {
    double drag_area = 0;             // C_d A [m^2]
    double air_density = 0;           // [kg/m^3]
    Point center{};                   // where drag and side force act [m]
    std::optional<double> side_area;  // force against the cross flow, per sine of its angle; as the drag if empty [m^2]
    double yaw_volume = 0;            // moment that turns the car into the cross flow's lee, likewise [m^3]
    std::array<double, 2> lift_area{};   // C_l A, upward, in front and in the rear [m^2]
    std::array<double, 2> lift_place{};  // where along x they act [m]
};

// Points of the body that may touch the road when the car tips over (docs/models/forces.md, "Hull").
struct HullDescription {
    std::vector<Point> points;  // [m]
    double stiffness = 0;       // of each point [N/m]
    double damping = 0;         // of each point, per depth and speed: F = stiffness depth (1 + damping depth') [s/m]
    double friction = 0;        // [1]
};

struct SteeringDescription {
    double rack_per_revolution = 0;  // rack travel per turn of the steering wheel [m]
    double rack_travel = 0;          // half travel: |rack| stays below it [m]
    // A ratio that varies: angles of the steering wheel from 0 on, and the rack there; mirrored to the other side. Empty: the
    // ratio above everywhere.
    std::vector<double> angle, rack;  // [rad], [m]
    std::optional<SteeringMechanicsDescription> mechanics;
    // By a scenario: the mechanics are there. Otherwise the rack is prescribed.
    bool is_free = false;
    bool moves_on_its_own() const { return is_free && mechanics.has_value(); }
};

struct VehicleDescription {
    std::string name;
    BodyDescription chassis;
    std::vector<SuspensionDescription> suspensions;
    std::vector<AntiRollBarDescription> anti_roll_bars;
    std::vector<TrailerDescription> trailers;
    AerodynamicsDescription aerodynamics;
    HullDescription hull;
    SteeringDescription steering;
    std::vector<PowerUnitDescription> power_units;
    std::vector<DifferentialDescription> differentials;  // outputs before inputs
    BatteryDescription battery = {};
    std::vector<AxleSteerDescription> axle_steers = {};
    double gravity = 9.80665;                             // [m/s^2]
    BrakeSystemDescription brakes = {};                   // from the pedal to the wheels
    std::vector<ControllerDescription> controllers = {};  // in the order in which they decide
    SensorsDescription sensors = {};
    std::optional<BodyworkDescription> bodywork = {};  // of the motor vehicle
    std::shared_ptr<const Places> places;              // of its keys; none where no file was read
};

// Calls f(wheel, unit) for all wheels, in the vehicle's order.
template <class F>
void for_each_wheel(const VehicleDescription& vehicle, F&& f) {
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        for (const SuspensionWheelDescription& wheel : suspension.wheels) f(wheel, suspension.unit);
    }
}

// Of the drive torque, at all wheels together [1].
inline double driven_share(const VehicleDescription& vehicle) {
    double driven = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { driven += wheel.drive_share; });
    return driven;
}

inline bool has_parking_brake(const VehicleDescription& vehicle) {
    bool has = false;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { has = has || wheel.brake.parking_torque > 0; });
    return has;
}

inline std::size_t wheel_count(const VehicleDescription& vehicle) {
    std::size_t count = 0;
    for (const SuspensionDescription& suspension : vehicle.suspensions) count += suspension.wheels.size();
    return count;
}

}  // namespace hamilcar
