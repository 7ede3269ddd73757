// A brake system as a person writes it down: from the pedal to the pressure at every wheel. SI units.
#pragma once

namespace hamilcar {

enum class BrakeMedium { fluid, air };
// Which wheels of the motor vehicle share a circuit of the tandem master cylinder.
enum class BrakeCircuits { front_rear, diagonal };

inline constexpr double brake_reference_pressure = 1e7;  // at which volumes and flows of lines are stated, 100 bar [Pa]

struct BrakeSystemDescription {
    bool exists = false;  // otherwise torques follow the pedal at once
    BrakeMedium medium = BrakeMedium::fluid;
    double pedal_force = 0;            // at full command [N]
    double knee_command = 1;           // where the booster's help ends; 1: nowhere [1]
    double knee_pressure = 0;          // there, or at full command [Pa]
    double full_pressure = 0;          // at full command [Pa]
    double response_time = 0;          // of the booster, or of the foot valve, first order [s]
    double trailer_response_time = 0;  // of a trailer's control line, likewise [s]
    double master_area = 0;            // of the master cylinder; 0: unknown [m^2]
    double pedal_ratio = 0;            // force on the booster over that on the pedal [1]
    BrakeCircuits circuits = BrakeCircuits::front_rear;
    int failed_circuit = 0;    // 1 or 2 has no pressure; 0: both work
    bool modulated = false;    // every wheel has valves, and a pump can raise its pressure
    double pump_flow = 0;      // of all pumps together [m^3/s]
    double pump_pressure = 0;  // that they reach [Pa]

    // Of the pressure by the pedal at light braking, over its mean up to full command: 1 without a booster's knee.
    double gain_below_knee() const { return exists ? knee_pressure / (knee_command * full_pressure) : 1; }
};

// What a brake does with its friction power. Relative friction multiplies the torque.
struct BrakeHeatDescription {
    double capacity = 0;           // of disc or drum; 0: it stays cold [J/K]
    double cooling = 0;            // at standstill [W/K]
    double cooling_per_speed = 0;  // in addition, per speed of the tire's tread [W s/(K m)]
};

}  // namespace hamilcar
