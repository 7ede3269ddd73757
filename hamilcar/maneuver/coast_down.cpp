// Rolling out in neutral: from the times between speeds the resistance F = F0 + F1 v + F2 v^2 (ISO 10521-1, SAE J1263), and
// what of it the air and the tires of the vehicle's file account for.
//
//     F(v_i) = m_r 2 d / (t(v_i - d) - t(v_i + d)),    m_r: with the turning wheels
#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/pull.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/scenarios.hpp"
#include "hamilcar/math/dense.hpp"

namespace hamilcar {

namespace {

constexpr double settling = 1;  // after the start, until the body has found its place in the air's drag [s]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {
        {"from", "km/h", "highest speed that is evaluated", heavy ? 80.0 : 120.0, 40, 250},
        {"to", "km/h", "lowest speed that is evaluated", 20, 10, 200},
        {"step", "km/h", "between two reference speeds, over each of which it is timed", 5, 1, 20},
    };
}

// The speed to start from, so that the highest one that is evaluated comes only after the body has settled: by what the
// vehicle's file makes of the resistance, which settling hardly changes.
double head_start(const VehicleDescription& vehicle, double from) {
    constexpr double ahead = 1.02;    // of the highest speed, at least
    constexpr double reserve = 1.25;  // of the way down to it
    const double deceleration = resistance(vehicle, ahead * from).sum() / rolling_mass(vehicle);
    return ahead * from + reserve * settling * std::max(deceleration, 0.0);
}

// In neutral, without brakes, and the steering is held.
ScenarioDescription rolling_out(const TestRun& test) {
    constexpr double min_deceleration = 0.08;  // that rolling tires make sure of [m/s^2]
    const double start = head_start(test.vehicle, test["from"]);
    ScenarioDescription scenario = driving_at(test, start, settling + (start - test["to"]) / min_deceleration);
    scenario.driver.speed.reset();
    if (scenario.driver.shifting) scenario.driver.shifting->gear = 0;
    constexpr double beyond = 0.5;  // below the last speed, so that it is passed [m/s]
    scenario.driver.ending.speed_below = test["to"] - beyond;
    return scenario;
}

struct Resistances {
    std::vector<double> speed, force;  // [m/s], [N]
};

// By the times between speeds.
Resistances measured(const Series& speed, double mass, double from, double to, double step) {
    Resistances out;
    for (double v = from - step / 2; v - step / 2 > to - 1e-9; v -= step) {
        const auto slowing = between_levels(speed, v + step / 2, v - step / 2, Crossing::falling, settling);
        if (slowing) out.speed.push_back(v), out.force.push_back(mass * step / slowing->length());
    }
    return out;
}

// F0 [N], F1 [N s/m], F2 [N s^2/m^2] by least squares.
Eigen::Vector3d fitted(const Resistances& resistances) {
    const auto n = static_cast<Eigen::Index>(resistances.speed.size());
    const Eigen::Map<const Eigen::VectorXd> v(resistances.speed.data(), n), F(resistances.force.data(), n);
    Eigen::MatrixXd powers(n, 3);
    powers << Eigen::VectorXd::Ones(n), v, v.cwiseAbs2();
    return least_squares(powers, F);
}

double at(const Eigen::Vector3d& f, double v) {
    return f[0] + v * (f[1] + v * f[2]);
}

void add_figures(TestRun& test, const Resistances& resistances, const Eigen::Vector3d& f, double time) {
    const double weight = total_mass(test.vehicle) * test.vehicle.gravity;
    const double density = test.vehicle.aerodynamics.air_density;
    test.figure("coast-down time", "s", time, "from the highest to the lowest speed that was asked for");
    test.figure("F0", "N", f[0], "of F = F0 + F1 v + F2 v^2");
    test.figure("F1", "N s/m", f[1], "likewise");
    test.figure("F2", "N s^2/m^2", f[2], "likewise");
    test.figure("rolling resistance", "%", f[0] / weight * 100, "F0 over the weight");
    test.figure("drag area", "m^2", density > 0 ? 2 * f[2] / density : not_shown, "2 F2 over the density of the air");
    test.figure("drag area of the file", "m^2", test.vehicle.aerodynamics.drag_area);
    double worst = 0;
    for (const double share : {0.0, 0.5, 1.0}) {  // lowest, middle and highest reference speed
        const double v = std::lerp(resistances.speed.back(), resistances.speed.front(), share);
        const Resistance file = resistance(test.vehicle, v);
        const std::string name = fmt::format("{:.1f} km/h", v / kilometer_per_hour);
        test.figure("resistance at " + name, "N", at(f, v), "by the fit");
        test.figure("of the file at " + name, "N", file.sum(),
                    "air by its area, the rest by what holds the speed in the linear model");
        worst = std::max(worst, std::abs(at(f, v) / file.sum() - 1));
    }
    test.figure("largest difference of these", "%", 100 * worst, "of the file's");
}

void add_charts(TestRun& test, const Recording& recording, const Resistances& resistances, const Eigen::Vector3d& f) {
    test.chart("Speed", "time [s]", "speed [km/h]",
               {curve("", recording.time(), scaled(recording[channel::speed].values, 1 / kilometer_per_hour))});
    const std::vector<double> speed = scaled(resistances.speed, 1 / kilometer_per_hour);
    std::vector<double> fit, air, all;
    const double rest = resistance(test.vehicle, resistances.speed.back()).rest;  // hardly changes with the speed
    for (const double v : resistances.speed) {
        fit.push_back(at(f, v)), air.push_back(air_resistance(test.vehicle, v)), all.push_back(air.back() + rest);
    }
    test.chart("Resistance", "speed [km/h]", "force [N]",
               {{"timed", speed, resistances.force, true},
                {"F0 + F1 v + F2 v^2", speed, fit},
                {"air, by the file", speed, air},
                {"air and tires, by the file", speed, all}});
}

void run(TestRun& test) {
    const double from = test["from"], to = test["to"], step = test["step"];
    constexpr double fewest = 4;  // steps that three unknowns are fitted to
    if (from - to < fewest * step) {
        test.reject("from", "down to {:g} km/h these are fewer than {:g} steps of {:g} km/h", test.typed("to"), fewest,
                    test.typed("step"));
    }
    Drive drive = test.drive(rolling_out(test), {.interval = 0.02});  // [s]; nothing happens fast
    if (!test.take_whole(drive)) return;
    const Series speed = drive.recording[channel::speed];
    const Resistances resistances = measured(speed, rolling_mass(test.vehicle), from, to, step);
    if (static_cast<double>(resistances.speed.size()) < fewest) {
        return test.fail("it did not roll out: after {:.0f} s it still had {:.0f} km/h", drive.recording.end(),
                         speed.values.back() / kilometer_per_hour);
    }
    const auto whole = between_levels(speed, from, to, Crossing::falling, settling);
    if (!whole) {
        test.note(
            "not all of {:g} to {:g} km/h was driven after the first {:g} s: the highest speed that is evaluated "
            "is {:.1f} km/h, the lowest {:.1f} km/h, and there is no time for the whole",
            test.typed("from"), test.typed("to"), settling, resistances.speed.front() / kilometer_per_hour,
            resistances.speed.back() / kilometer_per_hour);
    }
    const Eigen::Vector3d f = fitted(resistances);
    add_figures(test, resistances, f, whole ? whole->length() : not_shown);
    add_charts(test, drive.recording, resistances, f);
}

}  // namespace

Maneuver coast_down() {
    return {.name = "coast_down",
            .title = "Coast-down",
            .standard = "ISO 10521-1 / SAE J1263",
            .summary = "Rolling out in neutral: the resistance over the speed.",
            .settings = settings,
            .run = run};
}

}  // namespace hamilcar
