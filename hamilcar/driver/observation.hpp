// What closed-loop drivers observe of the car, and the constants of the car that they know.
#pragma once

#include <array>

#include "hamilcar/description/powertrain.hpp"

namespace hamilcar {

// Constants of the car, determined once from its initial state.
struct DrivenCar {
    double mass = 0;              // of everything [kg]
    double wheelbase = 1;         // from the mean steered to the mean other axle of the motor vehicle [m]
    double center_behind = 0;     // of the center of mass behind the steered axle [m]
    double lock = 0;              // of the steering wheel, in each direction; 0: no steering [rad]
    double wheels_per_angle = 0;  // turn of the steered wheels per turn of the steering wheel, near straight ahead [1]
    double wheel_radius = 0;      // of the driven wheels; 0: no driven wheels [m]
    double full_brake_force = 0;  // of all brakes at full command, at the ground [N]
    bool powered = false;         // it has power units; otherwise a torque acts on the wheels
    int gears = 0;                // forward, of the first power unit
    bool has_reverse = false;
    bool has_clutch = false;     // a pedal to press, of the first power unit
    GearboxDescription gearbox;  // of the first power unit
    double idle_speed = 0;       // of the first power unit [rad/s]
};

// One power unit; torques on the rotor.
struct PowerUnitObservation {
    double speed = 0;                       // of the rotor [rad/s]
    double shaft_speed = 0;                 // of the gearbox's input in the present gear [rad/s]
    double wheel_ratio = 0;                 // torque at all wheels together per torque in, in the present gear [1]
    double min_torque = 0, max_torque = 0;  // with the pedal released and pressed, at this speed [N m]
};

struct Observation {
    double time = 0;              // [s]
    double x = 0, y = 0;          // of the chassis's center of mass on the ground [m]
    double yaw = 0, roll = 0;     // [rad]; yaw as an angle within (-pi, pi]
    double speed = 0;             // of that point along the car's heading [m/s]
    double lateral_velocity = 0;  // of that point, to the left [m/s]
    double yaw_rate = 0;          // [rad/s]
    double gear = 0;              // engaged now
    int unit_count = 0;
    std::array<PowerUnitObservation, max_power_units> units{};
};

}  // namespace hamilcar
