// The commands of `hamilcar`, each a function of its options; messages go to standard error, facts to standard output.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/scenario_file.hpp"

namespace hamilcar::cli {

struct Options {
    std::string file;                            // scenario, vehicle or tire; schema: of which of them
    std::vector<std::string> files;              // view: results
    std::string output;                          // -o: folder; check, schema: file
    bool json = false;                           // one JSON object on standard output
    double seconds = 20;                         // bench: about how long to measure
    double travel = 80;                          // kinematics: each way [mm]
    double length = 400;                         // road: from x = 0 on [m]
    long rows = 20000;                           // view: of each run, at most
    bool open = false;                           // view: start a browser
    bool no_browser = false;                     // drive: do not
    std::string scenario;                        // drive: where to, besides the shipped ones
    int port = 0;                                // drive: 0 is any
    std::string maneuver, vehicle;               // run: instead of a scenario; vehicle file
    std::vector<std::string> settings;           // run: of a maneuver, "speed=80"
    double step = 0;                             // run: instead of the scenario's [s]
    std::string checkpoint, resume;              // run: files
    double checkpoint_interval = 0;              // run: of simulated time [s]; 0: only at the end
    double speed = 0, lateral_acceleration = 0;  // equilibrium, modes [m/s], [m/s^2]
};

io::ExitCode run(const Options& options);
io::ExitCode run_maneuver(const Options& options);
io::ExitCode list_maneuvers(const Options& options);
io::ExitCode compare(const Options& options);
io::ExitCode paper(const Options& options);
io::ExitCode check(const Options& options);
io::ExitCode bench(const Options& options);
io::ExitCode equilibrium(const Options& options);
io::ExitCode kinematics(const Options& options);
io::ExitCode modes(const Options& options);
io::ExitCode schema(const Options& options);
io::ExitCode tire(const Options& options);
io::ExitCode road(const Options& options);
io::ExitCode view(const Options& options);
io::ExitCode drive(const Options& options);

// A file that comes with hamilcar: here, in the source or where it is installed; throws io::Error(input_output).
std::string shipped_file(const std::string& name);
// The tire property files that a vehicle's tires come from, each once.
std::set<std::string> tire_files(const VehicleDescription& vehicle);
// Creates a folder with its parents; throws io::Error(input_output).
void make_folder(const std::string& path);
// Writes a whole small file; throws io::Error(input_output).
void write_file(const std::string& path, const std::string& text);
// Where a page may go: a page that takes a result's place would be a run lost. Throws io::Error(usage).
void check_output(const std::string& path);
// Shows a file or an address in the person's browser, if there is one.
void open_in_browser(const std::string& address);
// To standard output, or where -o says.
void print_or_write(const std::string& output, const std::string& text);

// Runs `f`; an error that it throws gets its place in front: the key's in the scenario, or the vehicle's file where the
// car itself fails.
template <class F>
auto in_files(const std::string& scenario, const std::string& vehicle, F&& f) {
    try {
        return f();
    } catch (const io::Error& error) {
        const bool car = error.code() == io::ExitCode::numerical;
        throw io::Error(error.code(), (car ? vehicle : io::place_of(scenario, error.key())) + ": " + error.what());
    }
}

// True once Ctrl-C was pressed; `watch_interrupt` starts watching, and lets a file that grows beyond its limit fail like
// a full disk.
void watch_interrupt();
bool interrupted();

}  // namespace hamilcar::cli
