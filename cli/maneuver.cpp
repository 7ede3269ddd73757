// Standard maneuvers: `hamilcar run --maneuver NAME --vehicle FILE`, scenario files with a [maneuver], and `hamilcar
// maneuvers`.
#include "maneuver.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/maneuver/outcome_file.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/replay_rows.hpp"
#include "interrupt.hpp"
#include "outcome_files.hpp"
#include "progress.hpp"

namespace hamilcar::cli {

std::vector<std::string> maneuver_names() {
    std::vector<std::string> names;
    for (const Maneuver& maneuver : maneuvers()) names.push_back(maneuver.name);
    return names;
}

namespace {

// Runs `f`; an error at a key of the scenario gets the key's place in front.
template <class F>
auto at_place(const ScenarioDescription& scenario, F&& f) {
    try {
        return f();
    } catch (const io::Error& error) {
        if (error.key().empty()) throw;
        throw io::Error(error.code(), at_key(scenario.places, error.key()) + error.what());
    }
}

// Runs `f`; a mistake in a name or a number that was typed on the command line is one of usage.
template <class F>
decltype(auto) as_typed(F&& f) {
    try {
        return f();
    } catch (const io::Error& error) {
        throw io::Error(io::ExitCode::usage, error.what());
    }
}

// The number behind the '=', decimal and finite in any locale, or the word, where the setting has words.
TypedSettings::mapped_type typed_value(const std::string& word, std::size_t at, const Setting& setting) {
    if (const auto value = number_in(std::string_view(word).substr(at + 1))) return *value;
    if (!setting.choices.empty()) return word.substr(at + 1);
    const bool has_unit = word.find_first_of("0123456789", at) != std::string::npos && !setting.unit.empty();
    throw io::Error(io::ExitCode::usage,
                    fmt::format("--set '{}': expected a decimal number behind '{}='{}", word, word.substr(0, at),
                                has_unit ? fmt::format("; the unit is {}, without it", setting.unit) : ""));
}

// "speed=80", "low_side=left": as typed after --set; by the settings' names.
Settings typed_settings(const Maneuver& maneuver, const VehicleDescription& vehicle,
                        const std::vector<std::string>& words) {
    const std::vector<Setting> known = maneuver.settings(vehicle);
    TypedSettings out;
    for (const std::string& word : words) {
        const std::size_t at = word.find('=');
        if (at == std::string::npos) {
            throw io::Error(io::ExitCode::usage, fmt::format("--set '{}': expected NAME=VALUE", word));
        }
        const Setting& setting = setting_called(word.substr(0, at), known, maneuver.name);
        if (!out.emplace(setting.name, typed_value(word, at, setting)).second) {
            throw io::Error(io::ExitCode::usage, fmt::format("--set '{}': expected each setting once", word));
        }
    }
    return chosen_settings(maneuver, vehicle, settings_in_numbers(maneuver, vehicle, out));
}

std::string kind_word(SettingKind kind) {
    switch (kind) {
        case SettingKind::number: return "number";
        case SettingKind::whole: return "whole number";
        case SettingKind::flag: return "flag";
        case SettingKind::choice: return "choice";
    }
    return "";
}

// Numbers as numbers with their limits, flags and choices by their words.
nlohmann::ordered_json setting_json(const Setting& setting) {
    using Json = nlohmann::ordered_json;
    Json choices = Json::array();
    for (const Choice& choice : setting.choices) choices.push_back(choice.word);
    const auto number = [&](double value) { return setting.choices.empty() ? Json(value) : Json(nullptr); };
    const Json by_word = setting_text(setting, setting.default_value);
    return {{"name", setting.name},
            {"key", setting_key(setting)},
            {"unit", setting.unit},
            {"meaning", setting.meaning},
            {"kind", kind_word(setting.kind)},
            {"default", setting.choices.empty() ? Json(setting.default_value) : by_word},
            {"min", number(setting.min)},
            {"max", number(setting.max)},
            {"choices", choices},
            {"range", setting_range(setting)}};
}

void print_maneuvers_as_json(const VehicleDescription& vehicle) {
    nlohmann::ordered_json facts = nlohmann::ordered_json::array();
    for (const Maneuver& maneuver : maneuvers()) {
        nlohmann::ordered_json settings = nlohmann::ordered_json::array();
        for (const Setting& setting : maneuver.settings(vehicle)) settings.push_back(setting_json(setting));
        facts.push_back({{"name", maneuver.name},
                         {"title", maneuver.title},
                         {"standard", maneuver.standard},
                         {"summary", maneuver.summary},
                         {"unsupported_reason", maneuver.unsupported_reason(vehicle)},
                         {"settings", settings}});
    }
    fmt::print("{}\n", io::json_text(facts));
}

void print_maneuvers(const VehicleDescription& vehicle) {
    fmt::print("Maneuvers, with the settings that {} drives them with:\n", vehicle.name);
    for (const Maneuver& m : maneuvers()) {
        fmt::print("\n{}  {} ({})\n  {}\n", m.name, m.title, m.standard, m.summary);
        if (const std::string reason = m.unsupported_reason(vehicle); !reason.empty()) {
            fmt::print("  not with this vehicle: {}\n", reason);
        }
        for (const Setting& s : m.settings(vehicle)) {
            fmt::print("    {}={}{}{}  {} ({})\n", s.name, setting_text(s, s.default_value), s.unit.empty() ? "" : " ",
                       s.unit, s.meaning, setting_range(s));
        }
    }
}

io::ExitCode drive_maneuver(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& settings,
                            const ManeuverOptions& asked, const RunOptions& options, ManeuverRun run) {
    require_support(maneuver, vehicle);
    as_typed([&] { select_channels(all_channels(vehicle), options.channels); });  // known before an hour of driving
    const std::string folder = options.output.empty() ? "out/" + maneuver.name : options.output;
    const io::FolderLock lock = take_folder(folder);
    const InterruptWatch watch;  // until all is written: half a replay is none
    Progress progress(maneuver.name);
    ManeuverOptions driven = asked;
    driven.keep_runs = !options.no_recording, driven.channels = options.channels;
    driven.keep_going = [&](double share) {
        run.interrupted = run.interrupted || interrupted();
        return progress.show(share), !run.interrupted;
    };
    Outcome outcome = maneuver.drive(vehicle, settings, driven);
    progress.clear();
    for (io::PageRun& one : outcome.runs) {
        if (options.interval) keep_rows_apart(one, *options.interval);
    }
    if (run.interrupted) outcome.notes.emplace_back("interrupted: this is of a part of the maneuver");
    print_and_write(run, outcome, {folder, options.json, options.csv, options.silent});
    if (run.interrupted) return io::ExitCode::interrupted;
    if (outcome.failed) {
        fmt::print(stderr, "hamilcar: {}: {}\n", maneuver.name, *outcome.failed);
        return io::ExitCode::numerical;
    }
    return outcome.passed() ? io::ExitCode::ok : io::ExitCode::failed;
}

// `of_file`: settings of a scenario, which those that were typed override.
io::ExitCode start(const Maneuver& maneuver, const std::string& vehicle_file, const TypedSettings& of_file,
                   const ManeuverOptions& asked, const RunOptions& options) {
    if (!options.checkpoint.empty() || !options.resume.empty()) {
        throw io::Error(io::ExitCode::usage,
                        "--checkpoint and --resume are for scenarios; a maneuver is many short drives");
    }
    const VehicleDescription vehicle = read_vehicle({vehicle_file, options.vehicle.set, options.vehicle.set_by});
    Settings settings = complete_settings(maneuver, vehicle, settings_in_numbers(maneuver, vehicle, of_file));
    const Settings typed = as_typed([&] { return typed_settings(maneuver, vehicle, options.settings); });
    for (const auto& [name, value] : typed) settings[name] = value;
    ManeuverRun run{.maneuver = maneuver.name,
                    .title = maneuver.title,
                    .standard = maneuver.standard,
                    .vehicle = vehicle.name,
                    .vehicle_file = vehicle_file,
                    .vehicle_set = options.vehicle.set,
                    .settings = {},
                    .step = asked.solver.step,
                    .integrator = asked.solver.integrator,
                    .program = "Hamilcar " HAMILCAR_VERSION};
    for (const Setting& setting : maneuver.settings(vehicle)) {
        run.settings.emplace_back(setting, settings.at(setting.name));
    }
    return drive_maneuver(maneuver, vehicle, settings, asked, options, run);
}

}  // namespace

io::ExitCode run_maneuver(const RunOptions& options) {
    ManeuverOptions asked;
    if (options.step) asked.solver.step = *options.step;
    const std::string vehicle = vehicle_or_shipped(options.vehicle.file);
    const Maneuver& maneuver = as_typed([&]() -> const Maneuver& { return require_maneuver(options.maneuver); });
    return start(maneuver, vehicle, {}, asked, options);
}

io::ExitCode run_maneuver(const ScenarioDescription& scenario, const RunOptions& options) {
    ManeuverOptions asked{.solver = scenario.solver,
                          .road = scenario.road,
                          .controllers_off = scenario.controllers_off,
                          .steering_mechanics = scenario.steering_mechanics};
    if (options.step) asked.solver.step = *options.step;
    const std::string& vehicle = options.vehicle.file.empty() ? scenario.vehicle : options.vehicle.file;
    return at_place(scenario, [&] {
        return start(require_maneuver(scenario.maneuver.name), vehicle, scenario.maneuver.settings, asked, options);
    });
}

void check_maneuver(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    at_place(scenario, [&] {
        const Maneuver& maneuver = require_maneuver(scenario.maneuver.name);
        require_support(maneuver, vehicle);
        complete_settings(maneuver, vehicle, settings_in_numbers(maneuver, vehicle, scenario.maneuver.settings));
    });
}

namespace {

struct ManeuversOptions {
    VehicleChoice vehicle;
    bool json = false;
};

io::ExitCode list_maneuvers(const ManeuversOptions& options) {
    const VehicleDescription vehicle = read_vehicle_or_shipped(options.vehicle);
    if (options.json) {
        print_maneuvers_as_json(vehicle);
    } else {
        print_maneuvers(vehicle);
    }
    return io::ExitCode::ok;
}

}  // namespace

void add_maneuvers(CommandList& list) {
    auto [command, o] =
        list.add<ManeuversOptions>("maneuvers", "list the standard maneuvers and their settings", list_maneuvers);
    command.add("vehicle", o.vehicle.file, "vehicle file (TOML) whose default settings to show [the shipped 323i]");
    add_vehicle_set(command, o.vehicle);
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
