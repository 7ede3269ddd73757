#include "hamilcar/run/channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "hamilcar/analysis/rack_force.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/run/motion_channels.hpp"
#include "hamilcar/run/powertrain_channels.hpp"
#include "hamilcar/run/suspension_channels.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

constexpr double degree = 180 / std::numbers::pi;

Vec3<double> center_of_mass(const Sample& s) {
    return s.model.vehicle.chassis.center;
}

// Position of the chassis's center of mass on the ground, the paper's r_1 = (q11, q12, q13).
Vec3<double> chassis_position(const Sample& s) {
    return Vec3<double>(s.state.position()) + s.velocity.R_GC * center_of_mass(s);
}
Vec3<double> chassis_velocity(const Sample& s) {
    return velocity_at<double>(s.velocity.chassis, center_of_mass(s));
}

// ISO 8855 angles: yaw about z, pitch about y', roll about x''.
Vec3<double> roll_pitch_yaw(const Mat3<double>& R) {
    return {std::atan2(R(2, 1), R(2, 2)), -std::asin(std::clamp(R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0))};
}

Vec3<double> acceleration(const Sample& s) {
    Vec3<double> up = s.velocity.R_GC.row(2).transpose();
    const Vec3<double> total = s.momenta.external.head<3>() / s.model.vehicle.total_mass;
    return total - up * up.dot(total);
}

void add_chassis_channels(std::vector<Channel>& list) {
    const char* axes[] = {"x", "y", "z"};
    const char* angles[] = {"roll", "pitch", "yaw"};
    for (int i = 0; i < 3; ++i) {
        list.push_back(
            {{fmt::format("chassis.position.{}", axes[i]), "m", "center of mass of the chassis, ground axes"},
             [i](const Sample& s) { return chassis_position(s)[i]; },
             true});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.velocity.{}", axes[i]), "m/s", "of that point, ground axes"},
                        [i](const Sample& s) { return (s.velocity.R_GC * chassis_velocity(s))[i]; },
                        true});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.angle.{}", angles[i]), "deg", "ISO 8855 angle (yaw, pitch, roll)"},
                        [i](const Sample& s) { return degree * roll_pitch_yaw(s.velocity.R_GC)[i]; },
                        true});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.rate.{}", angles[i]), "deg/s", "angular velocity, vehicle axes"},
                        [i](const Sample& s) { return degree * s.velocity.chassis[3 + i]; },
                        i == 2});
    }
    const char* names[] = {"longitudinal", "lateral", "vertical"};
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.{}_velocity", names[i]), "m/s", "of the center of mass, vehicle axes"},
                        [i](const Sample& s) { return chassis_velocity(s)[i]; },
                        i < 2});
    }
    for (int i = 0; i < 2; ++i) {
        list.push_back({{fmt::format("chassis.{}_acceleration", names[i]), "m/s^2",
                         "horizontal acceleration of the whole car's center of mass, vehicle axes"},
                        [i](const Sample& s) { return acceleration(s)[i]; },
                        true});
    }
    for (int i = 0; i < 3; ++i) {
        list.push_back({{fmt::format("chassis.bryant.{}", i + 1), "deg", fmt::format("the paper's q1{} (1)", i + 4)},
                        [i](const Sample& s) { return degree * bryant_angles<double>(s.velocity.R_GC)[i]; }});
    }
}

void add_car_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    const auto add = [&](std::string name, std::string unit, std::string what, auto read, bool standard = false) {
        list.push_back({{std::move(name), std::move(unit), std::move(what)}, read, standard});
    };
    add(
        "input.rack", "m", "rack displacement (q17)", [](const Sample& s) { return s.input.rack.displacement; }, true);
    if (const Column column(vehicle.steering); column.exists()) {
        add(
            "input.steering_wheel", "deg", "of the steering wheel, to the left positive",
            [column](const Sample& s) { return degree * column.angle(s.input.rack.displacement); }, true);
        add("input.steering_torque", "N m", "that the driver applies, without power assist; to the left positive",
            [column](const Sample& s) {
                return steering_torque(column, s.input.rack.displacement,
                                       rack_force(s.model, s.state, s.input, s.velocity, s.momenta));
            });
    }
    add(
        "input.drive_torque", "N m", "at the driven wheels together",
        [](const Sample& s) { return s.input.drive_torque; }, true);
    add(
        "input.brake", "1", "brake command", [](const Sample& s) { return s.input.brake; }, true);
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
    add("energy.drift", "J", "carried by the moving rack: the sum of x.h",
        [](const Sample& s) { return s.energy.drift; });
    add("energy.work", "J", "of drive, brakes, dampers, tires, air, hull friction and rack",
        [](const Sample& s) { return s.energy.work; });
    add("energy.balance", "J", "kinetic + potential - drift - work: constant",
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
    add_car_channels(vehicle, list);
    add_powertrain_channels(vehicle, list);
    add_suspension_channels(vehicle, list);
    add_motion_channels(vehicle, list);
    return list;
}

std::vector<Channel> select_channels(const std::vector<Channel>& all, const std::vector<std::string>& names) {
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
        throw io::Error(
            io::ExitCode::bad_file,
            fmt::format("key 'output.channels': unknown channel \"{}\"{}; 'hamilcar check --json' lists all channels",
                        name, nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : ""),
            "output.channels");
    }
    return chosen;
}

void add_missing_motion(const std::vector<Channel>& all, std::vector<Channel>& chosen) {
    for (const Channel& channel : all) {
        if (channel.motion && !contains(chosen, channel)) chosen.push_back(channel);
    }
}

}  // namespace hamilcar
