#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar {

namespace {

bool allows(const Setting& setting, double value) {
    if (!(value >= setting.min && value <= setting.max)) return false;
    if (!setting.choices.empty()) return std::ranges::count(setting.choices, value, &Choice::number) > 0;
    return setting.kind == SettingKind::number || value == std::floor(value);
}

std::vector<std::string_view> words_of(const Setting& setting) {
    std::vector<std::string_view> words;
    for (const Choice& choice : setting.choices) words.push_back(choice.word);
    return words;
}

[[noreturn]] void refuse(const Maneuver& maneuver, const Setting& setting, const std::string& name,
                         const std::string& value, const std::string& hint = "") {
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("setting '{}' of maneuver '{}' = {}: expected {}{}", setting.name, maneuver.name, value,
                                setting_range(setting), hint),
                    "maneuver.settings." + name);
}

// Nothing for a word that the setting does not have.
std::optional<double> number_of(const Setting& setting, std::string_view word) {
    if (setting.kind == SettingKind::flag) {  // as other programs say it
        if (same_word(word, "true") || same_word(word, "on")) return 1;
        if (same_word(word, "false") || same_word(word, "off")) return 0;
    }
    const auto choice =
        std::ranges::find_if(setting.choices, [&](const Choice& one) { return same_word(one.word, word); });
    return choice == setting.choices.end() ? std::nullopt : std::optional(choice->number);
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

double setting_factor(const Setting& setting) {
    const auto unit = units::product(setting.unit);
    return unit ? unit->to_si : 1;
}

Setting flag_setting(std::string name, std::string meaning, bool default_value) {
    return {.name = std::move(name),
            .unit = "",
            .meaning = std::move(meaning),
            .default_value = default_value ? 1.0 : 0.0,
            .kind = SettingKind::flag,
            .choices = {{"yes", 1}, {"no", 0}}};
}

Setting choice_setting(std::string name, std::string meaning, std::vector<Choice> choices,
                       std::string_view default_choice) {
    const double number = std::ranges::find(choices, default_choice, &Choice::word)->number;
    const auto [min, max] = std::ranges::minmax(choices, {}, &Choice::number);
    return {std::move(name), "",         std::move(meaning),  number,
            min.number,      max.number, SettingKind::choice, std::move(choices)};
}

std::string setting_range(const Setting& setting) {
    if (!setting.choices.empty()) return io::quoted_list(words_of(setting));
    return fmt::format("{}{:g} to {:g}{}", setting.kind == SettingKind::whole ? "a whole number, " : "", setting.min,
                       setting.max, setting.unit.empty() ? "" : " [" + setting.unit + "]");
}

std::string setting_text(const Setting& setting, double value) {
    const auto choice = std::ranges::find(setting.choices, value, &Choice::number);
    return choice == setting.choices.end() ? fmt::format("{:g}", value) : choice->word;
}

const Setting& setting_called(const std::string& name, const std::vector<Setting>& known, const std::string& maneuver) {
    const auto setting =
        std::ranges::find_if(known, [&](const Setting& one) { return one.name == name || setting_key(one) == name; });
    if (setting != known.end()) return *setting;
    std::vector<std::string_view> names;
    for (const Setting& one : known) names.push_back(one.name);
    const std::string hint = io::did_you_mean(name, names);
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("maneuver '{}' has no setting '{}': expected {}{}", maneuver, name,
                                io::quoted_list(names), hint.empty() ? "" : "; " + hint),
                    "maneuver.settings." + name);
}

Settings settings_in_numbers(const Maneuver& maneuver, const VehicleDescription& vehicle, const TypedSettings& typed) {
    const std::vector<Setting> known = maneuver.settings(vehicle);
    Settings out;
    for (const auto& [name, value] : typed) {
        const Setting& setting = setting_called(name, known, maneuver.name);
        const auto* word = std::get_if<std::string>(&value);
        const auto number = word ? number_of(setting, *word) : std::get<double>(value);
        if (!number) {
            const std::string hint = io::did_you_mean(*word, words_of(setting));
            refuse(maneuver, setting, name, quoted_text(*word), hint.empty() ? "" : "; " + hint);
        }
        out.emplace(name, *number);
    }
    return out;
}

Settings chosen_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen) {
    const std::vector<Setting> known = maneuver.settings(vehicle);
    Settings out;
    for (const auto& [name, value] : chosen) {
        const Setting& setting = setting_called(name, known, maneuver.name);
        if (!allows(setting, value)) refuse(maneuver, setting, name, fmt::format("{:g}", value));
        if (!out.emplace(setting.name, value).second) {
            throw io::Error(io::ExitCode::bad_file,
                            fmt::format("settings '{}' and '{}' of maneuver '{}' are the same: expected each setting "
                                        "once",
                                        setting.name, setting_key(setting), maneuver.name),
                            "maneuver.settings." + name);
        }
    }
    return out;
}

Settings complete_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen) {
    Settings out = chosen_settings(maneuver, vehicle, chosen);
    for (const Setting& setting : maneuver.settings(vehicle)) out.emplace(setting.name, setting.default_value);
    return out;
}

}  // namespace hamilcar
