#include "hamilcar/io/channel_role.hpp"

#include <array>
#include <cstddef>

namespace hamilcar::io {

namespace {

// In the order of the enumeration.
constexpr std::array<std::string_view, channel_role_count> names{"",
                                                                 "longitudinal_velocity",
                                                                 "lateral_velocity",
                                                                 "longitudinal_acceleration",
                                                                 "lateral_acceleration",
                                                                 "yaw_rate",
                                                                 "roll_angle",
                                                                 "steering_wheel_angle",
                                                                 "steering_torque",
                                                                 "drive_torque",
                                                                 "brake",
                                                                 "controller_activity",
                                                                 "rotor_speed",
                                                                 "rotor_torque",
                                                                 "unit_throttle",
                                                                 "gear",
                                                                 "clutch_torque",
                                                                 "wheel_travel",
                                                                 "wheel_spin",
                                                                 "brake_pressure",
                                                                 "vertical_force",
                                                                 "slip_angle",
                                                                 "longitudinal_slip",
                                                                 "contact_x",
                                                                 "contact_y",
                                                                 "contact_z",
                                                                 "ground_force_x",
                                                                 "ground_force_y",
                                                                 "ground_force_z",
                                                                 "pose_x",
                                                                 "pose_y",
                                                                 "pose_z",
                                                                 "pose_qw",
                                                                 "pose_qx",
                                                                 "pose_qy",
                                                                 "pose_qz"};

}  // namespace

std::string_view text(ChannelRole role) {
    return names[static_cast<std::size_t>(role)];
}

ChannelRole role_named(std::string_view name) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == name) return static_cast<ChannelRole>(i);
    }
    return ChannelRole::none;
}

bool is_motion(ChannelRole role) {
    return role >= ChannelRole::contact_x;
}

DisplayUnit display_unit(ChannelRole role) {
    switch (role) {
        case ChannelRole::longitudinal_velocity: return {"km/h", 3.6};
        case ChannelRole::brake:
        case ChannelRole::controller_activity:
        case ChannelRole::unit_throttle:
        case ChannelRole::longitudinal_slip: return {"%", 100};
        case ChannelRole::wheel_travel: return {"mm", 1000};
        case ChannelRole::vertical_force: return {"kN", 1e-3};
        default: return {};
    }
}

}  // namespace hamilcar::io
