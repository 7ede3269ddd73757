// `hamilcar`: run a scenario, run the paper's case, check a file, measure the speed. A skin: no physics here.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <new>

#include "commands.hpp"
#include "hamilcar/engine/library.hpp"
#include "hamilcar/io/spelling.hpp"

namespace {

using hamilcar::io::ExitCode;
namespace cli = hamilcar::cli;

// CLI11 only says that a word is missing; the mistyped command and the nearest one help more.
std::string mistyped_command(int argc, char** argv) {
    static constexpr std::string_view commands[] = {"run",        "paper", "check", "bench", "equilibrium",
                                                    "kinematics", "modes", "tire",  "road",  "schema"};
    if (argc < 2 || argv[1][0] == '-') return {};
    for (const std::string_view command : commands) {
        if (command == argv[1]) return {};
    }
    const auto nearest = hamilcar::io::nearest_word(argv[1], commands);
    return fmt::format("unknown command '{}': expected {}{}", argv[1], hamilcar::io::quoted_list(commands),
                       nearest ? fmt::format("; did you mean '{}'?", *nearest) : "");
}

void add_common(CLI::App& command, cli::Options& options) {
    command.add_flag("--json", options.json, "print the facts as one JSON object on standard output");
}

int parse_failure(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    if (error.get_exit_code() == 0) {  // --help, --version
        return app.exit(error);
    }
    const std::string mistyped = mistyped_command(argc, argv);
    fmt::print(stderr, "hamilcar: {}\nTry 'hamilcar --help'.\n", mistyped.empty() ? error.what() : mistyped);
    return static_cast<int>(ExitCode::usage);
}

int run_command(int argc, char** argv) {
    CLI::App app{
        "Hamilcar simulates wheeled vehicles with their real suspension linkages.\n"
        "Exit codes: 0 ok, 1 criterion not met, 2 usage, 3 bad file, 4 numerical failure, 5 input/output, 130 "
        "interrupted"};
    app.set_version_flag("--version", [] {
        return fmt::format("hamilcar " HAMILCAR_VERSION "\nengine: {}", hamilcar::best_engine().instruction_set);
    });
    app.require_subcommand(1);
    cli::Options options;
    auto* run = app.add_subcommand("run", "run a scenario and write its results as CSV and netCDF");
    run->add_option("scenario", options.file, "scenario file (TOML)")->required();
    run->add_option("-o,--output", options.output, "folder for the results [out/NAME]");
    auto* paper = app.add_subcommand("paper", "run the paper's case and write its tables and figures");
    paper->add_option("scenario", options.file, "another scenario file than the paper's");
    paper->add_option("-o,--output", options.output, "folder for the results [out/paper]");
    auto* check = app.add_subcommand("check", "validate a vehicle or scenario file and print what it describes");
    check->add_option("file", options.file, "vehicle or scenario file (TOML)")->required();
    check->add_option("-o,--output", options.output, "file for the report, instead of standard output");
    auto* bench = app.add_subcommand("bench", "measure how fast this machine steps a car, alone and in batches");
    bench->add_option("vehicle", options.file, "another vehicle file than the shipped car's");
    bench->add_option("--seconds", options.seconds, "about how long to measure [20]")->check(CLI::Range(0.1, 3600.0));
    auto* equilibrium = app.add_subcommand("equilibrium", "find where a vehicle stands, drives straight or goes round");
    auto* kinematics = app.add_subcommand("kinematics", "move every axle through bump, roll and steer");
    auto* modes = app.add_subcommand("modes", "linearize a vehicle exactly; frequencies, damping, shapes, responses");
    for (auto* command : {equilibrium, kinematics, modes}) {
        command->add_option("vehicle", options.file, "vehicle file (TOML)")->required();
    }
    for (auto* command : {equilibrium, modes}) {
        command->add_option("--speed", options.speed, "forward speed [m/s]; at rest if left out")
            ->check(CLI::Range(0.0, 100.0));
        command->add_option("--lateral-acceleration", options.lateral_acceleration, "to the left [m/s^2]")
            ->check(CLI::Range(-30.0, 30.0));
    }
    kinematics->add_option("--travel", options.travel, "of the wheels, each way [80 mm]")
        ->check(CLI::Range(1.0, 1000.0));
    for (auto* command : {kinematics, modes}) {
        command->add_option("-o,--output", options.output, "folder for tables and pictures");
    }
    auto* tire = app.add_subcommand("tire", "print a tire file's curves, key figures and what it leaves open");
    tire->add_option("file", options.file, "tire property file (.tir)")->required();
    tire->add_option("-o,--output", options.output, "folder for tables and pictures");
    auto* road = app.add_subcommand("road", "show how rough a scenario's road is, or write it as an OpenCRG file");
    road->add_option("scenario", options.file, "scenario file (TOML)")->required();
    road->add_option("--length", options.length, "of road, from x = 0 on [400 m]")->check(CLI::Range(10.0, 20000.0));
    road->add_option("-o,--output", options.output, "OpenCRG file (.crg) to write");
    auto* schema = app.add_subcommand("schema", "print the JSON Schema of vehicle or scenario files, for editors");
    schema->add_option("kind", options.file, "vehicle or scenario")
        ->required()
        ->check(CLI::IsMember({"vehicle", "scenario"}));
    schema->add_option("-o,--output", options.output, "file for the schema, instead of standard output");
    for (auto* command : {run, paper, check, bench, equilibrium, kinematics, modes, tire, road})
        add_common(*command, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return parse_failure(app, error, argc, argv);
    }
    cli::watch_interrupt();
    if (run->parsed()) return static_cast<int>(cli::run(options));
    if (paper->parsed()) return static_cast<int>(cli::paper(options));
    if (schema->parsed()) return static_cast<int>(cli::schema(options));
    if (bench->parsed()) return static_cast<int>(cli::bench(options));
    if (equilibrium->parsed()) return static_cast<int>(cli::equilibrium(options));
    if (kinematics->parsed()) return static_cast<int>(cli::kinematics(options));
    if (modes->parsed()) return static_cast<int>(cli::modes(options));
    if (tire->parsed()) return static_cast<int>(cli::tire(options));
    if (road->parsed()) return static_cast<int>(cli::road(options));
    return static_cast<int>(cli::check(options));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run_command(argc, argv);
    } catch (const hamilcar::io::Error& error) {
        fmt::print(stderr, "hamilcar: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "hamilcar: out of memory\n");
        return static_cast<int>(ExitCode::numerical);
    } catch (const std::exception& error) {
        fmt::print(stderr, "hamilcar: unexpected: {}\n", error.what());
        return static_cast<int>(ExitCode::failed);
    }
}
