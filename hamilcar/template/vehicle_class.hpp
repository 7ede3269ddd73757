// What vehicles of a class have in common, from which a new one starts: `hamilcar new`. All of it is estimated, as a handbook
// would: no particular car.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace hamilcar {

enum class DrivenWheels { front, rear, all };
inline constexpr std::array<std::string_view, 3> drive_words{"front", "rear", "all"};

// SI.
struct ClassValues {
    double mass;           // with the driver
    double front_load;     // share of the weight on the front axle
    double center_height;  // of the center of mass
    double wheelbase, front_track, rear_track;
    double length, width, height;
    double tire_radius;            // unloaded
    double front_ride, rear_ride;  // frequency of the body on its springs [Hz]
    double roll_gradient;          // [rad/(m/s^2)]
    double steering_ratio;         // steering wheel over road wheels
    double lock_angle;             // of the inner wheel
    double max_torque;             // of the engine
    double max_speed;              // where it is limited [rad/s]
    double final_drive;
    double drag_coefficient;
    double tire_friction;  // over that of the passenger car tire, 1.03 to the side under its load
};

struct VehicleClass {
    std::string_view name, title, body_style, front, rear;  // suspensions by their words
    DrivenWheels drive;
    std::vector<double> gears;
    ClassValues values;
};
std::span<const VehicleClass> vehicle_classes();

// A value that may be chosen, with its unit in the key.
struct ClassSetting {
    std::string_view key, meaning;
    double ClassValues::*value;
    double to_si, min, max;  // the bounds as typed
};
std::span<const ClassSetting> class_settings();

}  // namespace hamilcar
