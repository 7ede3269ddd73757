#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar {

namespace {

bool allows(const Setting& setting, double value) {
    if (!(value >= setting.least && value <= setting.most)) return false;
    switch (setting.kind) {
        case SettingKind::number: return true;
        case SettingKind::side: return value == -1 || value == 1;
        case SettingKind::toggle:
        case SettingKind::whole: return value == std::floor(value);
    }
    return false;
}

}  // namespace

std::string setting_key(const Setting& setting) {
    std::string unit = setting.unit;
    const auto replace = [&](std::string_view what, std::string_view by) {
        for (std::size_t at; (at = unit.find(what)) != std::string::npos;) unit.replace(at, what.size(), by);
    };
    replace("/", "_per_"), replace("^", ""), replace(" ", "_"), replace("%", "percent");
    return unit.empty() ? setting.name : setting.name + "_" + unit;
}

std::string setting_range(const Setting& setting) {
    if (setting.kind == SettingKind::toggle) return "0 or 1";
    if (setting.kind == SettingKind::side) return "-1 or 1";
    return fmt::format("{}{:g} to {:g}{}", setting.kind == SettingKind::whole ? "a whole number, " : "", setting.least,
                       setting.most, setting.unit.empty() ? "" : " [" + setting.unit + "]");
}

const Setting& setting_called(const std::string& name, const std::vector<Setting>& known, const std::string& maneuver) {
    const auto setting =
        std::ranges::find_if(known, [&](const Setting& one) { return one.name == name || setting_key(one) == name; });
    if (setting != known.end()) return *setting;
    std::vector<std::string_view> names;
    for (const Setting& one : known) names.push_back(one.name);
    const auto nearest = io::nearest_word(name, names);
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("maneuver '{}' has no setting '{}': expected {}{}", maneuver, name,
                                io::quoted_list(names), nearest ? fmt::format("; did you mean '{}'?", *nearest) : ""),
                    "maneuver.settings." + name);
}

Settings chosen_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen) {
    const std::vector<Setting> known = maneuver.settings(vehicle);
    Settings out;
    for (const auto& [name, value] : chosen) {
        const Setting& setting = setting_called(name, known, maneuver.name);
        const std::string key = "maneuver.settings." + name;
        if (!allows(setting, value)) {
            throw io::Error(io::ExitCode::bad_file,
                            fmt::format("setting '{}' of maneuver '{}' = {:g}: expected {}", setting.name,
                                        maneuver.name, value, setting_range(setting)),
                            key);
        }
        if (!out.emplace(setting.name, value).second) {
            throw io::Error(io::ExitCode::bad_file,
                            fmt::format("settings '{}' and '{}' of maneuver '{}' are the same: expected each setting "
                                        "once",
                                        setting.name, setting_key(setting), maneuver.name),
                            key);
        }
    }
    return out;
}

Settings complete_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen) {
    Settings out = chosen_settings(maneuver, vehicle, chosen);
    for (const Setting& setting : maneuver.settings(vehicle)) out.emplace(setting.name, setting.usual);
    return out;
}

}  // namespace hamilcar
