// One run of one variant: its files with the point's values in them, driven or analyzed, as figures.
#include <algorithm>
#include <cmath>
#include <exception>

#include "hamilcar/analysis/vehicle_figures.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/set_key.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/study/study.hpp"

namespace hamilcar {

namespace {

// What a point sets of one of the files, without the owner's name.
std::vector<std::string> assignments(const StudyDescription& study, const StudyPoint& point, const std::string& owner) {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < study.parameters.size(); ++i) {
        for (const std::string& key : study.parameters[i].keys) {
            if (key.starts_with(owner + ".")) out.push_back(key.substr(owner.size() + 1) + "=" + point.values[i]);
        }
    }
    return out;
}

// Paths among the values are relative to the study's file.
VehicleDescription vehicle_of(const StudyDescription& study, const StudyPoint& point) {
    io::Node document = io::read_toml(study.vehicle);
    for (const std::string& assignment : assignments(study, point, "vehicle")) {
        io::set_key(document, assignment, study.file);
    }
    return io::read_vehicle(document);
}

const Maneuver& maneuver_of(const ScenarioDescription& scenario) {
    if (const Maneuver* maneuver = find_maneuver(scenario.maneuver.name)) return *maneuver;
    throw io::Error(io::ExitCode::bad_file,
                    "there is no maneuver '" + scenario.maneuver.name + "'; 'hamilcar maneuvers' lists all");
}

Settings settings_of(const Maneuver& maneuver, const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    if (const std::string reason = maneuver.unsupported_reason(vehicle); !reason.empty()) {
        throw io::Error(io::ExitCode::bad_file,
                        vehicle.name + " cannot do the maneuver '" + maneuver.name + "': " + reason);
    }
    return complete_settings(maneuver, vehicle, settings_in_numbers(maneuver, vehicle, scenario.maneuver.settings));
}

std::optional<RunResult> drive(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                               const std::function<bool()>& keep_going) {
    const Maneuver& maneuver = maneuver_of(scenario);
    bool interrupted = false;
    ManeuverOptions options{.solver = scenario.solver,
                            .road = scenario.road,
                            .controllers_off = scenario.controllers_off,
                            .steering_mechanics = scenario.steering_mechanics,
                            .keep_runs = false};
    options.keep_going = [&](double) { return !(interrupted = interrupted || !keep_going()); };
    const Outcome outcome = maneuver.drive(vehicle, settings_of(maneuver, vehicle, scenario), options);
    if (interrupted) return std::nullopt;
    RunResult result{.figures = outcome.figures, .passed = {}, .failed = outcome.failed.value_or("")};
    if (!outcome.verdicts.empty() || outcome.failed) result.passed = outcome.passed();
    return result;
}

// Smallest, largest and last value of every channel that the scenario's [output] names.
std::optional<RunResult> simulate(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                                  const std::function<bool()>& keep_going) {
    const std::vector<Channel> channels =
        select_channels(all_channels(vehicle), scenario.output.channels, scenario.places);
    Simulation simulation(vehicle, scenario);
    std::vector<double> min(channels.size(), INFINITY), max(channels.size(), -INFINITY), last(channels.size());
    const RunSummary summary = record(
        simulation, channels, scenario.output.interval,
        [&](const Sample&, const std::vector<double>& row) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                min[i] = std::min(min[i], row[i]), max[i] = std::max(max[i], row[i]), last[i] = row[i];
            }
        },
        [&](double, const RunSummary&) { return keep_going(); });
    if (summary.interrupted) return std::nullopt;
    RunResult result{.figures = {}, .passed = {}, .failed = summary.ended_early.value_or("")};
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const io::Column& column = channels[i].column;
        for (const auto& [word, value] : {std::pair{"min ", min[i]}, {"max ", max[i]}, {"end ", last[i]}}) {
            result.figures.push_back({word + column.name, column.unit, column.description, value});
        }
    }
    return result;
}

std::vector<Figure> figures_of(const std::vector<AxleReport>& axles) {
    std::vector<Figure> out;
    for (const AxleReport& axle : axles) {
        const WheelFigures& left = axle.design.left;
        const auto add = [&](const char* name, const char* unit, double value) {
            if (std::isfinite(value)) out.push_back({axle.name + " " + name, unit, "at design", value});
        };
        add("toe-in", "deg", left.toe / units::degree), add("camber", "deg", left.camber / units::degree);
        add("caster", "deg", left.caster / units::degree);
        add("kingpin inclination", "deg", left.inclination / units::degree);
        add("scrub radius", "mm", 1e3 * left.scrub), add("mechanical trail", "mm", 1e3 * left.trail);
        add("roll center height", "mm", 1e3 * axle.design.roll_center);
        add("spring ratio", "1", left.spring_ratio), add("damper ratio", "1", left.damper_ratio);
        add("wheel rate", "N/mm", 1e-3 * left.wheel_rate);
        add("anti under braking", "%", axle.anti_brake), add("anti under drive", "%", axle.anti_drive);
    }
    return out;
}

std::vector<Figure> figures_of(const VehicleFigures& f) {
    std::vector<Figure> out{{"total mass", "kg", "of everything", f.total_mass},
                            {"wheelbase", "m", "first axle to last", f.wheelbase},
                            {"center of mass behind the front axle", "m", "", f.center_of_mass[0]},
                            {"center of mass height", "m", "over the road at rest", f.center_of_mass[2]},
                            {"static stability factor", "1", "", f.static_stability_factor}};
    if (!std::isnan(f.cross_weight))
        out.push_back({"cross weight", "%", "front right and rear left", 100 * f.cross_weight});
    for (const StandingAxle& axle : f.axles) {
        out.push_back({axle.name + " track", "m", "", axle.track});
        out.push_back({axle.name + " load", "N", "at rest", axle.load});
        out.push_back({axle.name + " roll stiffness", "N m/deg", "tires rigid", axle.roll_stiffness * units::degree});
        out.push_back({axle.name + " ride frequency", "Hz", "of its load on its springs", axle.ride_frequency});
    }
    if (f.steering) {
        out.push_back({"steering ratio", "1", "at the middle", f.steering->ratio});
        out.push_back({"turning circle", "m", "between walls", f.steering->turning_circle});
    }
    for (const Mode& mode : f.rides) {
        out.push_back({mode.name + " frequency", "Hz", "at rest", mode.frequency});
        out.push_back({mode.name + " damping ratio", "1", "at rest", mode.damping_ratio});
    }
    std::erase_if(out, [](const Figure& figure) { return !std::isfinite(figure.value); });
    return out;
}

RunResult analyze(const VehicleDescription& vehicle, const std::string& analysis) {
    const std::vector<AxleReport> axles = kinematics(vehicle, {.steps = 8});
    if (analysis == "kinematics") return {.figures = figures_of(axles), .passed = {}, .failed = ""};
    const Linearizer linearizer(vehicle);
    const OperatingPoint rest = linearizer.operating_point({});
    if (!rest.found) return {.figures = {}, .passed = {}, .failed = rest.problem};
    return {.figures = figures_of(vehicle_figures(linearizer, rest, axles)), .passed = {}, .failed = ""};
}

std::optional<RunResult> run_point(const StudyDescription& study, const StudyPoint& point, const StudyRun& run,
                                   const std::function<bool()>& keep_going) {
    const VehicleDescription vehicle = vehicle_of(study, point);
    if (!run.analysis.empty()) return analyze(vehicle, run.analysis);
    const ScenarioDescription scenario = scenario_of(study, point, run);
    return scenario.maneuver.name.empty() ? simulate(vehicle, scenario, keep_going)
                                          : drive(vehicle, scenario, keep_going);
}

}  // namespace

ScenarioDescription scenario_of(const StudyDescription& study, const StudyPoint& point, const StudyRun& run) {
    io::Node document;
    if (run.scenario.empty()) {
        document = io::typed_value(study.file, "{}");
        io::set_key(document, "name=\"" + run.name + "\"", study.file);
        io::set_key(document, "maneuver.name=\"" + run.maneuver + "\"", study.file);
        io::set_key(document, "vehicle=\"of the study\"", study.file);
    } else {
        document = io::read_toml(run.scenario);
    }
    for (const std::string& assignment : run.set) io::set_key(document, assignment, study.file);
    for (const std::string& assignment : assignments(study, point, run.name)) {
        io::set_key(document, assignment, study.file);
    }
    ScenarioDescription scenario = io::read_scenario(document);
    scenario.vehicle = study.vehicle;
    return scenario;
}

std::vector<std::string> vehicle_set(const StudyDescription& study, const StudyPoint& point) {
    return assignments(study, point, "vehicle");
}

std::optional<RunResult> evaluate(const StudyDescription& study, const StudyPoint& point, const StudyRun& run,
                                  const std::function<bool()>& keep_going) {
    try {
        std::optional<RunResult> result = run_point(study, point, run, keep_going);
        if (result && !run.figures.empty()) {
            std::erase_if(result->figures,
                          [&](const Figure& figure) { return std::ranges::count(run.figures, figure.name) == 0; });
        }
        return result;
    } catch (const std::exception& error) {  // of this variant alone
        return RunResult{.figures = {}, .passed = {}, .failed = error.what()};
    }
}

void check_point(const StudyDescription& study, const StudyPoint& point) {
    const VehicleDescription vehicle = vehicle_of(study, point);
    for (const StudyRun& run : study.runs) {
        if (!run.analysis.empty()) continue;
        const ScenarioDescription scenario = scenario_of(study, point, run);
        if (scenario.maneuver.name.empty()) {
            select_channels(all_channels(vehicle), scenario.output.channels, scenario.places);
        } else {
            settings_of(maneuver_of(scenario), vehicle, scenario);
        }
    }
}

}  // namespace hamilcar
