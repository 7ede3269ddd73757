// What drives a vehicle, as a person writes it down: power units (engine or motor, clutch or converter, gearbox) and the tree
// of differentials that leads their torque to wheels. SI units, radians; torques about the rotor where nothing else is said.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hamilcar {

inline constexpr int max_power_units = 4;
inline constexpr int max_differentials = 12;
inline constexpr int max_gears = 20;         // forward
inline constexpr int max_curve_points = 24;  // of a torque curve

// Torque over speed, piecewise linear, constant beyond its ends.
struct TorqueCurve {
    std::vector<double> speed;   // [rad/s], increasing
    std::vector<double> torque;  // [N m]
};

// An internal combustion engine. Between the throttle levels the torque is interpolated.
struct EngineDescription {
    std::vector<double> throttle;     // 0 (overrun) to 1 (full load), increasing
    std::vector<TorqueCurve> torque;  // at each of them
    double idle_speed = 0;            // held by a governor [rad/s]
};

// An electric motor: constant torque up to its base speed, constant power from there on.
struct MotorDescription {
    double max_torque = 0;    // [N m]
    double max_power = 0;     // [W]
    double max_speed = 0;     // the torque fades out before it [rad/s]
    double regeneration = 0;  // share of the torque that brakes when the pedal is released [1]
};

// Dry friction between rotor and gearbox; capacity 0: rotor and gearbox are one, and nothing slips.
struct ClutchDescription {
    double capacity = 0;  // torque that the closed clutch holds [N m]
};

// A torque converter, and the clutch that bridges it.
struct ConverterDescription {
    std::vector<double> speed_ratio;   // turbine over pump, 0 to 1, increasing [1]
    std::vector<double> torque_ratio;  // turbine over pump [1]
    std::vector<double> capacity;      // pump torque at 1 rad/s: T = capacity speed^2 [N m s^2/rad^2]
    double lockup_capacity = 0;        // [N m]
};

struct GearboxDescription {
    std::vector<double> ratios{1};      // of the forward gears, first gear first [1]
    double reverse_ratio = 0;           // positive; 0: there is no reverse gear [1]
    double efficiency = 1;              // [1]
    bool automatic = false;             // shifts by itself
    double shift_time = 0.5;            // from the release of the clutch to its closing, or of a power shift [s]
    double upshift_speed = 0;           // of the rotor at full throttle [rad/s]; 0: no shifting up
    double upshift_speed_closed = 0;    // at closed throttle [rad/s]
    double downshift_speed = 0;         // at full throttle [rad/s]
    double downshift_speed_closed = 0;  // at closed throttle [rad/s]
};

struct PowerUnitDescription {
    std::string name;  // "engine": prefix of its channels
    std::variant<EngineDescription, MotorDescription> source;
    double inertia = 0;                    // of everything that turns with the rotor [kg m^2]
    std::array<double, 3> axis{-1, 0, 0};  // of its rotation, fixed in the chassis, unit
    double response_time = 0;              // of the torque to the pedal, first order [s]; 0: at once
    std::variant<ClutchDescription, ConverterDescription> coupling;
    double stiffness = 0;  // of clutch springs and shafts up to the last differential, seen from the rotor [N m/rad]
    double damping_ratio = 0;  // of the whole driveline's torsion, wheels off the ground [1]
    GearboxDescription gearbox;
    std::size_t output = 0;  // of the differentials; the one it drives
};

enum class DifferentialKind { open, locked, limited_slip, torque_biasing, viscous };

// Speeds in = ratio (share a + (1 - share) b), torques a = share ratio in - lock, b = (1 - share) ratio in + lock.
struct DifferentialDescription {
    std::string name;
    DifferentialKind kind = DifferentialKind::open;
    double ratio = 1;    // input speed over output speed [1]
    double share = 0.5;  // of the torque that goes to the first output, while nothing locks [1]
    // Driven by it: a wheel by its number in the vehicle's order, or one of the differentials before this one.
    struct Output {
        bool wheel = true;
        std::size_t number = 0;
    };
    std::array<Output, 2> outputs;
    double preload = 0;          // locking torque without load [N m]
    double locking_drive = 0;    // locking torque as a share of the outgoing torque that drives ahead [1]
    double locking_coast = 0;    // and of one that brakes or drives back [1]
    double viscosity = 0;        // locking torque over speed difference [N m s/rad]
    double shaft_stiffness = 0;  // of each shaft to an output [N m/rad]
    double damping_ratio = 0.1;  // of the torsion between the outputs [1]
};

}  // namespace hamilcar
