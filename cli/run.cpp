// `hamilcar run SCENARIO`
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/record.hpp"
#include "progress.hpp"
#include "summary.hpp"

namespace hamilcar::cli {

namespace {

// An energy balance off by more than this share of the largest kinetic energy is no simulation of the car any more.
constexpr double doubtful_share = 0.01;

struct Files {
    std::vector<std::unique_ptr<io::ResultWriter>> writers;
    std::vector<std::string> paths;
};

Files open_files(const std::string& folder, const ScenarioDescription& scenario, const std::vector<Channel>& channels) {
    std::vector<io::Column> columns;
    for (const Channel& channel : channels) columns.push_back(channel.column);
    Files files;
    if (scenario.output.csv) {
        files.paths.push_back(folder + "/results.csv");
        files.writers.push_back(io::open_csv(files.paths.back(), columns));
    }
    if (scenario.output.netcdf) {
        files.paths.push_back(folder + "/results.nc");
        files.writers.push_back(io::open_netcdf(files.paths.back(), columns, scenario.name));
    }
    return files;
}

}  // namespace

io::ExitCode run(const Options& options) {
    const ScenarioDescription scenario = io::read_scenario(options.file);
    const VehicleDescription vehicle = io::read_vehicle(scenario.vehicle);
    const auto channels = in_files(options.file, scenario.vehicle,
                                   [&] { return select_channels(all_channels(vehicle), scenario.output.channels); });
    Simulation simulation = in_files(options.file, scenario.vehicle, [&] { return Simulation(vehicle, scenario); });
    const std::string name = std::filesystem::path(options.file).stem().string();
    const std::string folder = options.output.empty() ? "out/" + name : options.output;
    make_folder(folder);
    Files files = open_files(folder, scenario, channels);

    Progress progress(name);
    constexpr long rows_per_flush = 100;  // what a crash may cost
    long rows = 0;
    const RunSummary summary = record(
        simulation, channels, scenario.output.interval,
        [&](const Sample& sample, const std::vector<double>& row) {
            for (auto& writer : files.writers) writer->write(sample.time, row);
            if (++rows % rows_per_flush == 0) {
                for (auto& writer : files.writers) writer->flush();
            }
        },
        [&](double share) { return progress.show(share), !interrupted(); });
    progress.clear();
    for (auto& writer : files.writers) writer->close();

    for (const std::string& file : tire_files(simulation.vehicle())) {
        const std::size_t notes = io::read_tir(file).notes.size();
        if (notes > 0) fmt::print(stderr, "hamilcar: {}: {} remarks; 'hamilcar tire' lists them\n", file, notes);
    }
    const nlohmann::json facts = summary_json(simulation, summary, files.paths);
    write_file(folder + "/summary.json", facts.dump(2) + "\n");
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
            summary.worst_energy_drift, summary.largest_kinetic_energy, scenario.solver.step);
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

}  // namespace hamilcar::cli
