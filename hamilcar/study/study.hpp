// A study: one vehicle with parameters that are varied, what is run with every variant, and what is wanted of it.
//
//     STUDY.toml ─► StudyDescription ─► points ─► evaluate, each run of each point by itself ─► StudyTable ─► page, CSV, netCDF
//
// A parameter's value goes into the files as if it had been typed there (io/set_key.hpp), so that a row of the table is what
// `hamilcar run --maneuver ... --vehicle-set KEY=VALUE` gives, to the last bit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/description/places.hpp"
#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar {

enum class Sampling { full_factorial, latin_hypercube, sobol };

struct StudyParameter {
    std::string name;               // heads its column
    std::vector<std::string> keys;  // "vehicle.axle.front.spring.rate_N_per_m", "turn.road.friction": all get the value
    std::vector<std::string> values;  // as typed; empty: a range
    double min = 0, max = 0;          // of the range, in the key's unit
    std::size_t count = 0;            // levels of the range in a full factorial
};

struct StudyRun {
    std::string name;                          // heads its figures
    std::string scenario, maneuver, analysis;  // one of them: a file, a maneuver's name, "vehicle" or "kinematics"
    std::vector<std::string> set = {};         // keys of its scenario, "maneuver.settings.radius_m=40"
    std::vector<std::string> figures = {};     // that are kept; empty: all
};

enum class Want { min, max, target };
struct StudyGoal {
    std::string figure;  // "turn: roll gradient"
    Want want = Want::min;
    double target = 0;  // in the figure's unit
    double weight = 1;
};

struct StudyDescription {
    std::string name, vehicle, file;  // files by their paths
    Sampling sampling = Sampling::full_factorial;
    std::size_t points = 0;  // of what is no full factorial
    std::uint64_t seed = 1;
    std::vector<StudyParameter> parameters;
    std::vector<StudyRun> runs;
    std::vector<StudyGoal> goals;
    std::shared_ptr<const Places> places;
};

// One value of each parameter.
struct StudyPoint {
    std::vector<std::string> values;  // as typed
    std::vector<double> numbers;      // the same; NaN for words
};
std::vector<StudyPoint> points_of(const StudyDescription& study);

// What one run of one point gave.
struct RunResult {
    std::vector<Figure> figures;
    std::optional<bool> passed;  // where there is something to pass
    std::string failed;          // why there are no figures, or not all
};

// Whatever is wrong with one variant is its result; what was interrupted has none. Other threads may evaluate meanwhile.
std::optional<RunResult> evaluate(const StudyDescription& study, const StudyPoint& point, const StudyRun& run,
                                  const std::function<bool()>& keep_going);
// "KEY=VALUE" that a point sets of the vehicle.
std::vector<std::string> vehicle_set(const StudyDescription& study, const StudyPoint& point);
// What a run drives with a point, the study's vehicle named. Throws io::Error.
ScenarioDescription scenario_of(const StudyDescription& study, const StudyPoint& point, const StudyRun& run);
// Reads what every run of a point needs. Throws io::Error for keys, settings and figures that are none.
void check_point(const StudyDescription& study, const StudyPoint& point);

}  // namespace hamilcar
