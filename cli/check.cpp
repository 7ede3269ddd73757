// `hamilcar check FILE`: validates, assembles, and counts.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "check_report.hpp"
#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/set_key.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "maneuver.hpp"

namespace hamilcar::cli {

namespace {

struct CheckOptions {
    VehicleChoice named;  // of a scenario too
    std::string output;
    bool json = false, structure = false, strict = false;
};

ScenarioDescription standing_still(const std::string& vehicle_path) {
    ScenarioDescription scenario;
    scenario.name = "check";
    scenario.vehicle = vehicle_path;
    scenario.duration = scenario.solver.step;
    return scenario;
}

std::vector<double> static_load(const Sample& sample, std::size_t number) {
    std::vector<double> out;
    const Suspension<double>& suspension = sample.model.vehicle.suspensions[number];
    for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
        double load = 0;
        for (int k = 0; k < suspension.wheels[i].tires; ++k) {
            load += sample.momenta.suspensions[number].wheels[i].tires[static_cast<std::size_t>(k)].tire.Fz;
        }
        out.push_back(load);
    }
    return out;
}

// Of a vehicle of the paper's shape: two struts in front, two semi-trailing arms behind, and no body besides.
std::optional<Table2> table_2(const Structure& counted) {
    const auto number_of = [&](std::string_view kind) {
        return std::ranges::count(counted.suspensions, kind, &SuspensionStructure::suspension);
    };
    const bool is_of_shape = counted.suspensions.size() == 4 && number_of("macpherson") == 2 &&
                             number_of("semi_trailing_arm") == 2 && counted.bodies == 5 && counted.hitch_freedoms == 0;
    if (!is_of_shape) return std::nullopt;
    Table2 table{.rows = paper_table_2(counted, false), .coordinates = 7 * counted.bodies};
    for (const ConstraintRow& row : table.rows) table.constraints += row.constraints;
    return table;
}

// How it stands by itself on a flat road, whatever a scenario has it do.
void add_figures(const VehicleDescription& vehicle, CheckReport& out) {
    const Linearizer linearizer(vehicle);
    const OperatingPoint rest = linearizer.operating_point({});
    if (!rest.found) throw io::Error(io::ExitCode::numerical, fmt::format("{}: {}", out.file, rest.problem));
    const std::vector<AxleReport> axles = kinematics(vehicle, {.steps = 8});
    out.figures = vehicle_figures(linearizer, rest, axles);
    const std::vector<Oddity> more = odd_figures(vehicle, out.figures, axles);
    out.oddities.insert(out.oddities.end(), more.begin(), more.end());
}

// The preloads that the file left to be found.
void add_preloads(const Simulation& simulation, std::vector<std::string>& notes) {
    const auto& suspensions = simulation.vehicle().suspensions;
    for (std::size_t s = 0; s < suspensions.size(); ++s) {
        for (std::size_t i = 0; i < suspensions[s].springs.size(); ++i) {
            const auto& [name, line, spring] = suspensions[s].springs[i];
            if (!spring.carries) continue;
            const Suspension<double>& built = simulation.model().vehicle.suspensions[s];
            const int along = built.springs[i].line.coordinate;
            const bool turns = along >= 0 && built.linkage.coordinates[static_cast<std::size_t>(along)].slides == 0;
            notes.push_back(fmt::format("{}: the spring carries its share at design with {:.1f} {}", name,
                                        spring.force_at_design, turns ? "N m" : "N"));
        }
    }
}

// `recorded`: the vehicle whose channels are listed.
CheckReport inspect(const Simulation& simulation, const VehicleDescription& recorded, const std::string& file) {
    const Structure counted = structure(simulation.model().vehicle, simulation.vehicle());
    const Sample sample = simulation.sample();
    CheckReport out{.file = file,
                    .vehicle = simulation.vehicle().name,
                    .figures = {},
                    .oddities = odd_geometry(simulation.vehicle()),
                    .counted = counted,
                    .suspensions = {},
                    .table_2 = table_2(counted),
                    .notes = {},
                    .channels = {}};
    add_figures(simulation.vehicle(), out);
    for (std::size_t i = 0; i < counted.suspensions.size(); ++i) {
        out.suspensions.push_back(
            {counted.suspensions[i],
             inspect_loops(simulation.model(), sample.input.rack, simulation.state(), static_cast<int>(i)),
             static_load(sample, i)});
    }
    add_preloads(simulation, out.notes);
    for (const auto& [tire_file, remarks] : tire_remarks(simulation.vehicle())) {
        out.notes.insert(out.notes.end(), remarks.begin(), remarks.end());
    }
    if (const auto& crg = simulation.scenario().road.crg)
        out.notes.insert(out.notes.end(), crg->remarks.begin(), crg->remarks.end());
    for (const Channel& channel : all_channels(recorded)) out.channels.push_back(channel.column);
    return out;
}

io::ExitCode check(const CheckOptions& options) {
    io::Node document;
    io::expect_kind(options.named.file, io::FileKind::vehicle, [&] { document = io::read_toml(options.named.file); });
    const bool is_scenario = io::is_scenario(document);
    if (!is_scenario) {
        for (const std::string& assignment : options.named.set) io::set_key(document, assignment, "--vehicle-set");
    }
    const ScenarioDescription scenario = is_scenario ? io::read_scenario(document) : standing_still(options.named.file);
    const VehicleDescription vehicle =
        is_scenario ? read_vehicle({scenario.vehicle, options.named.set}) : io::read_vehicle(document);
    if (!scenario.maneuver.name.empty()) check_maneuver(scenario, vehicle);
    select_channels(all_channels(as_driven(vehicle, scenario)), scenario.output.channels, scenario.places);
    // What does not even settle may have its cause here.
    const auto odd_points = odd_geometry(vehicle);
    const auto simulation = [&] {
        try {
            return std::make_unique<const Simulation>(vehicle, scenario);
        } catch (const std::exception&) {
            for (const Oddity& oddity : odd_points) fmt::print(stderr, "hamilcar: odd: {}\n", sentence(oddity));
            throw;
        }
    }();
    // A vehicle by itself stands still; others may run its power units.
    const VehicleDescription& recorded = is_scenario ? simulation->vehicle() : vehicle;
    const CheckReport report = inspect(*simulation, recorded, options.named.file);
    print_or_write(options.output,
                   options.json ? io::json_text(json_of(report)) + "\n" : text_of(report, options.structure));
    return options.strict && !report.oddities.empty() ? io::ExitCode::bad_file : io::ExitCode::ok;
}

}  // namespace

void add_check(CommandList& list) {
    auto [command, o] =
        list.add<CheckOptions>("check", "validate a vehicle or scenario file and print what it describes", check);
    command.add("file", o.named.file, "vehicle or scenario file (TOML)").required();
    add_vehicle_set(command, o.named);
    command.add("-o,--output", o.output, "file for the report, instead of standard output");
    command.add("--structure", o.structure, "joints, coordinates and degrees of freedom as well");
    command.add("--strict", o.strict, "whatever is odd about the vehicle is a mistake (exit code 3)");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
