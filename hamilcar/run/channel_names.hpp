// Names of channels that evaluations read; their units are those of the one list (channels.hpp).
#pragma once

#include <string>

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar::channel {

inline constexpr const char* steering_wheel = "input.steering_wheel";    // [deg]
inline constexpr const char* steering_torque = "input.steering_torque";  // [N m]
inline constexpr const char* gear = "input.gear";
inline constexpr const char* x = "chassis.position.x";                                         // [m]
inline constexpr const char* y = "chassis.position.y";                                         // [m]
inline constexpr const char* roll = "chassis.angle.roll";                                      // [deg]
inline constexpr const char* pitch = "chassis.angle.pitch";                                    // [deg]
inline constexpr const char* heading = "chassis.angle.yaw";                                    // [deg]
inline constexpr const char* speed = "chassis.speed";                                          // [m/s]
inline constexpr const char* lateral_speed = "chassis.lateral_speed";                          // [m/s]
inline constexpr const char* yaw_rate = "chassis.yaw_rate";                                    // [deg/s]
inline constexpr const char* sideslip = "chassis.sideslip";                                    // [deg]
inline constexpr const char* longitudinal_acceleration = "chassis.longitudinal_acceleration";  // [m/s^2]
inline constexpr const char* lateral_acceleration = "chassis.lateral_acceleration";            // [m/s^2]
inline constexpr const char* seat_x = "seat.acceleration.x";                                   // [m/s^2]
inline constexpr const char* seat_y = "seat.acceleration.y";                                   // [m/s^2]
inline constexpr const char* seat_z = "seat.acceleration.z";                                   // [m/s^2]

// Of a wheel, by its name.
inline std::string wheel_load(const std::string& wheel) {
    return wheel + ".wheel.load";  // [N]
}
inline std::string wheel_spin(const std::string& wheel) {
    return wheel + ".wheel.spin";  // [rpm]
}
inline std::string contact_x(const std::string& wheel) {
    return wheel + ".contact.x";  // [m]
}
inline std::string contact_y(const std::string& wheel) {
    return wheel + ".contact.y";  // [m]
}

// Of the first power unit [rpm].
inline std::string rotor_speed(const VehicleDescription& vehicle) {
    return vehicle.power_units.front().name + ".speed";
}

}  // namespace hamilcar::channel
