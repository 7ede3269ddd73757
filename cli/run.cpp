// `hamilcar run SCENARIO`
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "hamilcar/io/result_file.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/checkpoint.hpp"
#include "hamilcar/run/film.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "hamilcar/run/scene.hpp"
#include "maneuver.hpp"
#include "progress.hpp"
#include "summary.hpp"

namespace hamilcar::cli {

namespace {

// An energy balance off by more than this share of the largest kinetic energy is no simulation of the car any more.
constexpr double doubtful_share = 0.01;

// What a run records: the channels that were chosen, then those that a picture of the vehicle needs besides.
struct Recorded {
    std::vector<Channel> channels;
    std::size_t chosen;
    std::string scene;  // empty where no picture is wanted
};

Recorded choose_channels(const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    const std::vector<Channel> all = all_channels(vehicle);
    Recorded recorded{select_channels(all, scenario.output.channels), 0, {}};
    recorded.chosen = recorded.channels.size();
    if (!scenario.output.motion) return recorded;
    recorded.scene = scene_json(vehicle, scenario);
    add_missing_motion(all, recorded.channels);
    return recorded;
}

// The files that rows go to while the run lasts. Tables for people have the chosen channels only.
class Files {
public:
    Files(const std::string& folder, const ScenarioDescription& scenario, const Recorded& recorded)
        : chosen_(recorded.chosen) {
        std::vector<io::Column> columns;
        for (const Channel& channel : recorded.channels) columns.push_back(channel.column);
        if (scenario.output.netcdf) {
            paths_.push_back(folder + "/results.nc");
            std::error_code nothing_there;
            std::filesystem::remove(io::tiles_beside(paths_.back()), nothing_there);  // of the run that was here before
            std::vector<std::pair<std::string, std::string>> attributes;
            if (!recorded.scene.empty()) attributes.emplace_back(io::scene_attribute, recorded.scene);
            netcdf_ = io::open_netcdf(paths_.back(), columns, scenario.name, attributes);
        }
        if (scenario.output.csv) {
            paths_.push_back(folder + "/results.csv");
            columns.resize(chosen_);
            csv_ = io::open_csv(paths_.back(), columns);
        }
    }

    void write(double time, std::span<const double> row) {
        if (netcdf_) netcdf_->write(time, row);
        if (csv_) csv_->write(time, row.first(chosen_));
        constexpr long rows_per_flush = 100;  // what a crash may cost
        if (++rows_ % rows_per_flush != 0) return;
        if (netcdf_) netcdf_->flush();
        if (csv_) csv_->flush();
    }
    void close() {
        if (netcdf_) netcdf_->close();
        if (csv_) csv_->close();
    }
    // Tiles stand beside the netCDF file, whose picture needs them.
    void announce_road() {
        if (netcdf_) add(io::tiles_beside(paths_.front()));
    }
    void write_road(const std::vector<RoadTile>& tiles) const {
        if (netcdf_ && !tiles.empty()) io::write_tiles(io::tiles_beside(paths_.front()), tiles);
    }
    void add(const std::string& path) { paths_.push_back(path); }
    const std::vector<std::string>& paths() const { return paths_; }

private:
    std::size_t chosen_;
    std::unique_ptr<io::ResultWriter> netcdf_, csv_;
    std::vector<std::string> paths_;
    long rows_ = 0;
};

void write_report(const std::string& path, io::PageRun run, const Simulation& simulation, const nlohmann::json& facts) {
    io::Page page{.title = simulation.scenario().name, .subtitle = simulation.vehicle().name, .blocks = {}, .runs = {}};
    page.blocks = {io::Replay{}, io::Heading{"Summary"}, summary_table(facts)};
    page.runs.push_back(std::move(run));
    io::write_page(path, page);
}

// Where the vehicle has been, for the road that its picture needs.
struct PathOnGround {
    std::vector<double> x, y;
    void add(const Sample& sample) { x.push_back(sample.state.position()[0]), y.push_back(sample.state.position()[1]); }
};

io::ExitCode tell(const Options& options, const RunSummary& summary, const nlohmann::json& facts,
                  const std::vector<std::string>& complaints) {
    if (options.json) {
        fmt::print("{}\n", facts.dump(2));
    } else {
        print_summary(facts);
    }
    if (summary.worst_energy_drift > doubtful_share * summary.largest_kinetic_energy &&
        summary.worst_energy_drift > 1) {
        fmt::print(
            stderr,
            "hamilcar: warning: the energy balance is off by {:.3g} J of {:.3g} J; the step of {:g} s is too large "
            "for this run, its results are doubtful\n",
            summary.worst_energy_drift, summary.largest_kinetic_energy, facts["step_s"].get<double>());
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
    return io::ExitCode::ok;
}

// The rows of the first part of a run that is gone on with, from the results that it left in the folder.
struct FirstPart {
    Progressed progressed;
    io::ResultFile rows;
    std::size_t count = 0;
};

FirstPart first_part(const Options& options, const std::string& folder, const ScenarioDescription& scenario,
                     const Recorded& recorded, Simulation& simulation) {
    FirstPart part;
    if (options.resume.empty()) return part;
    part.progressed = read_checkpoint(options.resume, simulation);
    const long every = steps_per_row(simulation, scenario.output.interval);
    part.count = static_cast<std::size_t>((simulation.steps_taken() + every - 1) / every);
    const std::string results = folder + "/results.nc";
    const auto refuse = [&](const std::string& why) {
        throw io::Error(io::ExitCode::bad_file,
                        fmt::format("{}: {}; --resume goes on with the results of the run that wrote the checkpoint, "
                                    "expected them in the folder of --output",
                                    results, why));
    };
    if (!std::filesystem::exists(results)) refuse("is not there");
    part.rows = io::read_result(results);
    if (part.rows.columns.size() != recorded.channels.size() + 1) refuse("has other channels");
    if (part.rows.values[0].size() < part.count) refuse("ends before the checkpoint");
    return part;
}

// Keeps a checkpoint up to date.
class Keeper {
public:
    Keeper(const Options& options, const Simulation& simulation)
        : path_(options.checkpoint), interval_(options.checkpoint_interval), next_(simulation.time() + interval_) {}
    void look(const Simulation& simulation, const RunSummary& summary, const PathOnGround& path) {
        if (path_.empty() || interval_ <= 0 || simulation.time() < next_) return;
        next_ += interval_;
        write(simulation, summary, path);
    }
    void write(const Simulation& simulation, const RunSummary& summary, const PathOnGround& path) const {
        if (!path_.empty()) write_checkpoint(path_, simulation, {summary, path.x, path.y});
    }

private:
    std::string path_;
    double interval_, next_;
};

std::string output_folder(const Options& options) {
    return options.output.empty() ? "out/" + std::filesystem::path(options.file).stem().string() : options.output;
}

void tell_remarks(const VehicleDescription& vehicle) {
    for (const std::string& file : tire_files(vehicle)) {
        const std::size_t notes = io::read_tir(file).notes.size();
        if (notes > 0) fmt::print(stderr, "hamilcar: {}: {} remarks; 'hamilcar tire' lists them\n", file, notes);
    }
}

// From where the simulation stands to the end of the scenario.
io::ExitCode run_scenario(const Options& options, const ScenarioDescription& scenario, const Recorded& recorded,
                          Simulation& simulation) {
    const std::string folder = output_folder(options);
    make_folder(folder);
    const FirstPart before = first_part(options, folder, scenario, recorded, simulation);
    Files files(folder, scenario, recorded);
    Film film(scenario.name, recorded.scene, recorded.channels);
    PathOnGround path{before.progressed.x, before.progressed.y};
    const auto keep = [&](double time, std::span<const double> row) {
        files.write(time, row);
        if (scenario.output.report) film.add(time, row);
    };
    std::vector<double> row(recorded.channels.size());
    for (std::size_t i = 0; i < before.count; ++i) {
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = before.rows.values[k + 1][i];
        keep(before.rows.values[0][i], row);
    }
    Keeper keeper(options, simulation);
    Progress progress(std::filesystem::path(options.file).stem().string());
    const RunSummary summary = record(
        simulation, recorded.channels, scenario.output.interval,
        [&](const Sample& sample, const std::vector<double>& values) {
            keep(sample.time, values);
            if (scenario.output.motion) path.add(sample);
        },
        [&](double share, const RunSummary& so_far) {
            keeper.look(simulation, so_far, path);
            return progress.show(share), !interrupted();
        },
        before.progressed.summary);
    progress.clear();
    files.close();
    keeper.write(simulation, summary, path);
    tell_remarks(simulation.vehicle());
    const bool uneven = scenario.output.motion && scenario.road.is_uneven();
    const std::string report = folder + "/report.html";
    if (uneven) files.announce_road();
    if (scenario.output.report) files.add(report);
    const nlohmann::json facts = summary_json(simulation, summary, files.paths());
    write_file(folder + "/summary.json", facts.dump(2) + "\n");
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
    return outcome;
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
    if (options.step > 0) scenario.solver.step = options.step;
    const VehicleDescription vehicle = in_files(
        options.file, scenario.vehicle, [&] { return as_driven(io::read_vehicle(scenario.vehicle), scenario); });
    const Recorded recorded =
        in_files(options.file, scenario.vehicle, [&] { return choose_channels(vehicle, scenario); });
    Simulation simulation = in_files(options.file, scenario.vehicle, [&] { return Simulation(vehicle, scenario); });
    return run_scenario(options, scenario, recorded, simulation);
}

}  // namespace hamilcar::cli
