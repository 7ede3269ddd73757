// What a standard maneuver is: settings with their default values, a way to drive it, and what it finds out.
//
//     settings ─► TestRun ─► scenarios with a driver ─► Drive: recorded channels ─► Outcome: figures, verdicts, diagrams
//
// A maneuver is one file and one line in list.cpp. It knows the vehicle by its description, as every other module does.
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
#include "hamilcar/run/validity_warning.hpp"

namespace hamilcar {

// number: any between its limits; whole: counts; flag: yes or no; choice: one of its words. Words go by the numbers that stand for
// them, too.
enum class SettingKind { number, whole, flag, choice };

struct Choice {
    std::string word;  // "left"
    double number;     // that stands for it
};

// What a person may choose.
struct Setting {
    std::string name;  // "speed"
    std::string unit;  // as typed: "km/h", "deg", "m/s^2"; "" without
    std::string meaning;
    double default_value;  // the standard's, where it has one
    double min = 0, max = 1;
    SettingKind kind = SettingKind::number;
    std::vector<Choice> choices = {};  // of a flag too
};
Setting flag_setting(std::string name, std::string meaning, bool default_value);
Setting choice_setting(std::string name, std::string meaning, std::vector<Choice> choices,
                       std::string_view default_choice);

// A characteristic value; NaN where the run did not show it.
struct Figure {
    std::string name, unit, meaning;
    double value;
};
// A gradient over lateral acceleration [X/(m/s^2)] as it is often told, in X/g; nothing for other figures.
std::optional<Figure> per_g(const Figure& figure);

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

// Where a maneuver's energy went, and whether the account balances.
struct EnergyBalance {
    double supplied = 0;    // by engines, or by the prescribed torque [J]
    double stored = 0;      // gained by the car, kinetic and potential [J]
    double dissipated = 0;  // in tires, brakes, dampers, air and driveline, and what the steering took [J]
    double residual() const { return supplied - stored - dissipated; }
    double exchanged = 0;  // what the residual is to be compared with: energy moved in all [J]
    bool is_kept = true;   // the solver integrated the account along
    double error() const { return account_error(residual(), is_kept); }  // [J]

    EnergyBalance& operator+=(const EnergyBalance& other);
};

// What kept a drive from its end: somebody said stop, the vehicle tipped over, or the mathematics gave up, which says nothing
// of the vehicle.
enum class Stopped { no, interrupted, fell_over, numerical };

struct Outcome {
    std::vector<Figure> figures;
    std::vector<Verdict> verdicts;
    std::vector<io::Chart> charts;          // the test's own diagrams
    Course course;                          // empty where there is none
    std::vector<io::PageRun> runs;          // what was driven, for replay and plots; the last is the one that counts
    std::vector<std::string> notes;         // for a person: what could not be done, and what was reached
    EnergyBalance energy;                   // of all runs together
    std::vector<ValidityWarning> validity;  // where the drives that count went beyond the ranges of models
    std::optional<std::string> failed;      // the maneuver could not be driven: why, with what was reached
    Stopped stopped = Stopped::no;          // where that was an interruption, or the mathematics

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
    RoadDescription road;                           // the maneuver may put its own obstacles on it
    std::vector<std::string> controllers_off = {};  // kinds that the vehicle goes without, as in a scenario
    bool steering_mechanics = false;                // the rack moves on its own
    bool keep_runs = true;                          // rows for replay and plots
    std::vector<std::string> channels = {};         // of these rows, names or prefixes with '*'; empty: the default set
    std::function<bool(double)> keep_going = [](double) { return true; };  // told the share done; false: stop
};

class TestRun;

struct Maneuver {
    std::string name;      // as typed: "double_lane_change"
    std::string title;     // "Double lane change"
    std::string standard;  // "ISO 3888-1"
    std::string summary;   // one sentence
    // Default values may depend on the vehicle.
    std::function<std::vector<Setting>(const VehicleDescription&)> settings;
    // Why this vehicle cannot do it, or nothing.
    std::function<std::string(const VehicleDescription&)> unsupported_reason = [](const auto&) { return ""; };
    std::function<void(TestRun&)> run;
    // The cones and lines alone, for the simulator; empty where there is none.
    std::function<Course(const VehicleDescription&, const Settings&)> course = [](const auto&, const auto&) {
        return Course{};
    };

    // With complete settings. Throws io::Error: bad_file for settings that contradict each other, numerical where there is no
    // steady state to start from.
    Outcome drive(const VehicleDescription& vehicle, const Settings& complete, const ManeuverOptions& options) const;
};

// "speed_km_per_h": a setting's key in a scenario file.
std::string setting_key(const Setting& setting);
// Of its unit to SI: pi / 180 for degrees, 0.01 for percent.
double setting_factor(const Setting& setting);
// What can be chosen: "20 to 250 [km/h]", "a whole number, 1 to 20", "'yes' or 'no'", "'left' or 'right'".
std::string setting_range(const Setting& setting);
// As a person would type it: "left", "80".
std::string setting_text(const Setting& setting, double value);
// By its name or its key; throws io::Error(bad_file), with what there is, for a name that is none.
const Setting& setting_called(const std::string& name, const std::vector<Setting>& known, const std::string& maneuver);

// All of them, in the order of the documentation.
const std::vector<Maneuver>& maneuvers();
const Maneuver* find_maneuver(const std::string& name);
// The same. Throws io::Error(bad_file), with what there is, for a name that is none.
const Maneuver& require_maneuver(const std::string& name);
// Throws io::Error(bad_file) with the reason for a vehicle that cannot do it.
void require_support(const Maneuver& maneuver, const VehicleDescription& vehicle);

// With words as the numbers that stand for them, by the names as they were typed. Throws io::Error(bad_file) for a setting that
// does not exist, and for a word that it does not have.
Settings settings_in_numbers(const Maneuver& maneuver, const VehicleDescription& vehicle, const TypedSettings& typed);
// Those chosen, by their names, whichever of its two spellings each came in. Throws io::Error(bad_file) for one that does not
// exist, came in both spellings or cannot have this value, naming the setting, the range and the unit.
Settings chosen_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen);
// The default settings with those put in. Throws likewise.
Settings complete_settings(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& chosen);

}  // namespace hamilcar
