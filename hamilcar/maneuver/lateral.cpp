#include "hamilcar/maneuver/lateral.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/linear_model.hpp"
#include "hamilcar/maneuver/runs.hpp"
#include "hamilcar/steering/column.hpp"
#include "hamilcar/vehicle/build.hpp"

namespace hamilcar {

namespace {

constexpr double heavy = 3500;                              // [kg]
constexpr double spacing = 0.01;                            // of tables [s]
constexpr double speed_tolerance = 2 * kilometer_per_hour;  // ISO 7401's

}  // namespace

bool is_heavy(const VehicleDescription& vehicle) {
    return Vehicle<double>(vehicle).total_mass > heavy;
}

Setting speed_setting(const VehicleDescription& vehicle, double usual, double usual_heavy) {
    constexpr double least = 20, most = 250;  // [km/h]
    return {"speed", "km/h", "that the driver holds", is_heavy(vehicle) ? usual_heavy : usual, least, most};
}

Setting acceleration_setting(const VehicleDescription& vehicle, double usual, double usual_heavy,
                             const std::string& meaning) {
    constexpr double least = 0.05, most = 30;  // [m/s^2]
    return {"lateral_acceleration", "m/s^2", meaning, is_heavy(vehicle) ? usual_heavy : usual, least, most};
}

Amplitude amplitude_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration) {
    const Linearizer linearizer(vehicle);
    const Column column(vehicle.steering);
    constexpr double less = 0.85, least_share = 0.05;
    for (double share = 1; share > least_share; share *= less) {
        const double tried = share * lateral_acceleration;
        const OperatingPoint at = linearizer.operating_point({.speed = speed, .lateral_acceleration = tried});
        if (!at.found) continue;
        Amplitude out{column.angle(at.input.rack.displacement), tried, ""};
        if (share < 1) {
            out.note = fmt::format("no steady driving at {:.3g} m/s^2 and {:.3g} km/h: {:.3g} m/s^2 instead",
                                   lateral_acceleration, speed / kilometer_per_hour, tried);
        }
        return out;
    }
    const double angle = std::min(angle_for(vehicle, speed, lateral_acceleration), steering_lock(vehicle));
    return {angle, lateral_acceleration,
            "no steady driving was found: the steering wheel's angle is that of linear theory"};
}

ScenarioDescription steered_at(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed,
                               SignalDescription angle) {
    ScenarioDescription scenario = driving_at(vehicle, options, speed, angle.time.back());
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = std::move(angle);
    return scenario;
}

SignalDescription tabulated(const std::function<double(double)>& angle, double duration) {
    SignalDescription out;
    const auto points = static_cast<std::size_t>(std::lround(duration / spacing));
    for (std::size_t i = 0; i <= points; ++i) {
        out.time.push_back(static_cast<double>(i) * spacing);
        out.value.push_back(angle(out.time.back()));
    }
    return out;
}

Trial drive_share(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                  const ManeuverOptions& options, double interval, Share part) {
    return drive(vehicle, scenario,
                 {.interval = interval, .film = options.keep_runs, .keep_going = share(options, part.from, part.to)});
}

Trial drive_aimed(const VehicleDescription& vehicle, const Aim& aim, double angle, const ManeuverOptions& options,
                  double interval, Outcome& outcome) {
    constexpr int tries = 3;
    constexpr double good = 0.02, most = 1.5;  // share of what is wanted; of an angle that is tried next over the last
    const double lock = steering_lock(vehicle);
    for (int i = 1;; ++i) {
        const Share part{1 - std::pow(0.5, i - 1), i < tries ? 1 - std::pow(0.5, i) : 1};
        Trial trial = drive_share(vehicle, aim.scenario(angle), options, interval, part);
        if (trial.stopped != Stopped::no) return trial;
        const double better = aim.lateral_acceleration / aim.reached(trial.history);
        const double next = std::min(angle * std::clamp(better, 1 / most, most), lock);
        if (i == tries || !(std::abs(better - 1) > good) || next == angle) return trial;
        add_search_trial(outcome, trial);
        angle = next;
    }
}

Series series_of(const History& history, const std::vector<double>& column) {
    const std::size_t last = history.size() - 1;
    const double rate = last == 0 ? 1 : static_cast<double>(last) / (history.time[last] - history.time[0]);
    return {column, rate, history.time[0]};
}

double mean_over(const History& history, const std::vector<double>& column, double from, double to) {
    double sum = 0, count = 0;
    for (std::size_t i = row_at(history, from); i < history.size() && history.time[i] <= to; ++i) {
        sum += column[i], ++count;
    }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> sideslip_of(const History& history) {
    std::vector<double> out;
    for (std::size_t i = 0; i < history.size(); ++i) out.push_back(history.sideslip(i));
    return out;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double& value : values) value *= factor;
    return values;
}

Verdict speed_held(const History& history, double wanted, double from, double to) {
    double farthest = 0;
    for (std::size_t i = row_at(history, from); i < history.size() && history.time[i] <= to; ++i) {
        farthest = std::max(farthest, std::abs(history.speed[i] - wanted));
    }
    return {fmt::format("speed within 2 km/h of {:.4g} km/h from {:.3g} s to {:.3g} s", wanted / kilometer_per_hour,
                        from, to),
            farthest <= speed_tolerance, fmt::format("{:.2g} km/h off", farthest / kilometer_per_hour)};
}

}  // namespace hamilcar
