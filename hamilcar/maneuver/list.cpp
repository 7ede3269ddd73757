#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar {

const std::vector<Maneuver>& maneuvers() {
    static const std::vector<Maneuver> all{
        constant_radius(), constant_speed(),  constant_steer(), step_steer(),         sine_steer(),
        pulse_steer(),     random_steer(),    weave(),          double_lane_change(), obstacle_avoidance(),
        braking_in_turn(), sine_with_dwell(), fishhook(),       straight_braking(),   split_braking(),
        acceleration(),    coast_down(),      cleat(),          rough_road(),
    };
    return all;
}

const Maneuver* find_maneuver(const std::string& name) {
    const auto found = std::ranges::find(maneuvers(), name, &Maneuver::name);
    return found == maneuvers().end() ? nullptr : &*found;
}

std::string setting_key(const Setting& setting) {
    std::string unit = setting.unit;
    const auto replace = [&](std::string_view what, std::string_view by) {
        for (std::size_t at; (at = unit.find(what)) != std::string::npos;) unit.replace(at, what.size(), by);
    };
    replace("/", "_per_"), replace("^", ""), replace(" ", "_"), replace("%", "percent");
    return unit.empty() ? setting.name : setting.name + "_" + unit;
}

Settings complete_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen) {
    const std::vector<Setting> known = maneuver.settings(vehicle);
    Settings out;
    std::vector<std::string_view> names;
    for (const Setting& setting : known) out[setting.name] = setting.usual, names.push_back(setting.name);
    for (const auto& [chosen_name, value] : chosen) {
        const std::string& name = chosen_name;
        const auto setting = std::ranges::find_if(
            known, [&](const Setting& one) { return one.name == name || setting_key(one) == name; });
        if (setting == known.end()) {
            const auto nearest = io::nearest_word(name, names);
            throw io::Error(
                io::ExitCode::bad_file,
                fmt::format("maneuver '{}' has no setting '{}': expected {}{}", maneuver.name, name,
                            io::quoted_list(names), nearest ? fmt::format("; did you mean '{}'?", *nearest) : ""),
                "maneuver.settings." + name);
        }
        if (!(value >= setting->least && value <= setting->most)) {
            throw io::Error(io::ExitCode::bad_file,
                            fmt::format("setting '{}' of maneuver '{}' = {:g}: expected {:g} to {:g}{}", setting->name,
                                        maneuver.name, value, setting->least, setting->most,
                                        setting->unit.empty() ? "" : " [" + setting->unit + "]"),
                            "maneuver.settings." + name);
        }
        out[setting->name] = value;
    }
    return out;
}

}  // namespace hamilcar
