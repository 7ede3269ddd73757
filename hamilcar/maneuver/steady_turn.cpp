#include "hamilcar/maneuver/steady_turn.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/maneuver/runs.hpp"

namespace hamilcar {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<double> column(const std::vector<SteadyTurn>& states, const std::function<double(const SteadyTurn&)>& of) {
    std::vector<double> out;
    for (const SteadyTurn& state : states) out.push_back(of(state));
    return out;
}

io::Chart chart(const std::string& title, const std::string& y_label, const std::vector<double>& x,
                std::vector<double> y) {
    return {.title = title,
            .x_label = "lateral acceleration [m/s^2]",
            .y_label = y_label,
            .curves = {{.label = title, .x = x, .y = std::move(y), .points = true}}};
}

// f and s of y = f base + s x + q x^2 + k x^3 by least squares, for x up to `most`; with x^4 where points are many.
std::array<double, 2> fit_from_zero(std::span<const double> base, std::span<const double> x, std::span<const double> y,
                                    double most) {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (std::abs(x[i]) <= most && std::isfinite(y[i])) used.push_back(i);
    }
    constexpr Eigen::Index many = 20;
    const auto rows = static_cast<Eigen::Index>(used.size()), terms = rows >= many ? Eigen::Index{5} : Eigen::Index{4};
    if (rows <= terms) return {none, none};
    Eigen::MatrixXd regressors(rows, terms);
    Eigen::VectorXd right(rows);
    for (Eigen::Index row = 0; row < rows; ++row) {
        const std::size_t i = used[static_cast<std::size_t>(row)];
        regressors(row, 0) = base[i];
        for (Eigen::Index k = 1; k < terms; ++k) {
            regressors(row, k) = (k == 1 ? 1 : regressors(row, k - 1)) * x[i] / most;  // of order one
        }
        right[row] = y[i];
    }
    const Eigen::VectorXd fit = regressors.colPivHouseholderQr().solve(right);
    return {fit[0], fit[1] / most};
}

}  // namespace

SteadyTurn steady_turn(const History& history, double from, double to) {
    const auto mean = [&](const std::vector<double>& values) { return mean_over(history, values, from, to); };
    const bool felt = history.steering_torque.size() == history.size();
    const double speed = mean(history.speed);
    return {.time = (from + to) / 2,
            .speed = speed,
            .yaw_rate = mean(history.yaw_rate),
            .acceleration = mean(history.lateral_acceleration),
            .steering_wheel = mean(history.steering_wheel),
            .torque = felt ? mean(history.steering_torque) : none,
            .roll = mean(history.roll),
            .sideslip = std::atan2(mean(history.lateral_velocity), speed)};
}

bool SteadyTurn::settled() const {
    constexpr double alike = 0.03, slow = 0.1;  // share of the acceleration; and while all grows slowly [m/s^2]
    return std::abs(lateral_acceleration() - acceleration) <= alike * std::abs(acceleration) + slow;
}

void delay(Stairs& stairs, double by) {
    for (std::size_t i = 1; i < stairs.signal.time.size(); ++i) stairs.signal.time[i] += by;
    for (double& end : stairs.rests) end += by;
}

Stairs stairs(const std::vector<double>& levels, const std::function<double(std::size_t)>& ramp, double rest) {
    Stairs out;
    out.signal.interpolation = Interpolation::linear;
    double time = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        for (const double at : {time, time + rest}) {
            out.signal.time.push_back(at), out.signal.value.push_back(levels[i]);
        }
        out.rests.push_back(time + rest);
        time += rest + (i + 1 < levels.size() ? ramp(i) : 0);
    }
    return out;
}

std::optional<int> steady_gear(const VehicleDescription& vehicle, double radius) {
    constexpr double lively = 1.5;  // lateral acceleration at which it is that for straight driving [m/s^2]
    if (is_heavy(vehicle)) return std::nullopt;
    return gear_for(vehicle, std::sqrt(lively * radius));
}

TurningGeometry turning_geometry(const VehicleDescription& vehicle) {
    constexpr double slow = 10;  // [m/s]; geometry is the same at any speed
    const SteadyHandling handling = steady_handling(vehicle, slow);
    return {handling.steering_ratio, handling.wheelbase};
}

double beginning_slope(std::span<const double> x, std::span<const double> y, double most) {
    const std::vector<double> ones(x.size(), 1);
    return fit_from_zero(ones, x, y, most)[1];
}

std::vector<double> local_slopes(std::span<const double> x, std::span<const double> y, double half_width) {
    std::vector<double> out;
    for (const double at : x) {
        std::vector<double> near_x, near_y;
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (std::abs(x[i] - at) <= half_width) near_x.push_back(x[i]), near_y.push_back(y[i]);
        }
        constexpr std::size_t least = 3;
        const bool alike = near_x.empty() || std::ranges::max(near_x) - std::ranges::min(near_x) < 0.5 * half_width;
        out.push_back(near_x.size() < least || alike ? none : fitted_line(near_x, near_y).slope);
    }
    return out;
}

Understeer understeer_of(const SteadyTest& test, const std::vector<SteadyTurn>& states) {
    const auto a = column(states, &SteadyTurn::lateral_acceleration),
               curvature = column(states, &SteadyTurn::curvature);
    const auto angle = column(states, [](const SteadyTurn& s) { return s.steering_wheel; });
    if (test.fixed_wheel) {
        const auto [per_curvature, gradient] = fit_from_zero(curvature, a, angle, test.small);
        return {per_curvature, gradient};
    }
    const double base = test.geometry.angle_per_curvature();
    const auto beyond = column(states, [base](const SteadyTurn& s) { return s.steering_wheel - base * s.curvature(); });
    return {base, beginning_slope(a, beyond, test.small)};
}

void evaluate(const SteadyTest& test, const std::vector<SteadyTurn>& states, Outcome& outcome) {
    const std::vector<double> a = column(states, &SteadyTurn::lateral_acceleration);
    const Understeer understeer = understeer_of(test, states);
    const auto in_degrees = [&](const std::function<double(const SteadyTurn&)>& of) {
        return scaled(column(states, of), 1 / degree);
    };
    const std::vector<double> angle = in_degrees([](const SteadyTurn&s) { return s.steering_wheel; }),
                              roll = in_degrees([](const SteadyTurn&s) { return s.roll; }),
                              sideslip = in_degrees([](const SteadyTurn&s) { return s.sideslip; }),
                              torque = column(states, [](const SteadyTurn&s) { return s.torque; }),
                              beyond = in_degrees([&](const SteadyTurn&s) {
                                  return s.steering_wheel - understeer.angle_per_curvature * s.curvature();
                              });
    const auto slope = [&](const std::vector<double>& y) { return beginning_slope(a, y, test.small); };
    const double gradient = understeer.gradient / degree;
    if (!std::isfinite(gradient)) {
        outcome.notes.push_back(
            fmt::format("too few steady states up to {:g} m/s^2 for gradients: choose smaller steps", test.small));
    }
    outcome.figures.push_back({"understeer gradient", "deg/(m/s^2)",
                               "of the steering wheel's angle beyond geometry, at small lateral acceleration",
                               gradient});
    outcome.figures.push_back({"understeer gradient of the wheels", "deg/(m/s^2)", "the same over the steering ratio",
                               gradient / test.geometry.steering_ratio});
    outcome.figures.push_back({"roll gradient", "deg/(m/s^2)", "roll angle over lateral acceleration", slope(roll)});
    outcome.figures.push_back({"sideslip gradient", "deg/(m/s^2)",
                               "sideslip angle of the center of mass over lateral acceleration", slope(sideslip)});
    const double felt = slope(torque);
    if (std::isfinite(felt)) {
        outcome.figures.push_back({"steering torque gradient", "N m/(m/s^2)", "of the hands, without assist", felt});
    }
    io::Chart steering = chart("steering wheel angle", "steering wheel angle [deg]", a, angle);
    const double per_curvature = test.geometry.angle_per_curvature() / degree;
    steering.curves.push_back({.label = "by geometry", .x = a, .y = column(states, [&](const SteadyTurn& s) {
                                                                   return per_curvature * s.curvature();
                                                               })});
    outcome.charts.push_back(std::move(steering));
    outcome.charts.push_back(
        chart("understeer gradient", "gradient [deg/(m/s^2)]", a, local_slopes(a, beyond, test.half_width)));
    outcome.charts.push_back(chart("roll angle", "roll angle [deg]", a, roll));
    outcome.charts.push_back(chart("sideslip angle", "sideslip angle [deg]", a, sideslip));
    if (std::isfinite(felt)) outcome.charts.push_back(chart("steering torque", "steering torque [N m]", a, torque));
}

double largest_lateral_acceleration(const History& history, const std::function<bool(std::size_t)>& counts) {
    constexpr double window = 1, alike = 0.03;  // [s]; share by which force and turning may differ
    double largest = 0, force = 0, turning = 0;
    std::size_t first = 0;
    const auto add = [&](std::size_t i, double sign) {
        force += sign * history.lateral_acceleration[i];
        turning += sign * history.speed[i] * history.yaw_rate[i];
    };
    for (std::size_t i = 0; i < history.size(); ++i) {
        if (!counts(i)) {
            first = i + 1, force = turning = 0;
            continue;
        }
        add(i, 1);
        for (; history.time[i] - history.time[first] > window; ++first) add(first, -1);
        const bool full = history.time[i] - history.time[first] > 0.9 * window;
        if (!full || std::abs(turning - force) > alike * std::abs(force)) continue;
        largest = std::max(largest, std::abs(force) / static_cast<double>(i - first + 1));
    }
    return largest;
}

void finish_steady(Outcome& outcome, Trial trial, std::size_t states) {
    constexpr std::size_t least = 6;  // of a fit
    if (trial.ended) outcome.notes.push_back("end of the test: " + *trial.ended);
    if (add_trial(outcome, std::move(trial)) && states < least) {
        outcome.failed = fmt::format("only {} steady states were reached, {} are needed", states, least);
    }
}

}  // namespace hamilcar
