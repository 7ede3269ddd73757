// `hamilcar run SCENARIO`
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/base/assert.hpp"
#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/io/whole_file.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/run/replay_rows.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "hamilcar/run/scene.hpp"
#include "hamilcar/run/validity_report.hpp"
#include "interrupt.hpp"
#include "maneuver.hpp"
#include "progress.hpp"
#include "resume.hpp"
#include "run_files.hpp"
#include "summary.hpp"

namespace hamilcar::cli {

namespace {

void write_page(const std::string& path, io::PageRun run, const RunReport& report) {
    io::Page page{.title = report.scenario, .subtitle = report.vehicle, .blocks = {}, .runs = {}};
    page.blocks.push_back(io::Replay{});
    add_validity(report.run.validity, page);
    page.blocks.push_back(io::Heading{"Summary"});
    page.blocks.push_back(summary_table(report));
    page.runs.push_back(std::move(run));
    io::write_page(path, page);
}

// Prints the report, as JSON if asked for, and what is wrong with the run.
io::ExitCode print(const RunOptions& options, const RunReport& report) {
    if (options.json) {
        fmt::print("{}\n", io::json_text(json_of(report)));
    } else if (!options.silent) {
        print_summary(report);
    }
    const RunSummary& summary = report.run;
    const EnergyVerdict verdict = report.energy_verdict();
    const double step = report.solver.step;
    for (const ValidityWarning& warning : summary.validity) {
        if (options.json || warning.is_numerical()) fmt::print(stderr, "hamilcar: warning: {}\n", sentence(warning));
    }
    for (const std::string& warning : report.warnings) fmt::print(stderr, "hamilcar: {}\n", warning);
    if (summary.interrupted) {
        fmt::print(stderr, "hamilcar: interrupted at t = {:.3f} s; the results so far are kept\n", summary.duration);
        return io::ExitCode::interrupted;
    }
    if (summary.ended_early) {
        fmt::print(stderr, "hamilcar: {}: {}\n", options.scenario, *summary.ended_early);
        return io::ExitCode::numerical;
    }
    if (verdict == EnergyVerdict::wrong) {
        fmt::print(
            stderr,
            "hamilcar: {}: the energy balance is off by {:.3g} J of {:.3g} J, more than {:g} %: these results are "
            "no motion of the vehicle; try a smaller step than {:g} s, or look for a number of the vehicle that "
            "is far too small or too large\n",
            options.scenario, summary.max_balance_error, summary.energy_exchanged(), 100 * EnergyBounds::wrong, step);
        return io::ExitCode::numerical;
    }
    return io::ExitCode::ok;
}

void remove_files(std::initializer_list<std::string> paths) {
    std::error_code gone_already;
    for (const std::string& path : paths) std::filesystem::remove(path, gone_already);
}

std::string output_folder(const RunOptions& options) {
    return options.output.empty() ? "out/" + std::filesystem::path(options.scenario).stem().string() : options.output;
}

void print_remark_counts(const VehicleDescription& vehicle) {
    for (const auto& [file, remarks] : tire_remarks(vehicle)) {
        if (remarks.empty()) continue;
        fmt::print(stderr, "hamilcar: {}: {} remarks; 'hamilcar tire' lists them\n", file, remarks.size());
    }
}

// The rows of the first part once more, then those from where the simulation stands to the end of the scenario.
RunSummary record_run(const RunOptions& options, const FirstPart& before, const Recorded& recorded,
                      Simulation& simulation, RunFiles& files, ReplayRows& replay, PathOnGround& path,
                      CheckpointKeeper& keeper) {
    const OutputDescription& output = simulation.scenario().output;
    const auto keep = [&](double time, std::span<const double> row) {
        files.write(time, row);
        if (output.report) replay.add(time, row);
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
    Progress progress(std::filesystem::path(options.scenario).stem().string());
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

io::ExitCode simulate(const RunOptions& options, const ScenarioDescription& scenario, const Origin& origin,
                      const Recorded& recorded, Simulation& simulation) {
    const std::string folder = output_folder(options);
    const io::FolderLock lock = take_folder(folder);
    const std::string page = folder + "/report.html", summary_file = folder + "/summary.json";
    for (const std::string& path : {page, summary_file, folder + "/results.nc", folder + "/results.csv"}) {
        io::expect_writable_place(path);  // before anything of an earlier run goes
    }
    const FirstPart before = first_part(options, folder, scenario, recorded, simulation, origin);
    CheckpointKeeper keeper(options, simulation, before.progressed, origin);
    if (options.resume.empty()) remove_files({page, summary_file});
    const InterruptWatch watch;
    RunFiles files(folder, scenario, recorded,
                   options.resume.empty() ? RunFiles::Place::taken : RunFiles::Place::beside);
    ReplayRows replay(scenario.name, recorded.scene, recorded.channels);
    PathOnGround path{before.progressed.x, before.progressed.y};
    const RunSummary summary = record_run(options, before, recorded, simulation, files, replay, path, keeper);
    print_remark_counts(simulation.vehicle());
    const bool uneven = scenario.output.motion && scenario.road.is_uneven();
    if (uneven) files.announce_road();
    if (scenario.output.report) files.add(page);
    RunReport report = report_of(simulation, summary, files.paths());
    report.vehicle_set = options.vehicle.set;
    write_file(summary_file, io::json_text(json_of(report)) + "\n");
    const bool kept = keeper.finish(simulation, summary, path);
    const io::ExitCode outcome = print(options, report);

    // Pictures last: if the disk takes no more of them, all that matters has been said and written.
    const std::vector<RoadTile> tiles =
        tiles_along(simulation.model().road, uneven ? simulation.surface().get() : nullptr, path.x, path.y);
    files.write_road(tiles);
    if (scenario.output.report) {
        io::PageRun shown = replay.take();
        shown.tiles = tiles;
        write_page(page, std::move(shown), report);
    }
    return kept ? outcome : io::ExitCode::input_output;
}

// With the file that the scenario was read from, which a checkpoint tells apart from others.
io::ExitCode run_scenario(const RunOptions& options, ScenarioDescription scenario, io::Node scenario_file) {
    if (!options.vehicle.file.empty()) scenario.vehicle = options.vehicle.file;
    if (!scenario.maneuver.name.empty()) return run_maneuver(scenario, options);
    if (!options.settings.empty()) {
        throw io::Error(io::ExitCode::usage,
                        "run: --set belongs to a maneuver; " + options.scenario + " asks for none");
    }
    if (!options.channels.empty() || options.csv || options.no_recording || options.interval) {
        throw io::Error(io::ExitCode::usage,
                        "run: --channel, --csv, --interval and --no-recording belong to a maneuver; a scenario says "
                        "what it records "
                        "in its [output]");
    }
    check_can_resume(options, scenario);
    if (options.step) scenario.solver.step = *options.step;
    io::Node vehicle_file;
    VehicleDescription described;
    io::expect_kind(scenario.vehicle, io::FileKind::vehicle, [&] {
        vehicle_file = vehicle_document({scenario.vehicle, options.vehicle.set, options.vehicle.set_by});
        described = io::read_vehicle(vehicle_file);
    });
    const VehicleDescription vehicle = as_driven(described, scenario);
    const Recorded recorded = choose_channels(vehicle, scenario);
    Simulation simulation(vehicle, scenario);
    const bool may_resume = !options.checkpoint.empty() || !options.resume.empty();
    const Origin origin = may_resume ? origin_of(std::move(scenario_file), vehicle_file) : Origin{};
    return simulate(options, scenario, origin, recorded, simulation);
}

io::ExitCode run(const RunOptions& options) {
    if (!options.maneuver.empty()) return run_maneuver(options);
    if (options.scenario.empty()) {
        throw io::Error(io::ExitCode::usage, "run: expected a scenario file, or --maneuver NAME");
    }
    io::Node scenario_file;
    ScenarioDescription scenario;
    io::expect_kind(options.scenario, io::FileKind::scenario, [&] {
        scenario_file = io::read_toml(options.scenario);
        scenario = io::read_scenario(scenario_file);
    });
    return run_scenario(options, std::move(scenario), std::move(scenario_file));
}

}  // namespace

io::ExitCode run_scenario(const RunOptions& options, const ScenarioDescription& scenario) {
    HAMILCAR_ASSERT(options.checkpoint.empty() && options.resume.empty());
    return run_scenario(options, scenario, io::Node());
}

void add_run(CommandList& list) {
    auto [command, o] =
        list.add<RunOptions>("run", "run a scenario and write its results as CSV, netCDF and a page", run);
    const Option scenario = command.add("scenario", o.scenario, "scenario file (TOML)");
    command.add("-o,--output", o.output, "folder for the results [out/NAME]");
    command.add("--maneuver", o.maneuver, "a standard maneuver instead ('hamilcar maneuvers')")
        .excludes(scenario)
        .suggest(maneuver_names());
    command.add("--vehicle", o.vehicle.file, "vehicle file (TOML) [the scenario's; the shipped 323i]");
    add_vehicle_set(command, o.vehicle);
    command.add("--set", o.settings, "a setting of the maneuver, NAME=VALUE; may be repeated");
    const Option channels =
        command.add("--channel", o.channels, "to record of a maneuver, a name or a prefix with '*'; may be repeated");
    const Option csv = command.add("--csv", o.csv, "a maneuver's recording as a table, too");
    const Option interval = command.add("--interval", o.interval, {1e-6, 1e6, "s"},
                                        "between rows of a maneuver's recording, at least; else every one is kept");
    command.add("--no-recording", o.no_recording, "figures and diagrams of a maneuver alone")
        .excludes(channels)
        .excludes(csv)
        .excludes(interval);
    command.add("--step", o.step, {io::time_step.min, io::time_step.max, "s"},
                "of the integration, instead of the scenario's");
    const Option checkpoint =
        command.add("--checkpoint", o.checkpoint, "file that the run can be resumed from, kept up to date");
    command.add("--checkpoint-interval", o.checkpoint_interval, {1e-6, 1e9, "s"}, "of simulated time, else at the end")
        .needs(checkpoint);
    command.add("--resume", o.resume, "go on from such a file");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
