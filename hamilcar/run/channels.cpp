#include "hamilcar/run/channels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hamilcar/analysis/rack_force.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/run/channel_names.hpp"
#include "hamilcar/run/control_channels.hpp"
#include "hamilcar/run/handling_channels.hpp"
#include "hamilcar/run/joint_channels.hpp"
#include "hamilcar/run/motion_channels.hpp"
#include "hamilcar/run/powertrain_channels.hpp"
#include "hamilcar/run/steering_channels.hpp"
#include "hamilcar/run/suspension_channels.hpp"
#include "hamilcar/scalar/elementary.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

using io::ChannelRole;
using units::degree;

template <class AnySample>
const Vec3<typename AnySample::Number>& center_of_mass(const AnySample& s) {
    return s.model.vehicle.chassis.center;
}

// Position of the chassis's center of mass on the ground, the paper's r_1 = (q11, q12, q13).
template <class AnySample>
Vec3<typename AnySample::Number> chassis_position(const AnySample& s) {
    using T = typename AnySample::Number;
    return Vec3<T>(s.state.position()) + s.velocity.R_GC * center_of_mass(s);
}
template <class AnySample>
Vec3<typename AnySample::Number> chassis_velocity(const AnySample& s) {
    return velocity_at<typename AnySample::Number>(s.velocity.chassis, center_of_mass(s));
}

double rack_force_in(const Sample& s) {
    if (!s.rack_force) s.rack_force = rack_force(s.model, s.state, s.input, s.velocity, s.momenta);
    return *s.rack_force;
}

// Of a free steering as it turns, else as the rack is prescribed [rad].
double steering_wheel_angle(const Column& column, const Sample& s) {
    const SteeringSystem<double>& steering = s.model.vehicle.steering;
    return steering.exists() ? steering.state(s.state.values.data()).wheel : column.angle(s.input.rack.displacement);
}

double hands_torque(const Column& column, const Sample& s) {
    if (s.model.vehicle.steering.exists()) return s.momenta.steering.hands_torque;
    return steering_torque(column, s.input.rack.displacement, rack_force_in(s));
}

// ISO 8855 angles: yaw about z, pitch about y', roll about x''.
template <class T>
T roll_pitch_yaw(const Mat3<T>& R, int i) {
    return i == 0 ? angle_of<T>(R(2, 1), R(2, 2)) : i == 1 ? T(-arcsine<T>(R(2, 0))) : angle_of<T>(R(1, 0), R(0, 0));
}

void add_chassis_channels(std::vector<Channel>& list) {
    const char* axes[] = {"x", "y", "z"};
    const char* angles[] = {"roll", "pitch", "yaw"};
    for (int i = 0; i < 3; ++i) {
        list.push_back(
            {{fmt::format("chassis.position.{}", axes[i]), "m", "center of mass of the chassis, ground axes"},
             [i](const auto& s) { return chassis_position(s)[i]; },
             true});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back(
            {{fmt::format("chassis.velocity.{}", axes[i]), "m/s", "of that point, ground axes"},
             [i](const auto& s) { return Vec3<NumberOf<decltype(s)>>(s.velocity.R_GC * chassis_velocity(s))[i]; },
             true});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.angle.{}", angles[i]), "deg", "ISO 8855 angle (yaw, pitch, roll)",
                         i == 0 ? ChannelRole::roll_angle : ChannelRole::none},
                        [i](const auto& s) { return roll_pitch_yaw(s.velocity.R_GC, i) / degree; },
                        true});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.rate.{}", angles[i]), "deg/s", "angular velocity, vehicle axes",
                         i == 2 ? ChannelRole::yaw_rate : ChannelRole::none},
                        [i](const auto& s) { return s.velocity.chassis[3 + i] / degree; },
                        i == 2});
    }
    const char* names[] = {"longitudinal", "lateral", "vertical"};
    constexpr ChannelRole velocities[] = {ChannelRole::longitudinal_velocity, ChannelRole::lateral_velocity,
                                          ChannelRole::none};
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.{}_velocity", names[i]), "m/s", "of the center of mass, vehicle axes",
                         velocities[i]},
                        [i](const auto& s) { return chassis_velocity(s)[i]; },
                        i < 2});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.bryant.{}", i + 1), "deg", fmt::format("the paper's q1{} (1)", i + 4)},
                        [i](const Sample& s) { return bryant_angles<double>(s.velocity.R_GC)[i] / degree; }});
    }
}

void add_car_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    const auto add = [&](std::string name, std::string unit, std::string what, auto read, bool standard = false,
                         ChannelRole role = ChannelRole::none) {
        list.push_back({{std::move(name), std::move(unit), std::move(what), role}, read, standard});
    };
    add(
        "input.rack", "m", "rack displacement (q17)", [](const auto& s) { return s.input.rack.displacement; }, true);
    if (const Column column(vehicle.steering); column.exists()) {
        // Not compiled: the ratio is no number of the model, so cars of a batch may differ in it unseen.
        add(
            channel::steering_wheel, "deg", "of the steering wheel, to the left positive",
            [column](const Sample& s) { return steering_wheel_angle(column, s) / degree; }, true,
            ChannelRole::steering_wheel_angle);
        add("input.rack_force", "N", "that moves or holds the tie rods, in the sense of input.rack", rack_force_in);
        add(
            channel::steering_torque, "N m",
            "that the driver applies, to the left positive; without power assist where the rack is prescribed",
            [column](const Sample& s) { return hands_torque(column, s); }, false, ChannelRole::steering_torque);
    }
    add(
        "input.drive_torque", "N m", "at the driven wheels together",
        [](const auto& s) { return s.input.drive_torque; }, true, ChannelRole::drive_torque);
    add(
        "input.brake", "1", "brake command", [](const auto& s) { return s.input.brake; }, true, ChannelRole::brake);
    if (has_parking_brake(vehicle)) {
        add("input.parking_brake", "1", "lever of the parking brake",
            [](const auto& s) { return s.input.parking_brake; });
    }
    add(
        "constraints.opening", "m", "largest opening of a cut joint", [](const Sample& s) { return s.violation; },
        true);
    add(
        "constraints.norm", "1", "norm of Phi, the paper's Fig. 9", [](const Sample& s) { return s.constraint_norm; },
        true);
    add("constraints.mobility", "1", "0 where a linkage locks", [](const Sample& s) { return s.mobility; });
    add("energy.kinetic", "J", "of all bodies and wheels", [](const Sample& s) { return s.energy.kinetic; });
    add("energy.potential", "J", "gravity, springs, bars, stops, tires, hull",
        [](const Sample& s) { return s.energy.potential; });
    add("energy.prescribed", "J", "of the prescribed motion of the rack: the sum of x.h",
        [](const Sample& s) { return s.energy.prescribed; });
    add("energy.work", "J", "of drive, brakes, dampers, tires, air, hull friction and rack",
        [](const Sample& s) { return s.energy.work; });
    add("energy.balance", "J", "kinetic + potential - prescribed - work: constant",
        [](const Sample& s) { return s.energy.balance(); });
}

bool matches(const std::string& name, const std::string& pattern) {
    if (!pattern.empty() && pattern.back() == '*') return name.starts_with(pattern.substr(0, pattern.size() - 1));
    return name == pattern;
}

bool contains(const std::vector<Channel>& list, const Channel& channel) {
    return std::ranges::any_of(list, [&](const Channel& one) { return one.column.name == channel.column.name; });
}

}  // namespace

std::vector<Channel> all_channels(const VehicleDescription& vehicle) {
    std::vector<Channel> list;
    add_chassis_channels(list);
    add_handling_channels(vehicle, list);
    add_car_channels(vehicle, list);
    add_powertrain_channels(vehicle, list);
    add_control_channels(vehicle, list);
    add_steering_channels(vehicle, list);
    add_suspension_channels(vehicle, list);
    add_joint_channels(vehicle, list);
    add_motion_channels(vehicle, list);
    return list;
}

std::vector<Channel> select_channels(const std::vector<Channel>& all, const std::vector<std::string>& names,
                                     const std::shared_ptr<const Places>& places) {
    std::vector<Channel> chosen;
    if (names.empty()) {
        for (const Channel& channel : all) {
            if (channel.standard) chosen.push_back(channel);
        }
        return chosen;
    }
    for (const std::string& name : names) {
        bool found = false;
        for (const Channel& channel : all) {
            if (!matches(channel.column.name, name)) continue;
            found = true;
            if (!contains(chosen, channel)) chosen.push_back(channel);
        }
        if (found) continue;
        std::vector<std::string_view> known;
        for (const Channel& channel : all) known.push_back(channel.column.name);
        const auto nearest = io::nearest_word(name, known);
        throw io::Error(io::ExitCode::bad_file,
                        fmt::format("{}unknown channel \"{}\"{}; 'hamilcar channels' lists all",
                                    places ? at_key(places, "output.channels") + "key 'output.channels': " : "", name,
                                    nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : ""),
                        "output.channels");
    }
    return chosen;
}

void add_missing(const std::vector<Channel>& further, std::vector<Channel>& chosen) {
    for (const Channel& channel : further) {
        if (!contains(chosen, channel)) chosen.push_back(channel);
    }
}

void add_missing_motion(const std::vector<Channel>& all, std::vector<Channel>& chosen) {
    for (const Channel& channel : all) {
        if (is_motion(channel.column.role) && !contains(chosen, channel)) chosen.push_back(channel);
    }
}

}  // namespace hamilcar
