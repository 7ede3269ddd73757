#include "hamilcar/run/channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"

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
    return velocity_at<double>(s.velocity.hub, center_of_mass(s));
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
                        [i](const Sample& s) { return degree * s.velocity.hub[3 + i]; },
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

void add_car_channels(std::vector<Channel>& list) {
    const auto add = [&](std::string name, std::string unit, std::string what, auto read, bool standard = false) {
        list.push_back({{std::move(name), std::move(unit), std::move(what)}, read, standard});
    };
    add(
        "input.rack", "m", "rack displacement (q17)", [](const Sample& s) { return s.input.rack.displacement; }, true);
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

double camber(const Vec3<double>& axis, bool left) {
    return degree * (left ? -1 : 1) * std::asin(std::clamp(axis[2], -1.0, 1.0));
}

// How to read one wheel, whatever carries it.
struct WheelReader {
    std::string name;
    bool left;
    std::function<const WheelForces<double>&(const Sample&)> forces;
    std::function<Vec3<double>(const Sample&)> axis;  // in the axes of its unit
};

using Read = std::function<double(const Sample&)>;

void add(std::vector<Channel>& list, const std::string& name, const char* unit, const char* what, Read read,
         bool standard = false) {
    list.push_back({{name, unit, what}, std::move(read), standard});
}

void add_tire_channels(std::vector<Channel>& list, const std::string& name, bool standard,
                       const std::function<const TireForces<double>&(const Sample&)>& forces) {
    const auto add_one = [&](const char* what, const char* unit, const char* meaning, auto read, bool usual) {
        add(
            list, name + what, unit, meaning, [forces, read](const Sample& s) { return read(forces(s)); }, usual);
    };
    using F = TireForces<double>;
    add_one(
        ".longitudinal_force", "N", "on the wheel, road axes", [](const F& f) { return f.tire.Fx; }, standard);
    add_one(
        ".lateral_force", "N", "on the wheel, road axes", [](const F& f) { return f.tire.Fy; }, standard);
    add_one(
        ".vertical_force", "N", "on the wheel, road normal", [](const F& f) { return f.tire.Fz; }, standard);
    add_one(
        ".longitudinal_slip_velocity", "m/s", "of the contact", [](const F& f) { return f.contact.v_sx; }, false);
    add_one(
        ".lateral_slip_velocity", "m/s", "of the contact", [](const F& f) { return f.contact.v_sy; }, false);
}

void add_wheel_channels(std::vector<Channel>& list, const WheelReader& wheel) {
    const std::string& name = wheel.name;
    const auto add_force = [&](const char* what, const char* unit, const char* meaning, auto read,
                               bool standard = false) {
        add(
            list, wheel.name + what, unit, meaning,
            [forces = wheel.forces, read](const Sample& s) { return read(forces(s)); }, standard);
    };
    using F = WheelForces<double>;
    add_force(
        ".wheel.travel", "m", "wheel center against design, up positive", [](const F& f) { return f.travel; }, true);
    add(list, name + ".wheel.camber", "deg", "top outboard positive, against the chassis",
        [axis = wheel.axis, left = wheel.left](const Sample& s) { return camber(axis(s), left); });
    add(list, name + ".wheel.steer", "deg", "to the left positive, toe included, against the chassis",
        [axis = wheel.axis](const Sample& s) { return degree * std::atan2(-axis(s)[0], axis(s)[1]); });
    add_force(
        ".wheel.spin", "rad/s", "against the carrier", [](const F& f) { return f.spin; }, true);
    add_force(".stop.force", "N", "on the wheel, up positive", [](const F& f) { return f.stop; });
    add_force(".anti_roll_bar.force", "N", "on the wheel, up positive", [](const F& f) { return f.bar; });
    add_force(".drive.torque", "N m", "on the wheel", [](const F& f) { return f.drive_torque; });
    add_force(".brake.torque", "N m", "on the wheel", [](const F& f) { return f.brake_torque; });
}

void add_corner_channels(std::vector<Channel>& list, const CornerDescription& corner, std::size_t i) {
    using Forces = SpokeForces<double>;
    const auto forces = [i](const Sample& s) -> const Forces& { return s.momenta.spokes[i].forces; };
    const auto axis = [i](const Sample& s) {
        return visit_spoke(s.model.vehicle, s.velocity, static_cast<int>(i),
                           [](const auto&, const auto&, const auto& at) { return at.spin_axis; });
    };
    add_wheel_channels(list, {corner.name, corner.wheel.center[1] >= 0, forces, axis});
    add_tire_channels(list, corner.name + ".tire", true, forces);
    const auto add_force = [&](const char* what, const char* unit, const char* meaning, auto read) {
        add(list, corner.name + what, unit, meaning, [forces, read](const Sample& s) { return read(forces(s)); });
    };
    add_force(".spring.length", "m", "spring or strut", [](const Forces& f) { return f.spring_length; });
    add_force(".spring.force", "N", "compression positive", [](const Forces& f) { return f.spring; });
    add_force(".damper.force", "N", "compression positive", [](const Forces& f) { return f.damper; });
    add_force(".damper.velocity", "m/s", "extension positive", [](const Forces& f) { return f.damper_rate; });
    add(list, corner.name + ".independent", corner.suspension.index() == 0 ? "m" : "rad",
        "independent coordinate of the suspension",
        [i](const Sample& s) { return s.state.spoke(static_cast<int>(i)).independent[0]; });
}

void add_composed_wheel_channels(std::vector<Channel>& list, const ComposedWheelDescription& wheel, std::size_t spoke,
                                 std::size_t i) {
    using Forces = ComposedWheelForces<double>;
    const auto forces = [spoke, i](const Sample& s) -> const Forces& {
        return s.momenta.composed.spokes[spoke].wheels[i];
    };
    const auto axis = [spoke, i](const Sample& s) { return s.velocity.composed.spokes[spoke].axis[i]; };
    add_wheel_channels(list, {wheel.name, wheel.wheel.center[1] >= 0, forces, axis});
    const auto tire = [forces](std::size_t k) {
        return [forces, k](const Sample& s) -> const TireForces<double>& { return forces(s).tires[k]; };
    };
    if (wheel.dual_spacing > 0) {
        add_tire_channels(list, wheel.name + ".left_tire", true, tire(0));
        add_tire_channels(list, wheel.name + ".right_tire", true, tire(1));
    } else {
        add_tire_channels(list, wheel.name + ".tire", true, tire(0));
    }
}

void add_composed_channels(std::vector<Channel>& list, const ComposedSpokeDescription& spoke, std::size_t at) {
    for (std::size_t i = 0; i < spoke.wheels.size(); ++i) add_composed_wheel_channels(list, spoke.wheels[i], at, i);
    for (std::size_t i = 0; i < spoke.springs.size(); ++i) {
        const std::string& name = spoke.springs[i].name;
        const auto spring = [at, i](const Sample& s) { return s.momenta.composed.spokes[at].springs[i]; };
        const bool turns = spoke.springs[i].line.coordinate.has_value();
        add(list, name + ".spring.length", turns ? "rad" : "m", "of the spring",
            [spring](const Sample& s) { return spring(s).length; });
        add(list, name + ".spring.force", turns ? "N m" : "N", "compression positive",
            [spring](const Sample& s) { return spring(s).force; });
    }
    for (std::size_t i = 0; i < spoke.dampers.size(); ++i) {
        const std::string& name = spoke.dampers[i].name;
        const auto damper = [at, i](const Sample& s) { return s.momenta.composed.spokes[at].dampers[i]; };
        add(list, name + ".damper.force", "N", "compression positive",
            [damper](const Sample& s) { return damper(s).force; });
        add(list, name + ".damper.velocity", "m/s", "extension positive",
            [damper](const Sample& s) { return damper(s).rate; });
    }
    for (int j = 0; j < spoke.linkage.coordinate_count() - spoke.linkage.equation_count(); ++j) {
        add(list, fmt::format("{}.independent.{}", spoke.name, j + 1), "1", "independent coordinate [m or rad]",
            [at, j](const Sample& s) {
                return s.model.vehicle.composed[at].state(s.state.values.data()).independent[j];
            });
    }
}

void add_trailer_channels(std::vector<Channel>& list, const TrailerDescription& trailer, std::size_t i) {
    const auto angle = [i](int k) {
        return [i, k](const Sample& s) {
            return degree * s.state.values[static_cast<std::size_t>(s.model.vehicle.trailers[i].offset + k)];
        };
    };
    const std::vector<std::string> angles = hitch_angles(trailer.hitch);
    for (std::size_t k = 0; k < angles.size(); ++k) {
        add(list, trailer.name + ".hitch." + angles[k], "deg", "of the trailer against what pulls it, ISO 8855 sense",
            angle(static_cast<int>(k)), angles[k] == "yaw");
    }
    const char* axes[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        add(
            list, fmt::format("{}.position.{}", trailer.name, axes[axis]), "m",
            "center of mass of the trailer's chassis, ground axes",
            [i, axis](const Sample& s) {
                std::vector<UnitPlace<double>> places{{s.state.position(), s.velocity.R_GC}};
                for (std::size_t k = 0; k <= i; ++k) {
                    places.push_back(behind(places[static_cast<std::size_t>(s.model.vehicle.trailers[k].tow)],
                                            s.velocity.composed.trailers[k].pose));
                }
                const Vec3<double>& center = s.model.vehicle.trailers[i].chassis.center;
                return (places.back().position + places.back().R * center)[axis];
            },
            axis < 2);
    }
}

bool matches(const std::string& name, const std::string& pattern) {
    if (!pattern.empty() && pattern.back() == '*') return name.starts_with(pattern.substr(0, pattern.size() - 1));
    return name == pattern;
}

}  // namespace

std::vector<Channel> all_channels(const VehicleDescription& vehicle) {
    std::vector<Channel> list;
    add_chassis_channels(list);
    add_car_channels(list);
    for (std::size_t i = 0; i < vehicle.corners.size(); ++i) add_corner_channels(list, vehicle.corners[i], i);
    for (std::size_t i = 0; i < vehicle.composed.size(); ++i) add_composed_channels(list, vehicle.composed[i], i);
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) add_trailer_channels(list, vehicle.trailers[i], i);
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
            const auto same = [&](const Channel& other) { return other.column.name == channel.column.name; };
            if (std::none_of(chosen.begin(), chosen.end(), same)) chosen.push_back(channel);
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

}  // namespace hamilcar
