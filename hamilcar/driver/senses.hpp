// What a driver perceives of the car, and what he knows of it: all that closed-loop drivers may decide by.
#pragma once

#include <array>

#include "hamilcar/description/powertrain.hpp"

namespace hamilcar {

// Constants of the car, read off it once it stands.
struct DrivenCar {
    double mass = 0;              // of everything [kg]
    double wheelbase = 1;         // from the mean steered to the mean other axle of the motor vehicle [m]
    double center_behind = 0;     // of the center of mass behind the steered axle [m]
    double lock = 0;              // of the steering wheel, each way; 0: nothing to steer [rad]
    double wheels_per_angle = 0;  // turn of the steered wheels per turn of the steering wheel, near straight ahead [1]
    double wheel_radius = 0;      // of the driven wheels; 0: there are none [m]
    double full_brake_force = 0;  // of all brakes at full command, at the ground [N]
    bool powered = false;         // it has power units; otherwise a torque at the wheels stands for them
    int gears = 0;                // forward, of the first power unit
    bool has_reverse = false;
    bool has_clutch = false;     // a pedal to press, of the first power unit
    GearboxDescription gearbox;  // of the first power unit
    double idle_speed = 0;       // of the first power unit [rad/s]
};

// One power unit now; torques about the rotor.
struct UnitSense {
    double speed = 0;                          // of the rotor [rad/s]
    double shaft_speed = 0;                    // of the gearbox's input in the present gear [rad/s]
    double wheel_ratio = 0;                    // torque at all wheels together per torque in, in the present gear [1]
    double least_torque = 0, most_torque = 0;  // with the pedal released and pressed, at this speed [N m]
};

struct Senses {
    double time = 0;              // [s]
    double x = 0, y = 0;          // of the chassis's center of mass on the ground [m]
    double yaw = 0, roll = 0;     // [rad]; yaw as an angle within (-pi, pi]
    double speed = 0;             // of that point along the car's heading [m/s]
    double lateral_velocity = 0;  // of that point, to the left [m/s]
    double yaw_rate = 0;          // [rad/s]
    double gear = 0;              // that is in
    int unit_count = 0;
    std::array<UnitSense, max_power_units> units{};
};

}  // namespace hamilcar
