// `hamilcar`: the list of its commands, and what becomes of an error. A skin: no physics here.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include "command.hpp"
#include "commands.hpp"
#include "event_report.hpp"
#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/engine/engines.hpp"
#include "interrupt.hpp"
#include "progress.hpp"

namespace {

namespace cli = hamilcar::cli;
using hamilcar::io::ExitCode;

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const hamilcar::Engine* one : hamilcar::engines()) names.emplace_back(one->name);
    return names;
}

std::string version() {
    return fmt::format("hamilcar " HAMILCAR_VERSION "\nengines: {}", fmt::join(engine_names(), ", "));
}

void choose_engine(const std::string& name) {
    try {
        hamilcar::choose_default_engine(name);
    } catch (const std::invalid_argument& unknown) {
        throw hamilcar::io::Error(ExitCode::usage, std::string("--engine: ") + unknown.what());
    }
}

ExitCode run_command(int argc, char** argv) {
    cli::CommandList list(
        "Hamilcar simulates wheeled vehicles with their real suspension linkages.\n"
        "Exit codes: 0 ok, 1 criterion not met, 2 usage, 3 bad file, 4 numerical failure, 5 input/output or memory, "
        "6 internal error, 130 interrupted",
        version);
    std::string engine;
    bool quiet = false, verbose = false;
    list.add("--engine", engine, "what runs the equations, of those that --version lists [the fastest]")
        .suggest(engine_names());
    list.add("-q,--quiet", quiet, "print nothing but errors");
    list.add("-v,--verbose", verbose, "tell on standard error what is read, compiled and spent");
    for (cli::AddCommand* add : cli::add_commands) add(list);
    ExitCode code = ExitCode::ok;
    if (!list.parse(argc, argv, code)) return code;
    if (quiet && verbose)
        throw hamilcar::io::Error(ExitCode::usage, "--quiet: expected either this or --verbose, not both");
    const cli::EventReport events(verbose);
    if (quiet) {
        cli::hide_progress();
        if (!std::freopen("/dev/null", "w", stdout)) return ExitCode::input_output;
    }
    if (!engine.empty()) choose_engine(engine);
    if (!hamilcar::refused_engines().empty()) {
        fmt::print(stderr, "hamilcar: {}: the portable engine runs instead, which is slower\n",
                   hamilcar::refused_engines());
    }
    cli::end_on_interrupt();
    return list.run();
}

// Every way that a command can end has its exit code; that of a criterion that was not met is none of them.
ExitCode guarded(int argc, char** argv) {
    try {
        return run_command(argc, argv);
    } catch (const hamilcar::io::Error& error) {
        cli::tell(error.what());
        return error.code();
    } catch (const hamilcar::NoSolution& missing) {
        cli::tell(missing.what());
        return ExitCode::numerical;
    } catch (const std::bad_alloc&) {
        cli::tell("out of memory");
        return ExitCode::input_output;
    } catch (const std::system_error& error) {
        if (std::ferror(stdout) == 0) cli::tell(error.what());  // else it is said once all is over
        return ExitCode::input_output;
    } catch (const std::exception& error) {
        cli::tell(fmt::format("internal error, a fault of hamilcar's own; please report it: {}", error.what()));
        return ExitCode::internal;
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (!cli::take_standard_streams()) {
        cli::tell("standard output is closed: expected a terminal, a file, a pipe or /dev/null");
        return static_cast<int>(ExitCode::input_output);
    }
    const ExitCode code = guarded(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return static_cast<int>(code);
    cli::tell(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
    return static_cast<int>(code > ExitCode::failed ? code : ExitCode::input_output);
}
