// `hamilcar run SCENARIO`
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "hamilcar/analysis/energy_bounds.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/io/whole_file.hpp"
#include "hamilcar/run/film.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "hamilcar/run/scene.hpp"
#include "maneuver.hpp"
#include "progress.hpp"
#include "resume.hpp"
#include "run_files.hpp"
#include "summary.hpp"

namespace hamilcar::cli {

namespace {

void write_report(const std::string& path, io::PageRun run, const Simulation& simulation, const nlohmann::json& facts) {
    io::Page page{.title = simulation.scenario().name, .subtitle = simulation.vehicle().name, .blocks = {}, .runs = {}};
    page.blocks = {io::Replay{}, io::Heading{"Summary"}, summary_table(facts)};
    page.runs.push_back(std::move(run));
    io::write_page(path, page);
}

io::ExitCode tell(const Options& options, const RunSummary& summary, const nlohmann::json& facts,
                  const std::vector<std::string>& complaints) {
    if (options.json) {
        fmt::print("{}\n", io::json_text(facts));
    } else {
        print_summary(facts);
    }
    const EnergyVerdict verdict = judge_energy(summary.worst_energy_drift, summary.turnover());
    const double step = facts["step_s"].get<double>();
    if (verdict == EnergyVerdict::doubtful) {
        fmt::print(stderr,
                   "hamilcar: warning: the energy balance is off by {:.3g} J of {:.3g} J; the step of {:g} s is too "
                   "large for this run, its results are doubtful\n",
                   summary.worst_energy_drift, summary.turnover(), step);
    }
    for (const std::string& complaint : complaints) fmt::print(stderr, "hamilcar: {}\n", complaint);
    if (summary.interrupted) {
        fmt::print(stderr, "hamilcar: interrupted at t = {:.3f} s; the results so far are kept\n", summary.duration);
        return io::ExitCode::interrupted;
    }
    if (summary.ended_early) {
        fmt::print(stderr, "hamilcar: {}: {}\n", options.file, *summary.ended_early);
        return io::ExitCode::numerical;
    }
    if (verdict == EnergyVerdict::wrong) {
        fmt::print(
            stderr,
            "hamilcar: {}: the energy balance is off by {:.3g} J of {:.3g} J, more than {:g} %: these results are "
            "no motion of the vehicle; try a smaller step than {:g} s, or look for a number of the vehicle that "
            "is far too small or too large\n",
            options.file, summary.worst_energy_drift, summary.turnover(), 100 * EnergyBounds::wrong, step);
        return io::ExitCode::numerical;
    }
    return io::ExitCode::ok;
}

void remove_files(std::initializer_list<std::string> paths) {
    std::error_code gone_already;
    for (const std::string& path : paths) std::filesystem::remove(path, gone_already);
}

std::string output_folder(const Options& options) {
    return options.output.empty() ? "out/" + std::filesystem::path(options.file).stem().string() : options.output;
}

void tell_remarks(const VehicleDescription& vehicle) {
    for (const std::string& file : tire_files(vehicle)) {
        const std::size_t notes = io::read_tir(file).notes.size();
        if (notes > 0) fmt::print(stderr, "hamilcar: {}: {} remarks; 'hamilcar tire' lists them\n", file, notes);
    }
}

// The rows of the first part once more, then those from where the simulation stands to the end of the scenario.
RunSummary record_run(const Options& options, const FirstPart& before, const Recorded& recorded, Simulation& simulation,
                      RunFiles& files, Film& film, PathOnGround& path, Keeper& keeper) {
    const OutputDescription& output = simulation.scenario().output;
    const auto keep = [&](double time, std::span<const double> row) {
        files.write(time, row);
        if (output.report) film.add(time, row);
    };
    std::vector<double> row(recorded.channels.size());
    for (std::size_t i = 0; i < before.count; ++i) {
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = before.rows.values[k + 1][i];
        keep(before.rows.values[0][i], row);
        if (interrupted()) {
            throw io::Error(io::ExitCode::interrupted,
                            "interrupted before the run went on; what is there stays as it was");
        }
    }
    files.take_place();
    Progress progress(std::filesystem::path(options.file).stem().string());
    const RunSummary summary = record(
        simulation, recorded.channels, output.interval,
        [&](const Sample& sample, const std::vector<double>& values) {
            keep(sample.time, values);
            if (output.motion) path.add(sample);
        },
        [&](double share, const RunSummary& so_far) {
            keeper.look(simulation, so_far, path, files);
            return progress.show(share), !interrupted();
        },
        before.progressed.summary);
    files.close();
    return summary;
}

io::ExitCode run_scenario(const Options& options, const ScenarioDescription& scenario, const Recorded& recorded,
                          Simulation& simulation) {
    const std::string folder = output_folder(options);
    const io::FolderLock lock = take_folder(folder);
    const std::string report = folder + "/report.html", told = folder + "/summary.json";
    for (const std::string& path : {report, told, folder + "/results.nc", folder + "/results.csv"}) {
        io::expect_writable_place(path);  // before anything of an earlier run goes
    }
    const bool may_resume = !options.checkpoint.empty() || !options.resume.empty();
    const Origin origin = may_resume ? origin_of(options.file, scenario.vehicle) : Origin{};
    const FirstPart before = first_part(options, folder, scenario, recorded, simulation, origin);
    Keeper keeper(options, simulation, before.progressed, origin);
    if (options.resume.empty()) remove_files({report, told});
    const InterruptWatch watch;
    RunFiles files(folder, scenario, recorded,
                   options.resume.empty() ? RunFiles::Place::taken : RunFiles::Place::beside);
    Film film(scenario.name, recorded.scene, recorded.channels);
    PathOnGround path{before.progressed.x, before.progressed.y};
    const RunSummary summary = record_run(options, before, recorded, simulation, files, film, path, keeper);
    tell_remarks(simulation.vehicle());
    const bool uneven = scenario.output.motion && scenario.road.is_uneven();
    if (uneven) files.announce_road();
    if (scenario.output.report) files.add(report);
    const nlohmann::json facts = summary_json(simulation, summary, files.paths());
    write_file(told, io::json_text(facts) + "\n");
    const bool kept = keeper.finish(simulation, summary, path);
    const io::ExitCode outcome = tell(options, summary, facts, simulation.complaints());

    // Pictures last: if the disk takes no more of them, all that matters has been said and written.
    const std::vector<RoadTile> tiles =
        tiles_along(simulation.model().road, uneven ? simulation.surface().get() : nullptr, path.x, path.y);
    files.write_road(tiles);
    if (scenario.output.report) {
        io::PageRun film_of_run = film.take();
        film_of_run.tiles = tiles;
        write_report(report, std::move(film_of_run), simulation, facts);
    }
    return kept ? outcome : io::ExitCode::input_output;
}

}  // namespace

io::ExitCode run(const Options& options) {
    if (!options.maneuver.empty()) return run_maneuver(options);
    if (options.file.empty()) {
        throw io::Error(io::ExitCode::usage, "run: expected a scenario file, or --maneuver NAME");
    }
    ScenarioDescription scenario = io::read_scenario(options.file);
    if (!options.vehicle.empty()) scenario.vehicle = options.vehicle;
    if (!scenario.maneuver.name.empty()) return run_maneuver(scenario, options);
    if (!options.settings.empty()) {
        throw io::Error(io::ExitCode::usage, "run: --set belongs to a maneuver; " + options.file + " asks for none");
    }
    check_can_resume(options, scenario);
    if (options.step > 0) scenario.solver.step = options.step;
    const VehicleDescription vehicle = in_files(
        options.file, scenario.vehicle, [&] { return as_driven(io::read_vehicle(scenario.vehicle), scenario); });
    const Recorded recorded =
        in_files(options.file, scenario.vehicle, [&] { return choose_channels(vehicle, scenario); });
    Simulation simulation = in_files(options.file, scenario.vehicle, [&] { return Simulation(vehicle, scenario); });
    return run_scenario(options, scenario, recorded, simulation);
}

}  // namespace hamilcar::cli
