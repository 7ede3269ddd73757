#include "hamilcar/maneuver/braking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/butterworth.hpp"

namespace hamilcar::braking {

namespace {

constexpr double percent = 100;
constexpr double locked = 90;                               // percent of slip
constexpr double locking_counts = 15 * kilometer_per_hour;  // above it, as in UN R13-H [m/s]
constexpr LowPass instrument{.order = 4, .cutoff = 10};     // of decelerations in diagrams

std::size_t pedal_row(const History& history) {
    return row_at(history, approach);
}

// How many rows there are until it stands: then it rocks on its tires, which says nothing of the braking.
std::size_t rows_to_standstill(const History& history, const std::vector<double>& speed) {
    std::size_t row = pedal_row(history);
    while (row < history.size() && speed[row] > standing) ++row;
    return row;
}

}  // namespace

ScenarioDescription stop(const VehicleDescription& vehicle, const ManeuverOptions& options, const Use& use,
                         double deceleration) {
    constexpr double reserve = 4;       // [s]
    constexpr double suddenly = 0.005;  // from the speed to none, that the foot leaves the throttle [s]
    const double duration = approach + use.rise + use.speed / deceleration + reserve;
    ScenarioDescription scenario = driving_at(vehicle, options, use.speed, duration);
    scenario.driver.speed->speed = {
        {0, approach, approach + suddenly}, {use.speed, use.speed, 0}, Interpolation::linear};
    scenario.driver.speed->may_brake = false;
    scenario.brake = {{approach, approach + use.rise}, {0, use.pedal}, Interpolation::linear};
    if (!use.engine_drives && scenario.driver.shifting) {
        const double gear = scenario.driver.shifting->gear.value_or(1);
        scenario.driver.shifting.reset();
        scenario.gear = {{0, approach}, {gear, 0}, Interpolation::steps};
    }
    return scenario;
}

void end_at_standstill(Trial& trial) {
    constexpr double at_rest = 0.5;  // that is kept of it [s]
    const History& history = trial.history;
    const std::vector<double> speed = straight::ground_speed(history);
    const auto stands = first_crossing(straight::series(history, speed), standing, Crossing::falling, approach);
    if (!stands || history.time.back() < *stands + at_rest) return;
    straight::keep_rows(trial, row_at(history, *stands + at_rest) + 1);
}

double mean_fully_developed(const Series& speed, const Series& distance, double initial_speed) {
    const auto begin = first_crossing(speed, 0.8 * initial_speed, Crossing::falling);
    const auto end = first_crossing(speed, 0.1 * initial_speed, Crossing::falling);
    if (!begin || !end) return nowhere;
    const double way = interpolated(distance, *end) - interpolated(distance, *begin);
    return (0.64 - 0.01) * initial_speed * initial_speed / (2 * way);  // UN R13-H, with 25.92 = 2 x 3.6^2
}

std::vector<double> slip(const History& history, std::size_t wheel) {
    const std::size_t at = pedal_row(history);
    const std::vector<double>& turning = history.wheel_speed[wheel];
    const std::vector<double> speed = straight::ground_speed(history);
    const double rolling = history.speed[at] / turning[at];
    std::vector<double> out(history.size(), 0);
    for (std::size_t i = 0; i < rows_to_standstill(history, speed); ++i) {
        if (speed[i] > standing) out[i] = percent * (1 - turning[i] * rolling / speed[i]);
    }
    return out;
}

Stop evaluated(const History& history) {
    const std::vector<double> way = straight::distance(history), over_ground = straight::ground_speed(history);
    const Series speed = straight::series(history, over_ground), driven = straight::series(history, way);
    const std::size_t at = pedal_row(history);
    Stop out;
    out.initial_speed = interpolated(speed, approach);
    out.developed = mean_fully_developed(speed, driven, out.initial_speed);
    if (const auto stands = first_crossing(speed, standing, Crossing::falling, approach)) {
        const double deceleration = out.developed;  // that also takes the little speed left
        out.distance =
            interpolated(driven, *stands) - interpolated(driven, approach) + standing * standing / (2 * deceleration);
        out.time = *stands - approach + standing / deceleration;
    }
    for (std::size_t i = at; i < history.size(); ++i) {
        const double turned = history.yaw[i] - history.yaw[at];
        if (std::abs(turned) > std::abs(out.heading)) out.heading = turned;
    }
    for (std::size_t wheel = 0; wheel < history.wheel_speed.size(); ++wheel) {
        const std::vector<double> slipping = slip(history, wheel);
        double lock = nowhere;
        for (std::size_t i = at; i < history.size() && over_ground[i] > locking_counts; ++i) {
            if (std::isnan(lock) && slipping[i] > locked) lock = history.time[i] - approach;
        }
        out.lock.push_back(lock);
        for (std::size_t i = at; i < history.size(); ++i) {
            out.beside = std::max(out.beside, std::abs(history.wheel_y[wheel][i]));
        }
    }
    return out;
}

double first_lock(const straight::Axle& axle, const Stop& stop) {
    double first = nowhere;
    for (const std::size_t wheel : axle.wheels) first = std::fmin(first, stop.lock[wheel]);
    return first;
}

void add_lock_figures(Outcome& outcome, const VehicleDescription& vehicle, const Stop& stop) {
    for (const straight::Axle& axle : straight::axles(vehicle)) {
        outcome.figures.push_back({"lock of " + axle.name, "s",
                                   "from the pedal to the first wheel of it that slips by 90 percent, above 15 km/h",
                                   first_lock(axle, stop)});
    }
}

void add_charts(Outcome& outcome, const VehicleDescription& vehicle, const History& history) {
    const std::size_t rows = rows_to_standstill(history, straight::ground_speed(history));
    const auto thinned = [rows](std::vector<double> values) {
        values.resize(rows);
        return straight::thinned(values);
    };
    const std::vector<double> way = straight::distance(history);
    const std::size_t at = pedal_row(history);
    std::vector<double> from_pedal(way), time(history.time), deceleration;
    for (double& x : from_pedal) x -= way[at];
    for (double& t : time) t -= approach;
    const double rate = straight::series(history, history.speed).rate;
    deceleration = low_passed_both_ways(straight::scaled(history.longitudinal_acceleration, -1), rate, instrument);

    io::Chart speed{"Speed over distance", "distance from the pedal [m]", "speed [km/h]", {}, false, {}};
    speed.curves.push_back({"", thinned(from_pedal), thinned(straight::scaled(history.speed, 1 / kilometer_per_hour))});
    io::Chart braking{"Deceleration, below 10 Hz", "time from the pedal [s]", "deceleration [m/s^2]", {}, false, {}};
    braking.curves.push_back({"", thinned(time), thinned(deceleration)});
    io::Chart slipping{"Slip of the wheels", "time from the pedal [s]", "slip [%]", {}, false, {}};
    std::size_t wheel = 0;
    for_each_wheel(vehicle, [&](const auto& one, std::size_t) {
        slipping.curves.push_back({one.name, thinned(time), thinned(slip(history, wheel++))});
    });
    io::Chart attitude{"Pitch and heading", "time from the pedal [s]", "angle [deg]", {}, false, {}};
    attitude.curves.push_back(
        {"pitch, nose down", thinned(time), thinned(straight::scaled(history.pitch, 1 / degree))});
    attitude.curves.push_back(
        {"heading, to the left", thinned(time), thinned(straight::scaled(history.yaw, 1 / degree))});
    for (auto* chart : {&speed, &braking, &slipping, &attitude}) outcome.charts.push_back(std::move(*chart));
}

}  // namespace hamilcar::braking
