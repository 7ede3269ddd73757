// Over a single cleat, all wheels of an axle at once: how hard it knocks on the seat and on the wheels, and how long the
// vehicle goes on swinging.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/ride.hpp"

namespace hamilcar {

namespace {

constexpr double approach = 1.5;  // driven before the first wheel comes to the cleat [s]
constexpr double swinging = 3;    // watched after the last one [s]
constexpr double counted = 2;     // from the first contact on, that r.m.s. values are taken over [s]
constexpr double millimeter = 1e-3;

std::vector<Setting> settings(const VehicleDescription&) {
    return {
        {"speed", "km/h", "over the cleat", 40, 5, 150},
        {"height", "mm", "of the cleat; negative: a pothole", 25, -150, 150},
        {"length", "mm", "of the cleat along the road", 100, 10, 5000},
        {"ramp", "mm", "of its edges, within the length", 50, 5, 500},
    };
}

std::string obstacle(const VehicleDescription&) {
    return "";
}

// Where the cleat begins [m].
double cleat_start(double speed, const std::vector<straight::Axle>& axles) {
    return approach * speed + axles.front().x;
}

// A ramp is over in no time: several steps on it, each a whole part of a millisecond, so that rows fall on steps [s].
double step_for(const Settings& chosen, double step) {
    constexpr double steps = 8;
    const double ramp = std::min(chosen.at("ramp"), chosen.at("length") / 2) * millimeter;
    const double wanted = ramp / (chosen.at("speed") * kilometer_per_hour) / steps;
    constexpr double interval = 1e-3, finest = 10;  // [s]; parts of it
    return std::min(step, interval / std::clamp(std::ceil(interval / wanted), 1.0, finest));
}

ScenarioDescription over_the_cleat(const VehicleDescription& vehicle, const Settings& chosen,
                                   const ManeuverOptions& options, const std::vector<straight::Axle>& axles) {
    const double speed = chosen.at("speed") * kilometer_per_hour;
    const double crossing = (axles.front().x - axles.back().x) / speed;
    ScenarioDescription scenario =
        driving_at(vehicle, ride::with_fine_step(options), speed, approach + crossing + swinging);
    scenario.name = "cleat";
    scenario.solver.step = step_for(chosen, scenario.solver.step);
    ObstacleDescription cleat;
    cleat.start = cleat_start(speed, axles);
    cleat.length = chosen.at("length") * millimeter;
    cleat.height = chosen.at("height") * millimeter;
    cleat.ramp = std::min(chosen.at("ramp") * millimeter, cleat.length / 2);
    scenario.road.obstacles.push_back(cleat);
    return scenario;
}

// When an axle's wheels stand above a place [s].
double passing(const History& history, const straight::Axle& axle, double x) {
    const auto at =
        first_crossing(straight::series(history, history.wheel_x[axle.wheels.front()]), x, Crossing::rising);
    return at.value_or(std::numeric_limits<double>::quiet_NaN());
}

// After `from`: how long until the seat keeps within a tenth of the largest knock.
double decay(const History& history, double level, double from) {
    constexpr double small = 0.1;
    double largest = 0, last = from;
    for (const double a : history.seat_z) largest = std::max(largest, std::abs(a - level));
    for (std::size_t i = row_at(history, from); i < history.size(); ++i) {
        if (std::abs(history.seat_z[i] - level) > small * largest) last = history.time[i];
    }
    return last - from;
}

void add_load_figures(Outcome& outcome, const History& history, const std::vector<straight::Axle>& axles,
                      double first) {
    constexpr double before = 0.5;     // of smooth road, that stands for rest [s]
    const double clear = first - 0.1;  // ahead of the tires' patch [s]
    for (const straight::Axle& axle : axles) {
        const double rest = ride::loads(history, axle, clear - before, clear).mean;
        const ride::Loads loads = ride::loads(history, axle, clear, history.time.back());
        outcome.figures.push_back(
            {"largest load of " + axle.name, "%", "of a wheel, of its load before", 100 * loads.most / rest});
        outcome.figures.push_back(
            {"least load of " + axle.name, "%", "likewise; 0: it leaves the road", 100 * loads.least / rest});
    }
}

void add_charts(Outcome& outcome, const History& history, const std::vector<straight::Axle>& axles, double first) {
    constexpr std::size_t detailed = 4000;  // rows of a diagram: knocks are short
    const auto thinned = [](const std::vector<double>& values) { return straight::thinned(values, detailed); };
    std::vector<double> time(history.time);
    for (double& t : time) t -= first;
    io::Chart seat{"Acceleration on the seat", "time from the first contact [s]", "acceleration [m/s^2]", {}};
    seat.curves.push_back({"vertical", thinned(time), thinned(history.seat_z)});
    seat.curves.push_back({"longitudinal", thinned(time), thinned(history.seat_x)});
    io::Chart load{"Wheel loads", "time from the first contact [s]", "load [N]", {}};
    for (const straight::Axle& axle : axles) {
        load.curves.push_back({axle.name, thinned(time), thinned(history.wheel_load[axle.wheels.front()])});
    }
    io::Chart pitch{"Pitch",
                    "time from the first contact [s]",
                    "angle [deg]",
                    {{"", thinned(time), thinned(straight::scaled(history.pitch, 1 / degree))}}};
    for (auto* chart : {&seat, &load, &pitch}) outcome.charts.push_back(std::move(*chart));
}

void add_seat_figures(Outcome& outcome, const History& history, double first, double last) {
    const double level = straight::mean(ride::between(history, history.seat_z, 0, first - 0.1));
    const Series z = straight::series(history, history.seat_z), x = straight::series(history, history.seat_x);
    const auto up = peak(z, Extreme::highest, first - 0.1), down = peak(z, Extreme::lowest, first - 0.1);
    const auto ahead = peak(x, Extreme::largest, first - 0.1);
    outcome.figures.push_back(
        {"peak acceleration upward", "m/s^2", "on the seat, not filtered", up ? up->value - level : 0});
    outcome.figures.push_back({"peak acceleration downward", "m/s^2", "likewise", down ? level - down->value : 0});
    outcome.figures.push_back(
        {"peak acceleration along x", "m/s^2", "likewise, with its sign", ahead ? ahead->value : 0});
    ride::add_figures(outcome, ride::felt(history, first - 0.1, std::min(first + counted, history.time.back())));
    outcome.figures.push_back({"decay", "s",
                               "from the last contact until the seat keeps within a tenth of the largest value",
                               decay(history, level, last)});
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const std::vector<straight::Axle> axles = straight::axles(vehicle);
    const ScenarioDescription scenario = over_the_cleat(vehicle, chosen, options, axles);
    Trial trial = drive(vehicle, scenario, ride::trial_options(options));
    ride::thin_out(trial.film, trial.history);
    const bool whole = take_whole(outcome, trial);
    const double start = scenario.road.obstacles.back().start;
    const double first = passing(trial.history, axles.front(), start);
    const double last = passing(trial.history, axles.back(), start);
    if (std::isnan(first) || std::isnan(last)) {
        if (whole) outcome.failed = "it did not come over the cleat";
        return outcome;
    }
    add_seat_figures(outcome, trial.history, first, last);
    add_load_figures(outcome, trial.history, axles, first);
    add_charts(outcome, trial.history, axles, first);
    return outcome;
}

}  // namespace

Maneuver cleat() {
    return {.name = "cleat",
            .title = "Ride over a cleat",
            .standard = "ISO 2631-1 (weightings)",
            .summary =
                "All wheels over a single cleat at a steady speed: knocks on seat and wheels, and how they die away.",
            .settings = settings,
            .obstacle = obstacle,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
