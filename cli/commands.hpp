// The commands of `hamilcar`, each a function of its options; messages go to standard error, facts to standard output.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/folder_lock.hpp"
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
    std::string c_file;                          // program: the step as C
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
io::ExitCode program(const Options& options);
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
// The same for a run's results: nobody else writes there as long as the lock lives.
[[nodiscard]] io::FolderLock take_folder(const std::string& path);
// Writes a whole small file, complete or not at all; throws io::Error(input_output).
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

// What a file that is opened later must not become: a closed standard stream. False where standard output was closed.
bool take_standard_streams();

// From here on Ctrl-C, SIGTERM and a closed terminal end the program at once with ExitCode::interrupted, and a file that
// grows beyond its limit fails like a full disk.
void end_on_interrupt();

// While one lives they only set a flag instead: for a command that looks at `interrupted` several times a second, and
// keeps what it has so far. A second one ends the program all the same.
class InterruptWatch {
public:
    InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;
    ~InterruptWatch();
};
bool interrupted();

}  // namespace hamilcar::cli
