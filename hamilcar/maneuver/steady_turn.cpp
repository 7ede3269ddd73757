#include "hamilcar/maneuver/steady_turn.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hamilcar/analysis/curves.hpp"
#include "hamilcar/analysis/handling.hpp"

namespace hamilcar {

namespace {

std::vector<double> column(const std::vector<SteadyTurn>& states, const std::function<double(const SteadyTurn&)>& of) {
    std::vector<double> out;
    for (const SteadyTurn& state : states) out.push_back(of(state));
    return out;
}

// Where the tires are worked harder: what stiffens one axle in roll takes from the gradient at first, by its camber, and adds to
// it near the limit.
void add_understeer_beyond(TestRun& test, const std::vector<double>& a, const std::vector<double>& beyond,
                           double half_width, double steering_ratio) {
    const double first = is_heavy(test.vehicle) ? 1 : 2, reach = std::max(first / 2, 2 * half_width);
    for (const double level : {first, 2 * first, 3 * first}) {
        const double gradient = slope_at(a, beyond, level, reach);
        test.figure(fmt::format("understeer gradient at {:g} m/s^2", level), "deg/(m/s^2)", gradient,
                    "of the steering wheel's angle beyond geometry");
        test.figure(fmt::format("understeer gradient of the wheels at {:g} m/s^2", level), "deg/(m/s^2)",
                    gradient / steering_ratio, "the same over the steering ratio");
    }
}

}  // namespace

SteadyTurn steady_turn(const Recording& recording, double from, double to) {
    const auto mean_of = [&](const char* channel) { return mean(between(recording[channel], from, to).values); };
    const double speed = mean_of(channel::speed);
    return {.time = (from + to) / 2,
            .speed = speed,
            .yaw_rate = mean_of(channel::yaw_rate) * degree,
            .acceleration = mean_of(channel::lateral_acceleration),
            .steering_wheel = mean_of(channel::steering_wheel),
            .torque = mean_of(channel::steering_torque),
            .roll = mean_of(channel::roll),
            .sideslip = std::atan2(mean_of(channel::lateral_speed), speed) / degree};
}

double SteadyTurn::unsteadiness() const {
    return std::abs(lateral_acceleration() - acceleration) / std::abs(acceleration);
}

bool SteadyTurn::settled() const {
    constexpr double alike = 0.03, slow = 0.1;  // share of the acceleration; and while all grows slowly [m/s^2]
    return std::abs(lateral_acceleration() - acceleration) <= alike * std::abs(acceleration) + slow;
}

Stairs stairs(const std::vector<double>& accelerations, double radius, double rest, double turning,
              const std::function<double(const std::vector<double>&, std::size_t)>& ramp) {
    Stairs out;
    for (const double a : accelerations) out.speeds.push_back(std::sqrt(radius * a));
    out.signal.interpolation = Interpolation::linear;
    out.begun = turning + std::numbers::pi / 2 * radius / out.speeds.front();
    double time = 0;
    for (std::size_t i = 0; i < out.speeds.size(); ++i) {
        out.signal.time.insert(out.signal.time.end(), {i == 0 ? 0 : time + out.begun, time + rest + out.begun});
        out.signal.value.insert(out.signal.value.end(), 2, out.speeds[i]);
        out.rests.push_back(out.signal.time.back());
        time += rest + (i + 1 < out.speeds.size() ? ramp(out.speeds, i) : 0);
    }
    return out;
}

ScenarioDescription climbing(const TestRun& test, const Stairs& stairs, double radius) {
    ScenarioDescription scenario = driving_at(test, stairs.speeds.front(), stairs.rests.back());
    scenario.driver.speed->speed = stairs.signal;
    if (scenario.driver.shifting) scenario.driver.shifting->gear = steady_gear(test.vehicle, radius);
    scenario.driver.ending.roll = steady_roll_limit;
    return scenario;
}

std::vector<SteadyTurn> rests_of(const Recording& recording, const Stairs& stairs,
                                 const std::function<bool(const SteadyTurn&, double)>& is_lost) {
    std::vector<SteadyTurn> out;
    for (std::size_t i = 0; i < stairs.speeds.size() && stairs.rests[i] <= recording.end(); ++i) {
        const double end = stairs.rests[i];
        const SteadyTurn rest = steady_turn(recording, end - steady_window, end);
        if (rest.speed < steady_speed_share * stairs.speeds[i] || is_lost(rest, end)) break;
        out.push_back(rest);
    }
    return out;
}

Setting rest_setting() {
    return {"rest", "s", "at each speed; its last second counts", 6, 2, 30};
}

Setting small_setting(const VehicleDescription& vehicle) {
    const double small = is_heavy(vehicle) ? 1 : 3;
    return {"small_lateral_acceleration", "m/s^2", "up to which gradients are fitted", small, 0.3, 10};
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

void evaluate(TestRun& test, const std::vector<SteadyTurn>& states, double half_width, Steering steering) {
    const TurningGeometry geometry = turning_geometry(test.vehicle);
    const double small = test["small_lateral_acceleration"];
    const std::vector<double> a = column(states, &SteadyTurn::lateral_acceleration),
                              curvature = column(states, &SteadyTurn::curvature),
                              angle = column(states, &SteadyTurn::steering_wheel),
                              roll = column(states, &SteadyTurn::roll),
                              sideslip = column(states, &SteadyTurn::sideslip),
                              torque = column(states, &SteadyTurn::torque);
    const std::vector<double> ones(a.size(), 1);
    const auto slope = [&](const std::vector<double>& y) { return fit_from_zero(ones, a, y, small)[1]; };
    // The angle per curvature without lateral acceleration [deg m]: geometry's, or with a held steering wheel what the states
    // themselves show: delta_H = f kappa + s a + q a^2 + k a^3, which has camber and scrub in it.
    auto [per_curvature, gradient] = steering == Steering::held ? fit_from_zero(curvature, a, angle, small)
                                                                : std::array{geometry.angle_per_curvature(), 0.0};
    std::vector<double> beyond = angle;
    for (std::size_t i = 0; i < beyond.size(); ++i) beyond[i] -= per_curvature * curvature[i];
    if (steering == Steering::turned) gradient = slope(beyond);
    if (!std::isfinite(gradient)) {
        test.note("too few steady states up to {:g} m/s^2 for gradients: choose smaller steps", small);
    }
    test.figure("understeer gradient", "deg/(m/s^2)", gradient,
                "of the steering wheel's angle beyond geometry, at small lateral acceleration");
    test.figure("understeer gradient of the wheels", "deg/(m/s^2)", gradient / geometry.steering_ratio,
                "the same over the steering ratio");
    add_understeer_beyond(test, a, beyond, half_width, geometry.steering_ratio);
    test.figure("roll gradient", "deg/(m/s^2)", slope(roll), "roll angle over lateral acceleration");
    test.figure("sideslip gradient", "deg/(m/s^2)", slope(sideslip),
                "sideslip angle of the center of mass over lateral acceleration");
    const double torque_gradient = slope(torque);
    if (std::isfinite(torque_gradient)) {
        test.figure("steering torque gradient", "N m/(m/s^2)", torque_gradient, "of the hands, without assist");
    }
    const auto chart = [&](const std::string& title, const std::string& y_label, std::vector<double> y) {
        test.chart(title, "lateral acceleration [m/s^2]", y_label,
                   {{.label = title, .x = a, .y = std::move(y), .points = true}});
    };
    chart("steering wheel angle", "steering wheel angle [deg]", angle);
    test.outcome.charts.back().curves.push_back(
        {.label = "by geometry", .x = a, .y = scaled(curvature, geometry.angle_per_curvature())});
    chart("understeer gradient", "gradient [deg/(m/s^2)]", local_slopes(a, beyond, half_width));
    chart("roll angle", "roll angle [deg]", roll);
    chart("sideslip angle", "sideslip angle [deg]", sideslip);
    if (std::isfinite(torque_gradient)) chart("steering torque", "steering torque [N m]", torque);
}

double largest_lateral_acceleration(const Recording& recording, const std::function<bool(std::size_t)>& counts) {
    constexpr double window = 1, alike = 0.03;  // [s]; share by which force and turning may differ
    const auto acceleration = recording[channel::lateral_acceleration].values, speed = recording[channel::speed].values,
               yaw_rate = recording[channel::yaw_rate].values;
    const std::vector<double>& time = recording.time();
    double largest = 0, force = 0, turning = 0;
    std::size_t first = 0;
    const auto add = [&](std::size_t i, double sign) {
        force += sign * acceleration[i];
        turning += sign * speed[i] * yaw_rate[i] * degree;
    };
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (!counts(i)) {
            first = i + 1, force = turning = 0;
            continue;
        }
        add(i, 1);
        for (; time[i] - time[first] > window; ++first) add(first, -1);
        const bool full = time[i] - time[first] > 0.9 * window;
        if (!full || std::abs(turning - force) > alike * std::abs(force)) continue;
        largest = std::max(largest, std::abs(force) / static_cast<double>(i - first + 1));
    }
    return largest;
}

void finish_steady(TestRun& test, Drive& drive, std::size_t states) {
    constexpr std::size_t needed = 6;  // of a fit
    if (drive.ended) test.note("end of the test: {}", *drive.ended);
    if (test.take(drive) && states < needed) {
        test.fail("only {} steady states were reached, {} are needed", states, needed);
    }
}

}  // namespace hamilcar
