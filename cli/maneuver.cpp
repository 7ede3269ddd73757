// Standard maneuvers: `hamilcar run --maneuver NAME --vehicle FILE`, scenario files with a [maneuver], `hamilcar maneuvers` and
// `hamilcar compare`.
#include "maneuver.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/result_file.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/maneuver/outcome_file.hpp"
#include "outcome_files.hpp"
#include "page_run.hpp"
#include "progress.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

const Maneuver& require_maneuver(const std::string& name) {
    if (const Maneuver* maneuver = find_maneuver(name)) return *maneuver;
    std::vector<std::string_view> names;
    for (const Maneuver& maneuver : maneuvers()) names.push_back(maneuver.name);
    const auto nearest = io::nearest_word(name, names);
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("there is no maneuver '{}': expected {}{}", name, io::quoted_list(names),
                                nearest ? fmt::format("; did you mean '{}'?", *nearest) : ""),
                    "maneuver.name");
}

void check_obstacle(const Maneuver& maneuver, const VehicleDescription& vehicle) {
    const std::string obstacle = maneuver.obstacle(vehicle);
    if (obstacle.empty()) return;
    throw io::Error(io::ExitCode::bad_file,
                    fmt::format("{} cannot do the maneuver '{}': {}", vehicle.name, maneuver.name, obstacle),
                    "maneuver.name");
}

// Runs `f`; an error at a key of the scenario gets the key's place in front.
template <class F>
auto at_place(const std::string& file, F&& f) {
    try {
        return f();
    } catch (const io::Error& error) {
        if (error.key().empty()) throw;
        throw io::Error(error.code(), io::place_of(file, error.key()) + ": " + error.what());
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

// The number behind the '=', decimal and finite in any locale.
double typed_number(const std::string& word, std::size_t at, const Setting& setting) {
    const char *begin = word.data() + at + 1, *end = word.data() + word.size();
    double value = 0;
    const auto [rest, mistake] = std::from_chars(begin, end, value);
    if (mistake == std::errc() && rest == end && std::isfinite(value)) return value;
    const bool has_unit = mistake == std::errc() && rest != end && !setting.unit.empty();
    throw io::Error(io::ExitCode::usage,
                    fmt::format("--set '{}': expected a decimal number behind '{}='{}", word, word.substr(0, at),
                                has_unit ? fmt::format("; the unit is {}, without it", setting.unit) : ""));
}

// "speed=80": as typed after --set; by the settings' names.
Settings typed_settings(const Maneuver& maneuver, const VehicleDescription& vehicle,
                        const std::vector<std::string>& words) {
    const std::vector<Setting> known = maneuver.settings(vehicle);
    Settings out;
    for (const std::string& word : words) {
        const std::size_t at = word.find('=');
        if (at == std::string::npos) {
            throw io::Error(io::ExitCode::usage, fmt::format("--set '{}': expected NAME=NUMBER", word));
        }
        const Setting& setting = setting_called(word.substr(0, at), known, maneuver.name);
        if (!out.emplace(setting.name, typed_number(word, at, setting)).second) {
            throw io::Error(io::ExitCode::usage, fmt::format("--set '{}': expected each setting once", word));
        }
    }
    return chosen_settings(maneuver, vehicle, out);
}

std::string kind_word(SettingKind kind) {
    switch (kind) {
        case SettingKind::number: return "number";
        case SettingKind::whole: return "whole number";
        case SettingKind::toggle: return "0 or 1";
        case SettingKind::side: return "-1 or 1";
    }
    return "";
}

io::ExitCode drive_maneuver(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& settings,
                            const ManeuverOptions& asked, const Options& options, const ManeuverRun& run) {
    check_obstacle(maneuver, vehicle);
    const std::string folder = options.output.empty() ? "out/" + maneuver.name : options.output;
    const io::FolderLock lock = take_folder(folder);
    const InterruptWatch watch;  // until all is written: half a film is none
    Progress progress(maneuver.name);
    ManeuverOptions driven = asked;
    bool stopped = false;
    driven.keep_going = [&](double share) {
        stopped = stopped || interrupted();
        return progress.show(share), !stopped;
    };
    Outcome outcome = maneuver.drive(vehicle, settings, driven);
    progress.clear();
    if (stopped) outcome.notes.emplace_back("interrupted: this is of a part of the maneuver");
    tell_and_write(run, outcome, stopped, folder, options);
    if (stopped) return io::ExitCode::interrupted;
    if (outcome.failed) {
        fmt::print(stderr, "hamilcar: {}: {}\n", maneuver.name, *outcome.failed);
        return io::ExitCode::numerical;
    }
    return outcome.passed() ? io::ExitCode::ok : io::ExitCode::failed;
}

// `of_file`: settings of a scenario, which those that were typed override.
io::ExitCode start(const Maneuver& maneuver, const std::string& vehicle_file, const Settings& of_file,
                   const ManeuverOptions& asked, const Options& options) {
    if (!options.checkpoint.empty() || !options.resume.empty()) {
        throw io::Error(io::ExitCode::usage,
                        "--checkpoint and --resume are for scenarios; a maneuver is many short drives");
    }
    const VehicleDescription vehicle = io::read_vehicle(vehicle_file);
    Settings settings = complete_settings(maneuver, vehicle, of_file);
    const Settings typed = as_typed([&] { return typed_settings(maneuver, vehicle, options.settings); });
    for (const auto& [name, value] : typed) settings[name] = value;
    ManeuverRun run{.maneuver = maneuver.name,
                    .title = maneuver.title,
                    .standard = maneuver.standard,
                    .vehicle = vehicle.name,
                    .vehicle_file = vehicle_file,
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

io::ExitCode run_maneuver(const Options& options) {
    ManeuverOptions asked;
    if (options.step > 0) asked.solver.step = options.step;
    const std::string vehicle = options.vehicle.empty() ? shipped_file("vehicles/bmw_323i.toml") : options.vehicle;
    const Maneuver& maneuver = as_typed([&]() -> const Maneuver& { return require_maneuver(options.maneuver); });
    return start(maneuver, vehicle, {}, asked, options);
}

io::ExitCode run_maneuver(const ScenarioDescription& scenario, const Options& options) {
    ManeuverOptions asked{.solver = scenario.solver, .road = scenario.road};
    if (options.step > 0) asked.solver.step = options.step;
    const std::string& vehicle = options.vehicle.empty() ? scenario.vehicle : options.vehicle;
    return at_place(options.file, [&] {
        return start(require_maneuver(scenario.maneuver.name), vehicle, scenario.maneuver.settings, asked, options);
    });
}

void check_maneuver(const ScenarioDescription& scenario, const VehicleDescription& vehicle, const std::string& file) {
    at_place(file, [&] {
        const Maneuver& maneuver = require_maneuver(scenario.maneuver.name);
        check_obstacle(maneuver, vehicle);
        complete_settings(maneuver, vehicle, scenario.maneuver.settings);
    });
}

io::ExitCode list_maneuvers(const Options& options) {
    const VehicleDescription vehicle =
        io::read_vehicle(options.file.empty() ? shipped_file("vehicles/bmw_323i.toml") : options.file);
    nlohmann::ordered_json facts = nlohmann::ordered_json::array();
    for (const Maneuver& maneuver : maneuvers()) {
        nlohmann::ordered_json settings = nlohmann::ordered_json::array();
        for (const Setting& s : maneuver.settings(vehicle)) {
            settings.push_back({{"name", s.name},
                                {"key", setting_key(s)},
                                {"unit", s.unit},
                                {"meaning", s.meaning},
                                {"usual", s.usual},
                                {"least", s.least},
                                {"most", s.most},
                                {"kind", kind_word(s.kind)},
                                {"range", setting_range(s)}});
        }
        facts.push_back({{"name", maneuver.name},
                         {"title", maneuver.title},
                         {"standard", maneuver.standard},
                         {"summary", maneuver.summary},
                         {"obstacle", maneuver.obstacle(vehicle)},
                         {"settings", settings}});
    }
    if (options.json) {
        fmt::print("{}\n", io::json_text(facts));
        return io::ExitCode::ok;
    }
    fmt::print("Maneuvers, with the settings that {} drives them with:\n", vehicle.name);
    for (const auto& m : facts) {
        fmt::print("\n{}  {} ({})\n  {}\n", m["name"].get<std::string>(), m["title"].get<std::string>(),
                   m["standard"].get<std::string>(), m["summary"].get<std::string>());
        if (const auto obstacle = m["obstacle"].get<std::string>(); !obstacle.empty()) {
            fmt::print("  not with this vehicle: {}\n", obstacle);
        }
        for (const auto& s : m["settings"]) {
            const auto unit = s["unit"].get<std::string>();
            fmt::print("    {}={:g}{}{}  {} ({})\n", s["name"].get<std::string>(), s["usual"].get<double>(),
                       unit.empty() ? "" : " ", unit, s["meaning"].get<std::string>(), s["range"].get<std::string>());
        }
    }
    return io::ExitCode::ok;
}

io::ExitCode compare(const Options& options) {
    if (options.files.size() < 2) {
        throw io::Error(io::ExitCode::usage,
                        "compare: expected two outcomes or more, folders that 'hamilcar run --maneuver' "
                        "wrote; 'hamilcar view' shows one");
    }
    const std::string page = options.output.empty() ? "comparison.html" : options.output;
    check_output(page);
    std::vector<std::pair<ManeuverRun, Outcome>> runs;
    for (const std::string& given : options.files) {
        const fs::path path = fs::is_directory(given) ? fs::path(given) / "outcome.json" : fs::path(given);
        if (!fs::exists(path)) {
            throw io::Error(io::ExitCode::input_output,
                            path.string() +
                                ": not there; expected what 'hamilcar run --maneuver' wrote "
                                "('hamilcar view' compares results of scenarios)");
        }
        auto run = read_outcome(path.string());
        if (says_interrupted(path.string())) {
            fmt::print(stderr, "hamilcar: note: {} is of a maneuver that was interrupted\n", path.string());
        }
        if (!runs.empty() && run.first.maneuver != runs[0].first.maneuver) {
            fmt::print(stderr, "hamilcar: note: different maneuvers: {} has {}, {} has {}\n", options.files[0],
                       runs[0].first.maneuver, given, run.first.maneuver);
        }
        const fs::path film = path.parent_path() / "drive.nc";
        if (fs::exists(film)) run.second.runs.push_back(read_run(film.string(), options.rows));
        runs.push_back(std::move(run));
    }
    io::write_page(page, comparison_page(std::move(runs)));
    fmt::print("{}\n", page);
    if (options.open) open_in_browser(fs::absolute(page).string());
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
