#include "hamilcar/run/suspension_channels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hamilcar/base/units.hpp"
#include "hamilcar/run/channel_names.hpp"
#include "hamilcar/run/unit_pose_of.hpp"
#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

using io::ChannelRole;
using units::degree;
using units::rpm;

template <class T>
T in_degrees(const T& angle) {
    return angle / degree;
}
// Of a wheel's axis, to the left positive [deg].
template <class T>
T heading(const Vec3<T>& axis) {
    return angle_of<T>(-axis[0], axis[1]) / degree;
}
// Of a contact that moves at `v_x` [m/s].
template <class T>
T longitudinal_slip(const T& v_sx, const T& v_x) {
    return clamp(T(-v_sx / max(T(abs(v_x)), T(1e-3))), T(-2), T(2));
}
template <class T>
T slip_angle(const T& v_sy, const T& v_x) {
    return arctangent<T>(v_sy, max(T(abs(v_x)), T(1e-3))) / degree;
}

template <class T>
T camber(const Vec3<T>& axis, bool left) {
    return T(left ? -1 : 1) * arcsine<T>(axis[2]) / degree;
}

// How to read one wheel, whatever carries it: its forces, and its axis in the axes of its unit, of any sample.
template <class Forces, class Axis>
struct WheelReader {
    std::string name;
    bool left, bar_has_arms;
    Forces forces;
    Axis axis;
};
template <class Forces, class Axis>
WheelReader(std::string, bool, bool, Forces, Axis) -> WheelReader<Forces, Axis>;

template <class Read>
void add(std::vector<Channel>& list, const std::string& name, const char* unit, const char* what, Read read,
         bool standard = false) {
    list.push_back({{name, unit, what}, std::move(read), standard});
}

// The channel added last is what its role says of that wheel or tire.
void give_role(std::vector<Channel>& list, ChannelRole role, const std::string& of) {
    list.back().column.role = role;
    list.back().column.of = of;
}

template <class Forces>
void add_tire_channels(std::vector<Channel>& list, const std::string& name, bool standard, const Forces& forces) {
    const auto add_one = [&](const char* what, const char* unit, const char* meaning, auto read, bool is_standard) {
        add(
            list, name + what, unit, meaning, [forces, read](const auto& s) { return read(forces(s)); }, is_standard);
    };
    add_one(
        ".longitudinal_force", "N", "on the wheel, road axes", [](const auto& f) { return f.tire.Fx; }, standard);
    add_one(
        ".lateral_force", "N", "on the wheel, road axes", [](const auto& f) { return f.tire.Fy; }, standard);
    add_one(
        ".vertical_force", "N", "on the wheel, road normal", [](const auto& f) { return f.tire.Fz; }, standard);
    give_role(list, ChannelRole::vertical_force, name);
    add_one(
        ".longitudinal_slip_velocity", "m/s", "of the contact", [](const auto& f) { return f.contact.v_sx; }, false);
    add_one(
        ".lateral_slip_velocity", "m/s", "of the contact", [](const auto& f) { return f.contact.v_sy; }, false);
    add_one(
        ".aligning_moment", "N m", "on the wheel, about the road's normal", [](const auto& f) { return f.tire.Mz; },
        false);
    add_one(
        ".overturning_moment", "N m", "on the wheel, about its heading", [](const auto& f) { return f.tire.Mx; },
        false);
    add_one(
        ".longitudinal_slip", "1", "drive positive, held within -2 and 2",
        [](const auto& f) { return longitudinal_slip(f.contact.v_sx, f.contact.v_x); }, false);
    give_role(list, ChannelRole::longitudinal_slip, name);
    add_one(
        ".slip_angle", "deg", "positive where the wheel moves to its left",
        [](const auto& f) { return slip_angle(f.contact.v_sy, f.contact.v_x); }, false);
    give_role(list, ChannelRole::slip_angle, name);
    add_one(
        ".friction_power", "W", "that sliding turns to heat and wear",
        [](const auto& f) { return -(f.tire.Fx * f.contact.v_sx + f.tire.Fy * f.contact.v_sy); }, false);
    add_one(
        ".inclination", "deg", "of the wheel against the road, top to the right positive",
        [](const auto& f) { return in_degrees(arcsine(f.contact.camber)); }, false);
    add_one(
        ".friction", "1", "the road's factor under the wheel", [](const auto& f) { return f.contact.friction; }, false);
}

template <class Forces, class Axis>
void add_wheel_channels(std::vector<Channel>& list, const WheelReader<Forces, Axis>& wheel) {
    const std::string& name = wheel.name;
    const auto add_force = [&](const char* what, const char* unit, const char* meaning, auto read,
                               bool standard = false) {
        add(
            list, wheel.name + what, unit, meaning,
            [forces = wheel.forces, read](const auto& s) { return read(forces(s)); }, standard);
    };
    add_force(
        ".wheel.travel", "m", "wheel center against design, up positive", [](const auto& f) { return f.travel; }, true);
    give_role(list, ChannelRole::wheel_travel, name);
    add(list, name + ".wheel.camber", "deg", "top outboard positive, against the chassis",
        [axis = wheel.axis, left = wheel.left](const auto& s) { return camber(axis(s), left); });
    add(list, name + ".wheel.steer", "deg", "to the left positive, toe included, against the chassis",
        [axis = wheel.axis](const auto& s) { return heading(axis(s)); });
    add(list, name + ".wheel.toe", "deg", "toe-in positive, against the chassis",
        [axis = wheel.axis, left = wheel.left](const auto& s) { return (left ? -1.0 : 1.0) * heading(axis(s)); });
    add_force(
        ".wheel.spin", "rpm", "against the carrier", [](const auto& f) { return f.spin / rpm; }, true);
    give_role(list, ChannelRole::wheel_spin, name);
    add_force(".stop.force", "N", "on the wheel, up positive", [](const auto& f) { return f.stop; });
    const auto bar = [](const auto& f) { return f.bar; };
    if (wheel.bar_has_arms) {
        add_force(".anti_roll_bar.moment", "N m", "on its arm, nose down positive", bar);
    } else {
        add_force(".anti_roll_bar.force", "N", "on the wheel, up positive", bar);
    }
    add_force(".drive.torque", "N m", "on the wheel", [](const auto& f) { return f.drive_torque; });
    add_force(".brake.torque", "N m", "on the wheel", [](const auto& f) { return f.brake_torque; });
    add_force(".brake.power", "W", "that the brake turns to heat, less what its wind-up holds back",
              [](const auto& f) { return -f.brake_torque * f.spin; });
}

// The load of all tires of a wheel, and where its outer one stands on the ground, the one away from its unit's middle.
void add_ground_channels(std::vector<Channel>& list, const SuspensionWheelDescription& wheel, std::size_t suspension,
                         std::size_t i) {
    const auto forces = [ suspension, i ](const auto& s) -> const auto& {
        return s.momenta.suspensions[suspension].wheels[i];
    };
    const std::size_t last = wheel.dual_spacing > 0 ? 1 : 0, outer = wheel.wheel.center[1] < 0 ? last : 0;
    add(list, channel::wheel_load(wheel.name), "N", "of all its tires, on the wheel, road normal",
        [forces, last](const auto& s) {
            NumberOf<decltype(s)> load = forces(s).tires[0].tire.Fz;
            if (last > 0) load += forces(s).tires[last].tire.Fz;
            return load;
        });
    const auto contact = [forces, outer, suspension](const auto& s) -> Vec3<NumberOf<decltype(s)>> {
        const auto place = unit_pose_of(s, static_cast<std::size_t>(s.model.vehicle.suspensions[suspension].unit));
        return place.position + place.R * forces(s).tires[outer].frame.point;
    };
    add(list, channel::contact_x(wheel.name), "m", "of the outer tire with the ground, ground axes",
        [contact](const auto& s) { return contact(s)[0]; });
    add(list, channel::contact_y(wheel.name), "m", "of the outer tire with the ground, ground axes",
        [contact](const auto& s) { return contact(s)[1]; });
}

void add_channels_of_wheel(std::vector<Channel>& list, const SuspensionWheelDescription& wheel, std::size_t suspension,
                           std::size_t i) {
    const auto forces = [ suspension, i ](const auto& s) -> const auto& {
        return s.momenta.suspensions[suspension].wheels[i];
    };
    const auto axis = [suspension, i](const auto& s) { return s.velocity.suspensions[suspension].axis[i]; };
    add_wheel_channels(list,
                       WheelReader{wheel.name, wheel.wheel.center[1] >= 0, wheel.bar_arm.has_value(), forces, axis});
    add_ground_channels(list, wheel, suspension, i);
    const auto tire = [forces](std::size_t k) {
        return [ forces, k ](const auto& s) -> const auto& {
            return forces(s).tires[k];
        };
    };
    if (wheel.dual_spacing > 0) {
        add_tire_channels(list, wheel.name + ".left_tire", true, tire(0));
        add_tire_channels(list, wheel.name + ".right_tire", true, tire(1));
    } else {
        add_tire_channels(list, wheel.name + ".tire", true, tire(0));
    }
}

void add_channels_of(std::vector<Channel>& list, const SuspensionDescription& suspension, std::size_t at) {
    for (std::size_t i = 0; i < suspension.wheels.size(); ++i) add_channels_of_wheel(list, suspension.wheels[i], at, i);
    for (std::size_t i = 0; i < suspension.springs.size(); ++i) {
        const std::string& name = suspension.springs[i].name;
        const auto spring = [at, i](const auto& s) { return s.momenta.suspensions[at].springs[i]; };
        const std::optional<int> along = suspension.springs[i].line.coordinate;
        const bool turns = along && suspension.linkage.turns(*along);
        const double unit = turns ? degree : 1;
        add(list, name + ".spring.length", turns ? "deg" : "m", "of the spring",
            [spring, unit](const auto& s) { return spring(s).length / unit; });
        add(list, name + ".spring.force", turns ? "N m" : "N", "compression positive",
            [spring](const auto& s) { return spring(s).force; });
    }
    for (std::size_t i = 0; i < suspension.dampers.size(); ++i) {
        const std::string& name = suspension.dampers[i].name;
        const auto damper = [at, i](const auto& s) { return s.momenta.suspensions[at].dampers[i]; };
        const std::optional<int> along = suspension.dampers[i].line.coordinate;
        const bool turns = along && suspension.linkage.turns(*along);
        add(list, name + ".damper.force", turns ? "N m" : "N", "compression positive",
            [damper](const auto& s) { return damper(s).force; });
        const double unit = turns ? degree : 1;
        add(list, name + ".damper.velocity", turns ? "deg/s" : "m/s", "extension positive",
            [damper, unit](const auto& s) { return damper(s).rate / unit; });
        add(list, name + ".damper.power", "W", "that the damper turns to heat",
            [damper](const auto& s) { return -damper(s).force * damper(s).rate; });
    }
    const std::vector<int> independent = compose(suspension.linkage).independent;
    for (std::size_t j = 0; j < independent.size(); ++j) {
        const double unit = suspension.linkage.turns(independent[j]) ? degree : 1;
        add(list, fmt::format("{}.independent.{}", suspension.name, j + 1), unit == 1 ? "m" : "deg",
            "independent coordinate, zero at design", [at, j, unit](const auto& s) {
                return s.model.vehicle.suspensions[at].state(s.state.values.data()).independent[j] / unit;
            });
    }
}

void add_trailer_channels(std::vector<Channel>& list, const TrailerDescription& trailer, std::size_t i) {
    const auto angle = [i](int k) {
        return [i, k](const auto& s) {
            const auto* angles_of_hitch = s.state.values.data() + s.model.vehicle.trailers[i].offset;
            return angles_of_hitch[k] / degree;
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
            [i, axis](const auto& s) {
                const auto place = unit_pose_of(s, i + 1);
                using Vector = Vec3<NumberOf<decltype(s)>>;
                return Vector(place.position + place.R * s.model.vehicle.trailers[i].chassis.center)[axis];
            },
            axis < 2);
    }
}

}  // namespace

void add_suspension_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    for (std::size_t i = 0; i < vehicle.suspensions.size(); ++i) add_channels_of(list, vehicle.suspensions[i], i);
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) add_trailer_channels(list, vehicle.trailers[i], i);
}

}  // namespace hamilcar
