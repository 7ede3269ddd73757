// Rolling out in neutral: from the times between speeds the resistance F = F0 + F1 v + F2 v^2 (ISO 10521-1, SAE J1263), and
// what of it the air and the tires of the vehicle's file account for.
//
//     F(v_i) = m_r 2 d / (t(v_i - d) - t(v_i + d)),    m_r: with the turning wheels
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/pull.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar {

namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
constexpr double settling = 1;  // after the start, until the body has found its place in the air's drag [s]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = straight::is_heavy(vehicle);
    return {
        {"from", "km/h", "highest speed that is evaluated", heavy ? 80.0 : 120.0, 40, 250},
        {"to", "km/h", "lowest speed that is evaluated", 20, 10, 200},
        {"step", "km/h", "between two reference speeds, over each of which it is timed", 5, 1, 20},
    };
}

std::string obstacle(const VehicleDescription&) {
    return "";
}

// The speed to start from, so that the highest one that is evaluated comes only after the body has settled: by what the
// vehicle's file makes of the resistance, which settling hardly changes.
double head_start(const VehicleDescription& vehicle, double from) {
    constexpr double ahead = 1.02;    // of the highest speed, at least
    constexpr double reserve = 1.25;  // of the way down to it
    const double deceleration = straight::resistance(vehicle, ahead * from).sum() / straight::rolling_mass(vehicle);
    return ahead * from + reserve * settling * std::max(deceleration, 0.0);
}

// In neutral; nobody brakes, and the steering is held.
ScenarioDescription rolling_out(const VehicleDescription& vehicle, const ManeuverOptions& options, double from,
                                double to) {
    constexpr double least = 0.08;  // deceleration that rolling tires make sure of [m/s^2]
    const double start = head_start(vehicle, from);
    ScenarioDescription scenario = driving_at(vehicle, options, start, settling + (start - to) / least);
    scenario.name = "coast_down";
    scenario.driver.speed.reset();
    if (scenario.driver.shifting) scenario.driver.shifting->gear = 0;
    constexpr double beyond = 0.5;  // below the last speed, so that it is passed [m/s]
    scenario.driver.ending.speed_below = to - beyond;
    return scenario;
}

struct Resistances {
    std::vector<double> speed, force;  // [m/s], [N]
};

// By the times between speeds.
Resistances measured(const Series& speed, double mass, double from, double to, double step) {
    Resistances out;
    for (double v = from - step / 2; v - step / 2 > to - 1e-9; v -= step) {
        const auto begin = first_crossing(speed, v + step / 2, Crossing::falling, settling);
        const auto end = first_crossing(speed, v - step / 2, Crossing::falling, settling);
        if (!begin || !end) continue;
        out.speed.push_back(v), out.force.push_back(mass * step / (*end - *begin));
    }
    return out;
}

// F0 [N], F1 [N s/m], F2 [N s^2/m^2] by least squares.
Eigen::Vector3d fitted(const Resistances& resistances) {
    const auto n = static_cast<Eigen::Index>(resistances.speed.size());
    const Eigen::Map<const Eigen::VectorXd> v(resistances.speed.data(), n), F(resistances.force.data(), n);
    Eigen::MatrixXd powers(n, 3);
    powers << Eigen::VectorXd::Ones(n), v, v.cwiseAbs2();
    return powers.colPivHouseholderQr().solve(F);
}

double at(const Eigen::Vector3d& f, double v) {
    return f[0] + v * (f[1] + v * f[2]);
}

void add_figures(Outcome& outcome, const VehicleDescription& vehicle, const Resistances& resistances,
                 const Eigen::Vector3d& f, double time) {
    const double weight = straight::total_mass(vehicle) * vehicle.gravity;
    const double density = vehicle.aerodynamics.air_density;
    const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning, double value) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    add("coast-down time", "s", "from the highest to the lowest speed that was asked for", time);
    add("F0", "N", "of F = F0 + F1 v + F2 v^2", f[0]);
    add("F1", "N s/m", "likewise", f[1]);
    add("F2", "N s^2/m^2", "likewise", f[2]);
    add("rolling resistance", "%", "F0 over the weight", f[0] / weight * 100);
    add("drag area", "m^2", "2 F2 over the density of the air", density > 0 ? 2 * f[2] / density : nowhere);
    add("drag area of the file", "m^2", "", vehicle.aerodynamics.drag_area);
    double worst = 0;
    for (const double share : {0.0, 0.5, 1.0}) {  // lowest, middle and highest reference speed
        const double v = std::lerp(resistances.speed.back(), resistances.speed.front(), share);
        const straight::Resistance file = straight::resistance(vehicle, v);
        const std::string name = fmt::format("{:.1f} km/h", v / kilometer_per_hour);
        add("resistance at " + name, "N", "by the fit", at(f, v));
        add("of the file at " + name, "N", "air by its area, the rest by what holds the speed in the linear model",
            file.sum());
        worst = std::max(worst, std::abs(at(f, v) / file.sum() - 1));
    }
    add("largest difference of these", "%", "of the file's", 100 * worst);
}

void add_charts(Outcome& outcome, const VehicleDescription& vehicle, const History& history,
                const Resistances& resistances, const Eigen::Vector3d& f) {
    io::Chart rolling{"Speed",
                      "time [s]",
                      "speed [km/h]",
                      {{"", straight::thinned(history.time),
                        straight::thinned(straight::scaled(history.speed, 1 / kilometer_per_hour))}}};
    io::Chart forces{"Resistance", "speed [km/h]", "force [N]", {}};
    const std::vector<double> speed = straight::scaled(resistances.speed, 1 / kilometer_per_hour);
    std::vector<double> fit, air, all;
    const double rest = straight::resistance(vehicle, resistances.speed.back()).rest;  // hardly changes with the speed
    for (const double v : resistances.speed) {
        fit.push_back(at(f, v)), air.push_back(straight::air_resistance(vehicle, v)), all.push_back(air.back() + rest);
    }
    forces.curves.push_back({"timed", speed, resistances.force, true});
    forces.curves.push_back({"F0 + F1 v + F2 v^2", speed, fit});
    forces.curves.push_back({"air, by the file", speed, air});
    forces.curves.push_back({"air and tires, by the file", speed, all});
    outcome.charts.push_back(std::move(rolling)), outcome.charts.push_back(std::move(forces));
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    const double from = chosen.at("from") * kilometer_per_hour, to = chosen.at("to") * kilometer_per_hour;
    const double step = chosen.at("step") * kilometer_per_hour;
    constexpr double fewest = 4;  // steps that three unknowns are fitted to
    if (from - to < fewest * step) {
        throw io::Error(
            io::ExitCode::bad_file,
            fmt::format("settings of maneuver 'coast_down': from {:g} to {:g} km/h are fewer than {:g} steps of "
                        "{:g} km/h",
                        chosen.at("from"), chosen.at("to"), fewest, chosen.at("step")),
            "maneuver.settings.from");
    }
    Outcome outcome;
    TrialOptions drive_options = straight::trial_options(options, 0, 1);
    drive_options.interval = 0.02;  // [s]; nothing happens fast
    Trial trial = drive(vehicle, rolling_out(vehicle, options, from, to), drive_options);
    if (!take_whole(outcome, trial)) return outcome;
    const Series speed = straight::series(trial.history, trial.history.speed);
    const Resistances resistances = measured(speed, straight::rolling_mass(vehicle), from, to, step);
    if (static_cast<double>(resistances.speed.size()) < fewest) {
        outcome.failed = fmt::format("it did not roll out: after {:.0f} s it still had {:.0f} km/h",
                                     trial.history.time.back(), trial.history.speed.back() / kilometer_per_hour);
        return outcome;
    }
    const auto begin = first_crossing(speed, from, Crossing::falling, settling),
               end = first_crossing(speed, to, Crossing::falling, settling);
    if (!begin || !end) {
        outcome.notes.push_back(
            fmt::format("not all of {:g} to {:g} km/h was driven after the first {:g} s: the highest speed that is "
                        "evaluated is {:.1f} km/h, the lowest {:.1f} km/h, and there is no time for the whole",
                        chosen.at("from"), chosen.at("to"), settling, resistances.speed.front() / kilometer_per_hour,
                        resistances.speed.back() / kilometer_per_hour));
    }
    const Eigen::Vector3d f = fitted(resistances);
    add_figures(outcome, vehicle, resistances, f, begin && end ? *end - *begin : nowhere);
    add_charts(outcome, vehicle, trial.history, resistances, f);
    return outcome;
}

}  // namespace

Maneuver coast_down() {
    return {.name = "coast_down",
            .title = "Coast-down",
            .standard = "ISO 10521-1 / SAE J1263",
            .summary = "Rolling out in neutral: the resistance over the speed.",
            .settings = settings,
            .obstacle = obstacle,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
