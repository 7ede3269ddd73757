// `hamilcar`: every command with its options. A skin: no physics here.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/engine/engines.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace {

namespace cli = hamilcar::cli;
namespace io = hamilcar::io;
using io::ExitCode;

using Function = io::ExitCode (*)(const cli::Options&);

// CLI11's own range lets a NaN through.
CLI::Validator range(double least, double most) {
    const std::string bounds = fmt::format("[{:g} - {:g}]", least, most);
    return CLI::Validator(
        [=](std::string& word) {
            double value = 0;
            const bool inside = CLI::detail::lexical_cast(word, value) && value >= least && value <= most;
            return inside ? std::string() : fmt::format("Value {} not in range {}", word, bounds);
        },
        "FLOAT in " + bounds, "RANGE");
}

// The commands with the options of each.
class Commands {
public:
    Commands(CLI::App& app, cli::Options& options) : app_(app), o_(options) {
        add_runs();
        add_analyses();
        add_files();
    }

    // CLI11 only says that a word is missing; the mistyped command and the nearest one help more.
    std::string mistyped(int argc, char** argv) const {
        if (argc < 2 || argv[1][0] == '-') return {};
        std::vector<std::string_view> names;
        for (const auto& [command, function] : list_) names.push_back(command->get_name());
        if (std::ranges::find(names, argv[1]) != names.end()) return {};
        const auto nearest = io::nearest_word(argv[1], names);
        return fmt::format("unknown command '{}': expected {}{}", argv[1], io::quoted_list(names),
                           nearest ? fmt::format("; did you mean '{}'?", *nearest) : "");
    }
    io::ExitCode run() const {
        for (const auto& [command, function] : list_) {
            if (command->parsed()) return function(o_);
        }
        return io::ExitCode::usage;
    }

private:
    CLI::App& add(const char* name, Function function, const char* what) {
        list_.emplace_back(app_.add_subcommand(name, what), function);
        return *list_.back().first;
    }
    CLI::App& with_json(CLI::App& command) {
        command.add_flag("--json", o_.json, "print the facts as one JSON object on standard output");
        return command;
    }

    void add_runs() {
        auto& run = with_json(add("run", cli::run, "run a scenario and write its results as CSV, netCDF and a page"));
        auto* scenario = run.add_option("scenario", o_.file, "scenario file (TOML)");
        run.add_option("-o,--output", o_.output, "folder for the results [out/NAME]");
        auto* maneuver =
            run.add_option("--maneuver", o_.maneuver, "a standard maneuver instead ('hamilcar maneuvers')");
        maneuver->excludes(scenario);
        run.add_option("--vehicle", o_.vehicle, "vehicle file (TOML) [the scenario's; the shipped 323i]");
        run.add_option("--set", o_.settings, "a setting of the maneuver, NAME=NUMBER; may be repeated");
        run.add_option("--step", o_.step, "of the integration [s], instead of the scenario's")
            ->check(range(io::time_step.least, io::time_step.most));
        auto* checkpoint =
            run.add_option("--checkpoint", o_.checkpoint, "file that the run can be resumed from, kept up to date");
        run.add_option("--checkpoint-interval", o_.checkpoint_interval, "of simulated time [s]; else at the end")
            ->check(range(1e-6, 1e9))
            ->needs(checkpoint);
        run.add_option("--resume", o_.resume, "go on from such a file");
        auto& list = with_json(add("maneuvers", cli::list_maneuvers, "list the standard maneuvers and their settings"));
        list.add_option("vehicle", o_.file, "vehicle file (TOML) whose usual settings to show [the shipped 323i]");
        auto& compare = add("compare", cli::compare, "put the outcomes of several maneuvers on one page");
        compare.add_option("outcomes", o_.files, "folders that 'run --maneuver' wrote")->required();
        compare.add_option("-o,--output", o_.output, "the page [comparison.html]");
        compare.add_option("--rows", o_.rows, "of each drive, at most [20000]")->check(CLI::Range(100, 10000000));
        compare.add_flag("--open", o_.open, "open it in the browser");
        auto& drive = add("drive", cli::drive, "drive a vehicle in the browser: the full model in real time");
        drive.add_option("vehicle", o_.file, "vehicle file (TOML) [the shipped 323i]");
        drive.add_option("--road", o_.scenario, "scenario file (TOML) whose road and course to start on");
        drive.add_option("--port", o_.port, "on 127.0.0.1 [any]")->check(CLI::Range(0, 65535));
        drive.add_option("-o,--output", o_.output, "folder for recordings [out/drive]");
        drive.add_flag("--no-browser", o_.no_browser, "only print the address");
        auto& view = add("view", cli::view, "show results as a film with plots: one page that opens in any browser");
        view.add_option("results", o_.files, "result files (results.nc); several are compared")->required();
        view.add_option("-o,--output", o_.output, "the page [view.html or comparison.html beside the first result]");
        view.add_option("--rows", o_.rows, "of each run, at most [20000]")->check(CLI::Range(100, 10000000));
        view.add_flag("--open", o_.open, "open it in the browser");
        auto& paper = with_json(add("paper", cli::paper, "run the paper's case and write its tables and figures"));
        paper.add_option("scenario", o_.file, "another scenario file than the paper's");
        paper.add_option("-o,--output", o_.output, "folder for the results [out/paper]");
        auto& bench =
            with_json(add("bench", cli::bench, "measure how fast this machine steps a car, alone and in batches"));
        bench.add_option("vehicle", o_.file, "another vehicle file than the shipped car's");
        bench.add_option("--seconds", o_.seconds, "about how long to measure [20]")->check(range(0.1, 3600.0));
    }

    void add_analyses() {
        auto& equilibrium =
            add("equilibrium", cli::equilibrium, "find where a vehicle stands, drives straight or goes round");
        auto& kinematics = add("kinematics", cli::kinematics, "move every axle through bump, roll and steer");
        auto& modes = add("modes", cli::modes, "linearize a vehicle exactly; frequencies, damping, shapes, responses");
        for (auto* command : {&equilibrium, &kinematics, &modes}) {
            with_json(*command).add_option("vehicle", o_.file, "vehicle file (TOML)")->required();
        }
        for (auto* command : {&equilibrium, &modes}) {
            command->add_option("--speed", o_.speed, "forward speed [m/s]; at rest if left out")
                ->check(range(0.0, 100.0));
            command->add_option("--lateral-acceleration", o_.lateral_acceleration, "to the left [m/s^2]")
                ->check(range(-30.0, 30.0));
        }
        kinematics.add_option("--travel", o_.travel, "of the wheels, each way [80 mm]")->check(range(1.0, 1000.0));
        for (auto* command : {&kinematics, &modes}) {
            command->add_option("-o,--output", o_.output, "folder for tables and a page");
        }
    }

    void add_files() {
        auto& check =
            with_json(add("check", cli::check, "validate a vehicle or scenario file and print what it describes"));
        check.add_option("file", o_.file, "vehicle or scenario file (TOML)")->required();
        check.add_option("-o,--output", o_.output, "file for the report, instead of standard output");
        auto& tire =
            with_json(add("tire", cli::tire, "print a tire file's curves, key figures and what it leaves open"));
        tire.add_option("file", o_.file, "tire property file (.tir)")->required();
        tire.add_option("-o,--output", o_.output, "folder for tables and a page");
        auto& road =
            with_json(add("road", cli::road, "show how rough a scenario's road is, or write it as an OpenCRG file"));
        road.add_option("scenario", o_.file, "scenario file (TOML)")->required();
        road.add_option("--length", o_.length, "of road, from x = 0 on [400 m]")->check(range(10.0, 20000.0));
        road.add_option("-o,--output", o_.output, "OpenCRG file (.crg) to write");
        auto& program = add("program", cli::program, "what a vehicle's step comes to once it is recorded and compiled");
        program.add_option("vehicle", o_.file, "vehicle file (TOML)")->required();
        program.add_option("--c", o_.c_file, "file for the step as one C function");
        program.add_flag("--json", o_.json, "one JSON object");
        auto& schema = add("schema", cli::schema, "print the JSON Schema of vehicle or scenario files, for editors");
        schema.add_option("kind", o_.file, "vehicle or scenario")
            ->required()
            ->check(CLI::IsMember({"vehicle", "scenario"}));
        schema.add_option("-o,--output", o_.output, "file for the schema, instead of standard output");
    }

    CLI::App& app_;
    cli::Options& o_;
    std::vector<std::pair<CLI::App*, Function>> list_;
};

std::string version() {
    std::string names;
    for (const hamilcar::Engine* one : hamilcar::engines())
        names += (names.empty() ? "" : ", ") + std::string(one->name);
    return fmt::format("hamilcar " HAMILCAR_VERSION "\nengines: {}", names);
}

void choose_engine(const std::string& name) {
    try {
        hamilcar::choose_default_engine(name);
    } catch (const std::invalid_argument& unknown) {
        throw io::Error(ExitCode::usage, std::string("--engine: ") + unknown.what());
    }
}

int run_command(int argc, char** argv) {
    CLI::App app{
        "Hamilcar simulates wheeled vehicles with their real suspension linkages.\n"
        "Exit codes: 0 ok, 1 criterion not met, 2 usage, 3 bad file, 4 numerical failure, 5 input/output or memory, "
        "6 internal error, 130 interrupted"};
    app.set_version_flag("--version", version);
    std::string engine;
    app.add_option("--engine", engine, "what runs the equations, of those that --version lists [the fastest]");
    app.fallthrough();
    app.require_subcommand(1);
    cli::Options options;
    const Commands commands(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        const std::string mistyped = commands.mistyped(argc, argv);
        fmt::print(stderr, "hamilcar: {}\nTry 'hamilcar --help'.\n", mistyped.empty() ? error.what() : mistyped);
        return static_cast<int>(ExitCode::usage);
    }
    if (!engine.empty()) choose_engine(engine);
    if (!hamilcar::refused_engines().empty()) {
        fmt::print(stderr, "hamilcar: {}: the portable engine runs instead, which is slower\n",
                   hamilcar::refused_engines());
    }
    cli::end_on_interrupt();
    return static_cast<int>(commands.run());
}

// Names out of files may hold anything; what a terminal would obey is shown as '?'.
void tell(std::string message) {
    std::ranges::replace_if(
        message, [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == '\x7f'; }, '?');
    std::fputs(("hamilcar: " + message + "\n").c_str(), stderr);  // which may be full, too: nothing throws here
}

// Every way that a command can end has its exit code; that of a criterion that was not met is none of them.
int guarded(int argc, char** argv) {
    try {
        return run_command(argc, argv);
    } catch (const hamilcar::io::Error& error) {
        tell(error.what());
        return static_cast<int>(error.code());
    } catch (const hamilcar::NoSolution& missing) {
        tell(missing.what());
        return static_cast<int>(ExitCode::numerical);
    } catch (const std::bad_alloc&) {
        tell("out of memory");
        return static_cast<int>(ExitCode::input_output);
    } catch (const std::system_error& error) {
        if (std::ferror(stdout) == 0) tell(error.what());  // else it is told once all is over
        return static_cast<int>(ExitCode::input_output);
    } catch (const std::exception& error) {
        tell(fmt::format("internal error, a fault of hamilcar's own; please report it: {}", error.what()));
        return static_cast<int>(ExitCode::internal);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (!cli::take_standard_streams()) {
        tell("standard output is closed: expected a terminal, a file, a pipe or /dev/null");
        return static_cast<int>(ExitCode::input_output);
    }
    const int code = guarded(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    tell(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
    return code > static_cast<int>(ExitCode::failed) ? code : static_cast<int>(ExitCode::input_output);
}
