// `hamilcar run SCENARIO`
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "hamilcar/io/result_file.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/film.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/run/scene.hpp"
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

io::ExitCode tell(const Options& options, const RunSummary& summary, const nlohmann::json& facts) {
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

}  // namespace

io::ExitCode run(const Options& options) {
    const ScenarioDescription scenario = io::read_scenario(options.file);
    const VehicleDescription vehicle = io::read_vehicle(scenario.vehicle);
    const Recorded recorded =
        in_files(options.file, scenario.vehicle, [&] { return choose_channels(vehicle, scenario); });
    Simulation simulation = in_files(options.file, scenario.vehicle, [&] { return Simulation(vehicle, scenario); });
    const std::string name = std::filesystem::path(options.file).stem().string();
    const std::string folder = options.output.empty() ? "out/" + name : options.output;
    make_folder(folder);
    Files files(folder, scenario, recorded);
    Film film(scenario.name, recorded.scene, recorded.channels);
    PathOnGround path;

    Progress progress(name);
    const RunSummary summary = record(
        simulation, recorded.channels, scenario.output.interval,
        [&](const Sample& sample, const std::vector<double>& row) {
            files.write(sample.time, row);
            if (scenario.output.report) film.add(sample.time, row);
            if (scenario.output.motion) path.add(sample);
        },
        [&](double share) { return progress.show(share), !interrupted(); });
    progress.clear();
    files.close();
    for (const std::string& file : tire_files(simulation.vehicle())) {
        const std::size_t notes = io::read_tir(file).notes.size();
        if (notes > 0) fmt::print(stderr, "hamilcar: {}: {} remarks; 'hamilcar tire' lists them\n", file, notes);
    }
    const bool uneven = scenario.output.motion && scenario.road.is_uneven();
    const std::string report = folder + "/report.html";
    if (uneven) files.announce_road();
    if (scenario.output.report) files.add(report);
    const nlohmann::json facts = summary_json(simulation, summary, files.paths());
    write_file(folder + "/summary.json", facts.dump(2) + "\n");
    const io::ExitCode outcome = tell(options, summary, facts);

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

}  // namespace hamilcar::cli
