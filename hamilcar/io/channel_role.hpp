// What a channel is, apart from its name: a page finds the speed or a wheel's load by its role and by what it belongs to, and shows it
// in the unit that people read. Results carry both, so that names need not be taken apart.
#pragma once

#include <string_view>

namespace hamilcar::io {

enum class ChannelRole {
    none,
    // Of the motor vehicle.
    longitudinal_velocity,
    lateral_velocity,
    longitudinal_acceleration,
    lateral_acceleration,
    yaw_rate,
    roll_angle,
    // Of the driver.
    steering_wheel_angle,
    steering_torque,
    drive_torque,
    brake,
    // Of a controller.
    controller_activity,
    // Of a power unit.
    rotor_speed,
    rotor_torque,
    unit_throttle,
    gear,
    clutch_torque,
    // Of a wheel.
    wheel_travel,
    wheel_spin,
    brake_pressure,
    // Of a tire.
    vertical_force,
    slip_angle,
    longitudinal_slip,
    // Of a tire, for its picture.
    contact_x,
    contact_y,
    contact_z,
    ground_force_x,
    ground_force_y,
    ground_force_z,
    // Of a frame of the scene, for its picture.
    pose_x,
    pose_y,
    pose_z,
    pose_qw,
    pose_qx,
    pose_qy,
    pose_qz,
};
inline constexpr int channel_role_count = 36;

// The role's name in files; "" for none.
std::string_view text(ChannelRole role);
// None for a name that is unknown: the file is of another version.
ChannelRole role_named(std::string_view name);

// Whether it only moves a picture, where single precision will do.
bool is_motion(ChannelRole role);

// The unit that people read, and how many of it one of the channel's own is; "" where that is the channel's own.
struct DisplayUnit {
    std::string_view unit;
    double factor = 1;
};
DisplayUnit display_unit(ChannelRole role);

}  // namespace hamilcar::io
