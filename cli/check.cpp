// `hamilcar check FILE`: validates, assembles, and counts.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "hamilcar/analysis/freedom.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "maneuver.hpp"

namespace hamilcar::cli {

namespace {

ScenarioDescription standing_still(const std::string& vehicle_path) {
    ScenarioDescription scenario;
    scenario.name = "check";
    scenario.vehicle = vehicle_path;
    scenario.duration = scenario.solver.step;
    return scenario;
}

// Loads of a suspension's wheels on the road, wheel by wheel [N].
nlohmann::json loads(const Sample& sample, std::size_t number) {
    nlohmann::json out = nlohmann::json::array();
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

// The paper's way of counting, which has one body a suspension; null for a vehicle of other shape.
nlohmann::json table_2(const Structure& counted) {
    if (counted.bodies != 1 + static_cast<int>(counted.suspensions.size()) || counted.hitch_freedoms > 0)
        return nullptr;
    int constraints = 0;
    nlohmann::json rows = nlohmann::json::array();
    for (const ConstraintRow& row : paper_table_2(counted, false)) {
        rows.push_back({{"what", row.what}, {"constraints", row.constraints}});
        constraints += row.constraints;
    }
    return {{"coordinates", 7 * counted.bodies}, {"constraints", constraints}, {"rows", rows}};
}

// What the vehicle's tire files leave open, each file's once.
nlohmann::json tire_notes(const VehicleDescription& vehicle) {
    nlohmann::json notes = nlohmann::json::array();
    for (const std::string& file : tire_files(vehicle)) {
        for (const std::string& note : io::read_tir(file).notes) notes.push_back(note);
    }
    return notes;
}

// `recorded`: the vehicle whose channels are told.
nlohmann::json describe(const Simulation& simulation, const VehicleDescription& recorded, const std::string& file) {
    const Structure counted = structure(simulation.model().vehicle, simulation.vehicle());
    const Sample sample = simulation.sample();
    nlohmann::json suspensions = nlohmann::json::array();
    for (std::size_t i = 0; i < counted.suspensions.size(); ++i) {
        const SuspensionStructure& suspension = counted.suspensions[i];
        const LoopReport loop =
            inspect_loops(simulation.model(), sample.input.rack, simulation.state(), static_cast<int>(i));
        suspensions.push_back({{"name", suspension.name},
                               {"suspension", suspension.suspension},
                               {"tree_joints", suspension.joints},
                               {"cut_joints", suspension.cuts},
                               {"independent", suspension.independent},
                               {"dependent", suspension.dependent},
                               {"cut_equations", suspension.cut_equations},
                               {"opening_m", loop.violation},
                               {"mobility", loop.mobility},
                               {"static_load_N", loads(sample, i)}});
    }
    nlohmann::json channels = nlohmann::json::array();
    for (const Channel& channel : all_channels(recorded)) {
        channels.push_back(
            {{"name", channel.column.name}, {"unit", channel.column.unit}, {"meaning", channel.column.description}});
    }
    return {{"file", file},
            {"vehicle", simulation.vehicle().name},
            {"mass_kg", simulation.model().vehicle.total_mass},
            {"bodies", counted.bodies},
            {"coordinates", counted.coordinates},
            {"cut_equations", counted.cut_equations},
            {"degrees_of_freedom", counted.degrees_of_freedom},
            {"hitch_freedoms", counted.hitch_freedoms},
            {"wheel_spins", counted.wheel_spins},
            {"suspensions", suspensions},
            {"table_2", table_2(counted)},
            {"notes", tire_notes(simulation.vehicle())},
            {"channels", channels}};
}

std::string join(const nlohmann::json& words) {
    std::string out;
    for (const auto& word : words) out += (out.empty() ? "" : ", ") + word.get<std::string>();
    return out.empty() ? "none" : out;
}

std::string report(const nlohmann::json& facts) {
    std::string s =
        fmt::format("{}: ok\n{}, {:.1f} kg, {} bodies\n\n", facts["file"].get<std::string>(),
                    facts["vehicle"].get<std::string>(), facts["mass_kg"].get<double>(), facts["bodies"].get<int>());
    for (const auto& suspension : facts["suspensions"]) {
        std::string on_road;
        for (const auto& load : suspension["static_load_N"]) {
            on_road += fmt::format("{}{:.0f} N", on_road.empty() ? "" : " and ", load.get<double>());
        }
        s += fmt::format("{} ({}), {} on the road\n", suspension["name"].get<std::string>(),
                         suspension["suspension"].get<std::string>(), on_road);
        s += fmt::format("  tree joints   {}\n  cut joints    {}\n", join(suspension["tree_joints"]),
                         join(suspension["cut_joints"]));
        s += fmt::format("  independent   {}\n  dependent     {}\n", join(suspension["independent"]),
                         join(suspension["dependent"]));
        if (suspension["cut_equations"].get<int>() > 0) {
            s += fmt::format("  loops         closed within {:.1e} m, mobility {:.3f} (0 would be locked)\n",
                             suspension["opening_m"].get<double>(), suspension["mobility"].get<double>());
        }
    }
    for (const auto& note : facts["notes"]) s += fmt::format("\nnote: {}", note.get<std::string>());
    if (!facts["notes"].empty()) s += "\n";
    const auto& table = facts["table_2"];
    const int hitches = facts["hitch_freedoms"].get<int>();
    const std::string trailers = hitches > 0 ? fmt::format(", hitches {}", hitches) : "";
    s += fmt::format("\ncoordinates q            {} (chassis 6, suspensions {}{})\n", facts["coordinates"].get<int>(),
                     facts["coordinates"].get<int>() - 6 - hitches, trailers);
    s += fmt::format("cut constraint equations {}\n", facts["cut_equations"].get<int>());
    s += fmt::format("degrees of freedom       {} = 6 + {} independent suspension coordinates{} (and {} wheel spins)\n",
                     facts["degrees_of_freedom"].get<int>(), facts["degrees_of_freedom"].get<int>() - 6 - hitches,
                     hitches > 0 ? fmt::format(" + {} of hitches", hitches) : "", facts["wheel_spins"].get<int>());
    if (table.is_null()) return s;
    const int coordinates = table["coordinates"].get<int>(), constraints = table["constraints"].get<int>();
    s += fmt::format("counted as in the paper's Table 2: {} x 7 = {} coordinates - {} constraints = {}\n",
                     facts["bodies"].get<int>(), coordinates, constraints, coordinates - constraints);
    s += fmt::format(
        "  (with the steering driver among the constraints, as printed there, {}: but the driver's coordinate,\n"
        "   the rack q17, is not among the {}; it is prescribed and removes nothing)\n",
        coordinates - constraints - 1, coordinates);
    return s;
}

}  // namespace

io::ExitCode check(const Options& options) {
    const ScenarioDescription scenario =
        io::is_scenario(options.file) ? io::read_scenario(options.file) : standing_still(options.file);
    const VehicleDescription vehicle = io::read_vehicle(scenario.vehicle);
    if (!scenario.maneuver.name.empty()) check_maneuver(scenario, vehicle, options.file);
    in_files(options.file, scenario.vehicle,
             [&] { return select_channels(all_channels(as_driven(vehicle, scenario)), scenario.output.channels); });
    const Simulation simulation =
        in_files(options.file, scenario.vehicle, [&] { return Simulation(vehicle, scenario); });
    // A vehicle by itself stands still; others may run its power units.
    const VehicleDescription& recorded = io::is_scenario(options.file) ? simulation.vehicle() : vehicle;
    const nlohmann::json facts = describe(simulation, recorded, options.file);
    const std::string text = options.json ? io::json_text(facts) + "\n" : report(facts);
    print_or_write(options.output, text);
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
