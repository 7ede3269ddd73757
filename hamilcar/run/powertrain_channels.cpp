#include "hamilcar/run/powertrain_channels.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/base/units.hpp"

namespace hamilcar {

namespace {

using units::rpm;

using io::ChannelRole;

// Of a unit, whose last gear stands for all beyond it; 0 also between two gears, and in a reverse gear that it has not.
double gear_in(const Sample& s, std::size_t i) {
    if (!s.model.vehicle.powertrain.exists()) return 0;
    const auto& gears = s.model.vehicle.powertrain.units[i].gears;
    const double gear = std::min(s.input.gear, static_cast<double>(gears.ratio.size()) - 2);
    return gear == std::floor(gear) ? gear * gears.at(gear).connected : 0;
}

void add_unit_channels(const std::string& name, std::size_t i, std::vector<Channel>& list) {
    const auto add = [&](const char* what, const char* unit, const char* meaning, auto read, bool standard,
                         ChannelRole role = ChannelRole::none) {
        list.push_back({{name + what, unit, meaning, role, name},
                        [i, read](const auto& s) {
                            using T = NumberOf<decltype(s)>;
                            return s.model.vehicle.powertrain.exists() ? T(read(s.momenta.powertrain.units[i])) : T(0);
                        },
                        standard});
    };
    add(
        ".speed", "rpm", "of the rotor", [](const auto& u) { return u.spin / rpm; }, true, ChannelRole::rotor_speed);
    add(
        ".torque", "N m", "of combustion or field on the rotor", [](const auto& u) { return u.source; }, true,
        ChannelRole::rotor_torque);
    add(
        ".power", "kW", "of that torque", [](const auto& u) { return 1e-3 * u.source * u.spin; }, false);
    add(
        ".throttle", "1", "that is in force", [](const auto& u) { return u.throttle; }, false,
        ChannelRole::unit_throttle);
    list.push_back({{name + ".gear", "1", "that is in: -1 reverse, 0 none, 1 first", ChannelRole::gear, name},
                    [i](const Sample& s) { return gear_in(s, i); },
                    true});
    add(
        ".clutch_torque", "N m", "through the clutch, to the gearbox", [](const auto& u) { return u.clutch; }, true,
        ChannelRole::clutch_torque);
    add(
        ".clutch_slip", "rpm", "of the rotor over the gearbox's input",
        [](const auto& u) { return (u.spin - u.shaft_speed) / rpm; }, false);
    add(
        ".converter_torque", "N m", "of the turbine on the gearbox", [](const auto& u) { return u.turbine; }, false);
    add(
        ".output_torque", "N m", "of the gearbox on the shaft behind it", [](const auto& u) { return u.out; }, false);
    add(
        ".ratio", "1", "of the gear that is in, negative in reverse", [](const auto& u) { return u.ratio; }, false);
    add(
        ".losses", "kW", "in clutch, converter and gearbox", [](const auto& u) { return 1e-3 * u.loss; }, false);
}

void add_motor_channels(const VehicleDescription& vehicle, std::size_t i, std::vector<Channel>& list) {
    const std::string& name = vehicle.power_units[i].name;
    const auto add = [&](const char* what, const char* unit, const char* meaning, auto read) {
        list.push_back({{name + what, unit, meaning},
                        [i, read](const auto& s) {
                            using T = NumberOf<decltype(s)>;
                            return s.model.vehicle.powertrain.exists() ? T(read(s.momenta.powertrain.units[i])) : T(0);
                        },
                        false});
    };
    if (!std::holds_alternative<MotorDescription>(vehicle.power_units[i].source)) return;
    add(".electric_power", "kW", "that it takes, negative where it gives back",
        [](const auto& u) { return 1e-3 * u.electric_power; });
    add(".regenerated_torque", "N m", "behind the gearbox, that it brakes in place of the wheels' brakes",
        [](const auto& u) { return u.regenerated; });
}

void add_battery_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    if (!vehicle.battery.exists) return;
    const auto add = [&](const char* name, const char* unit, const char* meaning, auto read, bool standard) {
        list.push_back({{name, unit, meaning},
                        [read](const auto& s) {
                            using T = NumberOf<decltype(s)>;
                            return s.model.vehicle.powertrain.battery.exists() ? T(read(s)) : T(0);
                        },
                        standard});
    };
    add(
        "battery.charge", "%", "of its capacity",
        [](const auto& s) {
            return s.model.vehicle.powertrain.battery.state(s.state.values.data()).charge / units::percent;
        },
        true);
    add(
        "battery.voltage", "V", "at its terminals",
        [](const auto& s) { return s.model.vehicle.powertrain.battery.state(s.state.values.data()).voltage; }, false);
    add(
        "battery.current", "A", "positive where it discharges",
        [](const auto& s) { return s.momenta.powertrain.battery.current; }, false);
    add(
        "battery.power", "kW", "at its terminals, positive where it discharges",
        [](const auto& s) { return 1e-3 * s.momenta.powertrain.battery.power; }, true);
    add(
        "battery.heat", "kW", "in its resistance",
        [](const auto& s) { return 1e-3 * s.momenta.powertrain.battery.heat; }, false);
}

}  // namespace

void add_powertrain_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    if (vehicle.power_units.empty()) return;
    const auto add = [&](const char* name, const char* unit, const char* meaning, auto read, bool standard) {
        list.push_back({{name, unit, meaning}, read, standard});
    };
    add(
        "input.throttle", "1", "pedal of the power units", [](const auto& s) { return s.input.throttle; }, true);
    add(
        "input.clutch", "1", "pedal, 1 pressed", [](const auto& s) { return s.input.clutch; }, false);
    add(
        "input.gear", "1", "-1 reverse, 0 neutral, 1 first", [](const auto& s) { return s.input.gear; }, true);
    for (std::size_t i = 0; i < vehicle.power_units.size(); ++i) {
        add_unit_channels(vehicle.power_units[i].name, i, list);
        add_motor_channels(vehicle, i, list);
        if (!vehicle.power_units[i].shafts.exists) continue;
        const std::string& unit = vehicle.power_units[i].name;
        list.push_back(
            {{unit + ".shafts_twist", "deg", "of the shafts behind the gearbox, play included, at its input"},
             [i](const Sample& s) {
                 const Powertrain<double>& powertrain = s.model.vehicle.powertrain;
                 if (!powertrain.exists()) return 0.0;
                 return powertrain.units[i].state(s.state.values.data()).shafts[1] / units::degree;
             },
             false});
    }
    add_battery_channels(vehicle, list);
    for (std::size_t i = 0; i < vehicle.differentials.size(); ++i) {
        const std::string name = vehicle.differentials[i].name + ".differential";
        const auto add_lock = [&](const char* what, const char* unit, const char* meaning, auto read) {
            list.push_back({{name + what, unit, meaning}, [i, read](const auto& s) {
                                using T = NumberOf<decltype(s)>;
                                return s.model.vehicle.powertrain.exists()
                                           ? T(read(s.momenta.powertrain.differentials[i]))
                                           : T(0);
                            }});
        };
        add_lock(".lock_torque", "N m", "from the first output to the second", [](const auto& d) { return d.lock; });
        add_lock(".losses", "kW", "of the lock", [](const auto& d) { return 1e-3 * d.loss; });
        list.push_back({{name + ".input_torque", "N m", "of what drives it"}, [i](const auto& s) {
                            using T = NumberOf<decltype(s)>;
                            return s.model.vehicle.powertrain.exists() ? T(s.momenta.powertrain.inputs[i]) : T(0);
                        }});
    }
    add(
        "energy.supplied", "J", "by the power units",
        [](const Sample& s) {
            const Powertrain<double>& powertrain = s.model.vehicle.powertrain;
            return powertrain.exists() ? powertrain.supplied(s.state.values.data()) : 0;
        },
        false);
}

}  // namespace hamilcar
