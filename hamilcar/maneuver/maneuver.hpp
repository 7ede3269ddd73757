// What a standard maneuver is: settings with their usual values, a way to drive it, and what it finds out.
//
//     settings ─► scenarios with a driver ─► Trial: rows of the channels it asks for ─► Outcome: figures, verdicts, diagrams
//
// A maneuver is one file and one line in list.cpp. It knows the vehicle as everybody else does, by its description.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/analysis/energy_bounds.hpp"
#include "hamilcar/description/scenario.hpp"
#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/page.hpp"

namespace hamilcar {

// What numbers a setting may have: any, counts, 0 for no and 1 for yes, or 1 for the left and -1 for the right.
enum class SettingKind { number, whole, toggle, side };

// A number that a person may choose.
struct Setting {
    std::string name;  // "speed"
    std::string unit;  // as typed: "km/h", "deg", "m/s^2"; "" without
    std::string meaning;
    double usual;        // the standard's, where it has one
    double least, most;  // what can be chosen
    SettingKind kind = SettingKind::number;
};

// A characteristic value; NaN where the run did not show it.
struct Figure {
    std::string name, unit, meaning;
    double value;
};

// Pass or fail, where the standard has a limit or the driver a task: "lateral displacement at 1.07 s at least 1.83 m", found
// "2.41 m".
using io::Verdict;

// A cone on the ground, and the lines between cones that must not be crossed.
struct Gate {
    std::array<double, 2> from, to;  // x, y: a boundary, straight [m]
};
struct Course {
    std::vector<std::array<double, 2>> cones;  // x, y [m]
    std::vector<Gate> boundaries;
    std::vector<std::array<double, 2>> line;  // that the driver is to follow [m]
};

// Where a maneuver's energy went, and whether the books close.
struct EnergyBook {
    double supplied = 0;    // by engines, or by the prescribed torque [J]
    double stored = 0;      // gained by the car, kinetic and potential [J]
    double dissipated = 0;  // in tires, brakes, dampers, air and driveline, and what the steering took [J]
    double gap() const { return supplied - stored - dissipated; }
    double turnover = 0;  // what the gap is to be compared with: energy moved in all [J]
    bool is_kept = true;  // the solver integrated the account along
    double error() const { return account_error(gap(), is_kept); }  // [J]

    EnergyBook& operator+=(const EnergyBook& other);
};

// What kept a drive from its end: somebody said stop, the vehicle tipped over, or the mathematics gave up, which says nothing
// of the vehicle.
enum class Stopped { no, interrupted, fell_over, numerical };

struct Outcome {
    std::vector<Figure> figures;
    std::vector<Verdict> verdicts;
    std::vector<io::Chart> charts;      // the test's own diagrams
    Course course;                      // empty where there is none
    std::vector<io::PageRun> runs;      // what was driven, for film and plots; the last is the one that counts
    std::vector<std::string> notes;     // for a person: what could not be done, and what was reached
    EnergyBook energy;                  // of all runs together
    std::optional<std::string> failed;  // the maneuver could not be driven: why, with what was reached
    Stopped stopped = Stopped::no;      // where that was an interruption, or the mathematics

    bool passed() const {
        for (const Verdict& verdict : verdicts) {
            if (!verdict.passed) return false;
        }
        return !failed;
    }
};

using Settings = std::map<std::string, double>;  // complete, by name, as typed

// How a maneuver is to be run, besides its settings.
struct ManeuverOptions {
    SolverDescription solver;
    RoadDescription road;   // the maneuver may put its own obstacles on it
    bool keep_runs = true;  // rows for film and plots
    std::function<bool(double)> keep_going = [](double) { return true; };  // told the share done; false: stop
};

struct Maneuver {
    std::string name;      // as typed: "double_lane_change"
    std::string title;     // "Double lane change"
    std::string standard;  // "ISO 3888-1"
    std::string summary;   // one sentence
    // Usual values may depend on the vehicle.
    std::function<std::vector<Setting>(const VehicleDescription&)> settings;
    // Why this vehicle cannot do it, or nothing.
    std::function<std::string(const VehicleDescription&)> obstacle;
    std::function<Outcome(const VehicleDescription&, const Settings&, const ManeuverOptions&)> drive;
    // The cones and lines alone, for the simulator; empty where there is none.
    std::function<Course(const VehicleDescription&, const Settings&)> course;
};

// "speed_km_per_h": a setting's key in a scenario file.
std::string setting_key(const Setting& setting);
// What can be chosen: "20 to 250 [km/h]", "a whole number, 1 to 20", "0 or 1".
std::string setting_range(const Setting& setting);
// By its name or its key; throws io::Error(bad_file), with what there is, for a name that is none.
const Setting& setting_called(const std::string& name, const std::vector<Setting>& known, const std::string& maneuver);

// All of them, in the order of the documentation.
const std::vector<Maneuver>& maneuvers();
const Maneuver* find_maneuver(const std::string& name);

// Those chosen, by their names, whichever of its two spellings each came in. Throws io::Error(bad_file) for one that does not
// exist, came in both spellings or cannot have this value, naming the setting, the range and the unit.
Settings chosen_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen);
// The usual settings with those put in. Throws likewise.
Settings complete_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen);

}  // namespace hamilcar
