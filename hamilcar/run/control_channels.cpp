#include "hamilcar/run/control_channels.hpp"

#include "hamilcar/base/units.hpp"

namespace hamilcar {

namespace {

constexpr double bar = 1e5;  // [Pa]

void add_line_channels(const std::string& wheel, std::size_t line, std::vector<Channel>& list) {
    const auto add = [&](const char* what, const char* unit, const char* meaning, auto read, bool standard = false) {
        list.push_back(
            {{wheel + what, unit, meaning}, [line, read](const auto& s) { return read(s, line); }, standard});
    };
    add(
        ".brake.pressure", "bar", "at the wheel's brake",
        [](const auto& s, std::size_t i) {
            using T = NumberOf<decltype(s)>;
            return T(s.model.vehicle.brakes.pressure(i, s.state.values.data()) * T(1 / bar));
        },
        true);
    list.back().column.role = io::ChannelRole::brake_pressure, list.back().column.of = wheel;
    add(".brake.temperature", "degC", "of disc or drum", [](const auto& s, std::size_t i) {
        using T = NumberOf<decltype(s)>;
        return T(s.model.vehicle.brakes.temperature(i, s.state.values.data()));
    });
    add(".brake.limit", "N m", "that the brake can hold",
        [](const auto& s, std::size_t i) { return s.momenta.brakes.lines[i].limit; });
    add(".brake.cooling", "W", "from disc or drum to the air", [](const auto& s, std::size_t i) {
        const auto& brakes = s.model.vehicle.brakes;
        return brakes.lines[i].cooling_power(brakes.temperature(i, s.state.values.data()),
                                             s.momenta.brakes.lines[i].spin);
    });
}

void add_brake_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    if (!vehicle.brakes.exists) return;
    list.push_back({{"brakes.control_pressure", "bar", "that the pedal makes"}, [](const auto& s) {
                        using T = NumberOf<decltype(s)>;
                        return T(s.model.vehicle.brakes.control(0, s.state.values.data()) * T(1 / bar));
                    }});
    std::size_t line = 0;
    for_each_wheel(vehicle, [&](const SuspensionWheelDescription& wheel, std::size_t) {
        if (wheel.brake.max_torque > 0) add_line_channels(wheel.name, line++, list);
    });
}

// Of a controller that a scenario may have left out.
double activity_of(const Sample& s, const std::string& kind) {
    for (std::size_t i = 0; s.control && i < s.control->controller_count(); ++i) {
        if (s.control->keyword(i) == kind) return s.control->activity(i, s.control_memory);
    }
    return 0;
}

// A run without power units has no commands of theirs, and those behind them move up.
struct CommandPlaces {
    int first_unit, units;
    int in_run(int command, bool powered) const {
        if (powered || command < first_unit) return command;
        return command < first_unit + units ? -1 : command - units;
    }
};

}  // namespace

void add_control_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    add_brake_channels(vehicle, list);
    const CommandLayout layout(vehicle);
    const int units = layout.of_all_units();
    const CommandPlaces places{units > 0 ? layout.unit(0) : layout.size(), units};
    for (int i = 0; i < layout.size(); ++i) {
        const Command& command = layout.commands()[static_cast<std::size_t>(i)];
        list.push_back({{"command." + command.name, command.unit, command.meaning},
                        [i, places, rest = command.rest](const auto& s) {
                            using T = NumberOf<decltype(s)>;
                            const int at = places.in_run(i, s.model.vehicle.powertrain.exists());
                            return s.input.commands && at >= 0 ? T(s.input.commands[at]) : T(rest);
                        }});
    }
    for (const ControllerDescription& one : vehicle.controllers) {
        const std::string& kind = one.kind;
        list.push_back(
            {{kind + ".activity", "1", "of that controller, 0 to 1", io::ChannelRole::controller_activity, kind},
             [kind](const Sample& s) { return activity_of(s, kind); },
             true});
    }
}

}  // namespace hamilcar
