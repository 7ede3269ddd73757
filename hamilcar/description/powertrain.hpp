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

inline constexpr int max_power_units = 8;
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

// Over speed, at rising values of a second quantity.
struct MapDescription {
    std::vector<double> level;               // increasing
    std::vector<std::vector<double>> speed;  // at each level [rad/s], increasing
    std::vector<std::vector<double>> value;
};

// An electric motor: constant torque up to its base speed, constant power from there on; or a map.
struct MotorDescription {
    double max_torque = 0;          // [N m]
    double max_power = 0;           // [W]
    double max_speed = 0;           // the torque fades out before it [rad/s]
    double regeneration = 0;        // share of the torque that brakes when the pedal is released [1]
    double brake_regeneration = 0;  // share of the torque that the brake pedal may use in place of friction [1]
    MapDescription torque;          // the largest, over speed [N m], at voltages [V]; empty: by the numbers above
    double efficiency = 1;          // mechanical over electrical power, or the reverse where it brakes [1]
    MapDescription efficiency_map;  // the same over speed, at torques [N m]; empty: the number above
};

// What motors take their power from. Open-circuit voltage over charge, behind a resistance.
struct BatteryDescription {
    bool exists = false;
    double capacity = 0;                       // [C]
    double initial_charge = 0.8;               // [1]
    std::vector<double> charge;                // 0 to 1, increasing
    std::vector<double> voltage;               // at each of them, without current [V]
    double resistance = 0;                     // [ohm]
    double max_discharge = 0, max_charge = 0;  // power at its terminals [W]
    double auxiliary_power = 0;                // of everything else on board [W]
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

// A wheel by its number in the vehicle's order, or a differential, which comes before what drives it.
struct DrivenPart {
    bool wheel = true;
    std::size_t number = 0;
};

// Shafts behind a gearbox whose input has an inertia of its own, so that clutch and shafts wind up separately.
struct ShaftsDescription {
    bool exists = false;
    double gearbox_inertia = 0;  // of clutch disc, input shaft and gears, at the gearbox's input [kg m^2]
    double stiffness = 0;        // of the propeller shaft, at the gearbox's output [N m/rad]
    double damping_ratio = 0.1;  // of the torsion behind the gearbox [1]
    double backlash = 0;         // full play of gears and joints, at the gearbox's output [rad]
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
    ShaftsDescription shafts;
    DrivenPart output{.wheel = false, .number = 0};
    bool in_wheel = false;  // it sits on the carrier of the wheel that it drives, and its rotor turns with the wheel
};

enum class DifferentialKind { open, locked, limited_slip, torque_biasing, viscous };

// Speeds in = ratio (share a + (1 - share) b), torques a = share ratio in - lock, b = (1 - share) ratio in + lock.
struct DifferentialDescription {
    std::string name;
    DifferentialKind kind = DifferentialKind::open;
    double ratio = 1;    // input speed over output speed [1]
    double share = 0.5;  // of the torque that goes to the first output, while nothing locks [1]
    std::array<DrivenPart, 2> outputs;
    // About which its input shaft turns, in the chassis; matters where the differential sits on a live axle.
    std::array<double, 3> shaft_axis{-1, 0, 0};
    double preload = 0;          // locking torque without load [N m]
    double locking_drive = 0;    // locking torque as a share of the outgoing torque that drives ahead [1]
    double locking_coast = 0;    // and of one that brakes or drives back [1]
    double viscosity = 0;        // locking torque over speed difference [N m s/rad]
    double shaft_stiffness = 0;  // of each shaft to an output [N m/rad]
    double damping_ratio = 0.1;  // of the torsion between the outputs [1]
};

}  // namespace hamilcar
