#include "hamilcar/maneuver/straight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hamilcar::straight {

double total_mass(const VehicleDescription& vehicle) {
    double mass = vehicle.chassis.mass;
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        for (const SuspensionBodyDescription& body : suspension.bodies) mass += body.body.mass;
    }
    for (const TrailerDescription& trailer : vehicle.trailers) mass += trailer.chassis.mass;
    return mass;
}

bool is_heavy(const VehicleDescription& vehicle) {
    constexpr double limit = 3500;  // [kg]
    return total_mass(vehicle) > limit;
}

std::vector<Axle> axles(const VehicleDescription& vehicle) {
    constexpr double one_place = 0.2;  // wheels within that are on one axle [m]
    std::vector<Axle> out;
    std::size_t number = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        const double x = wheel.wheel.center[0];
        const auto same = [&](const Axle& a) { return std::abs(a.x - x) < one_place && a.of_trailer == (unit > 0); };
        auto axle = std::ranges::find_if(out, same);
        if (axle == out.end()) {
            const std::string name = wheel.name.substr(0, wheel.name.find_last_of('_'));
            axle = out.insert(out.end(), Axle{name, {}, x, unit > 0});
        }
        axle->wheels.push_back(number++);
    });
    std::ranges::stable_sort(out, [](const Axle& a, const Axle& b) { return a.x > b.x; });
    for (std::size_t i = 0; i < out.size(); ++i) out[i].name = fmt::format("axle {} ({})", i + 1, out[i].name);
    return out;
}

double full_brake_force(const VehicleDescription& vehicle) {
    double force = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        force += wheel.brake.max_torque / casing_of(wheel.tire).rolling_radius;
    });
    return force;
}

void follow_straight_line(ScenarioDescription& scenario, const VehicleDescription& vehicle, double length) {
    if (vehicle.steering.rack_per_revolution <= 0) return;
    constexpr double behind = 20, apart = 50;  // points of the line [m]
    scenario.driver.steering.emplace();
    auto& points = scenario.driver.steering->path.points;
    for (double x = -behind; x < length + apart; x += apart) points.push_back({x, 0});
}

TrialOptions trial_options(const ManeuverOptions& options, double from, double to) {
    TrialOptions out;
    out.film = options.keep_runs;
    out.keep_going = [keep_going = options.keep_going, from, to](double done) {
        return keep_going(from + (to - from) * std::clamp(done, 0.0, 1.0));
    };
    return out;
}

Trial drive_again_finely(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                         const TrialOptions& options) {
    Trial trial = drive(vehicle, scenario, options);
    if (trial.stopped != Stopped::numerical) return trial;
    ScenarioDescription finer = scenario;
    finer.solver.step /= 4;
    trial = drive(vehicle, finer, options);
    trial.complaints.push_back(fmt::format("the step of {:g} s was too long for this vehicle: driven with {:g} s",
                                           scenario.solver.step, finer.solver.step));
    return trial;
}

Series series(const History& history, const std::vector<double>& values) {
    const double interval = history.size() > 1 ? history.time[1] - history.time[0] : 1;
    return {values, 1 / interval, history.time[0]};
}

std::vector<double> distance(const History& history) {
    std::vector<double> out(history.size(), 0);
    for (std::size_t i = 1; i < out.size(); ++i) {
        out[i] = out[i - 1] + std::hypot(history.x[i] - history.x[i - 1], history.y[i] - history.y[i - 1]);
    }
    return out;
}

std::vector<double> ground_speed(const History& history) {
    std::vector<double> out;
    for (std::size_t i = 0; i < history.size(); ++i) {
        out.push_back(std::hypot(history.speed[i], history.lateral_velocity[i]));
    }
    return out;
}

void keep_rows(Trial& trial, std::size_t count) {
    History& h = trial.history;
    const auto keep = [&](std::vector<double>& rows) { rows.resize(std::min(rows.size(), count)); };
    for (auto* rows : {&h.time,
                       &h.steering_wheel,
                       &h.steering_torque,
                       &h.x,
                       &h.y,
                       &h.yaw,
                       &h.speed,
                       &h.lateral_velocity,
                       &h.yaw_rate,
                       &h.roll,
                       &h.pitch,
                       &h.longitudinal_acceleration,
                       &h.lateral_acceleration,
                       &h.seat_x,
                       &h.seat_y,
                       &h.seat_z,
                       &h.drive_torque,
                       &h.throttle,
                       &h.brake,
                       &h.gear,
                       &h.unit_speed}) {
        keep(*rows);
    }
    for (auto* wheels : {&h.wheel_load, &h.wheel_speed, &h.wheel_x, &h.wheel_y}) std::ranges::for_each(*wheels, keep);
    std::ranges::for_each(trial.film.values, keep);
}

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> scaled(const std::vector<double>& values, double factor) {
    std::vector<double> out(values);
    for (double& value : out) value *= factor;
    return out;
}

std::vector<double> thinned(const std::vector<double>& values, std::size_t most) {
    const std::size_t every = std::max<std::size_t>(1, values.size() / most);
    std::vector<double> out;
    for (std::size_t i = 0; i < values.size(); i += every) out.push_back(values[i]);
    return out;
}

}  // namespace hamilcar::straight
