// ISO 4138, constant radius: round one circle faster and faster, in steps of lateral acceleration with a rest on each, until
// the driver cannot hold the circle or the speed any more.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steady_turn.hpp"

namespace hamilcar {

namespace {

constexpr double gentle = 0.25;          // acceleration from rest to rest: at the limit more upsets the car [m/s^2]
constexpr double brisk = 1;              // likewise, far from the limit [m/s^2]
constexpr double shortest_ramp = 2;      // [s]
constexpr double resolution = 0.02;      // of the largest lateral acceleration [m/s^2]
constexpr double share_of_stairs = 0.5;  // of the progress
constexpr double window = 1;             // of a mean at the end of a rest [s]
constexpr double off_circle = 0.5;       // ISO 4138's tolerance [m]
constexpr double lost = 2;               // off the circle: the driver gives up [m]
constexpr double slow_share = 0.97;      // of the wanted speed; below it a rest is none: ISO 4138's 3 percent
constexpr double other_circle = 0.02;    // share of the curvature: a state so far off is not steady
constexpr double interval = 0.02;        // between rows [s]
constexpr double fallen = 30 * degree;   // roll

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {{"radius", "m", "of the circle of the center of mass", 100, 20, 1000},
            {"step", "m/s^2", "of lateral acceleration from one rest to the next, beyond the small ones",
             heavy ? 0.2 : 0.5, 0.05, 2},
            {"rest", "s", "at each speed; its last second counts", 6, 2, 30},
            {"largest_lateral_acceleration", "m/s^2", "up to which it is tried", heavy ? 6.0 : 14.0, 1, 60},
            {"small_lateral_acceleration", "m/s^2", "up to which gradients are fitted", heavy ? 1.0 : 3.0, 0.3, 10}};
}

PathDescription circle(double radius) {
    constexpr int points = 180;  // a spline through so many leaves its circle by less than a micrometer
    PathDescription path{.points = {}, .closed = true};
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * std::numbers::pi * i / points;
        path.points.push_back({radius * std::sin(angle), radius - radius * std::cos(angle)});
    }
    return path;
}

struct Plan {
    std::vector<double> speeds;
    Stairs stairs;
    double begun;  // when the driver has found the circle, and a trailer its angle: a quarter of it [s]
};
// Rests on these lateral accelerations [m/s^2], the way to the last one gentle, to the others at a rate of `rate` [m/s^2].
Plan plan(const std::vector<double>& accelerations, double rate, const Settings& chosen) {
    Plan out;
    const double radius = chosen.at("radius");
    for (const double a : accelerations) out.speeds.push_back(std::sqrt(radius * a));
    const auto ramp = [&](std::size_t i) {
        const bool last = i + 2 == out.speeds.size();
        return std::max(shortest_ramp, (out.speeds[i + 1] - out.speeds[i]) / (last ? gentle : rate));
    };
    out.stairs = stairs(out.speeds, ramp, chosen.at("rest"));
    out.begun = std::numbers::pi / 2 * radius / out.speeds.front();
    delay(out.stairs, out.begun);
    return out;
}

// As many small ones as the gradients are fitted to, whatever the step beyond: so that these do not depend on it.
std::vector<double> levels(const Settings& chosen) {
    constexpr int small_ones = 12;
    const double most = chosen.at("largest_lateral_acceleration") * (1 + 1e-9);
    const double small = chosen.at("small_lateral_acceleration");
    std::vector<double> out;
    for (int i = 1; i <= small_ones && i * small / small_ones <= most; ++i) out.push_back(i * small / small_ones);
    for (double a = small + chosen.at("step"); a <= most; a += chosen.at("step")) out.push_back(a);
    return out;
}

ScenarioDescription round_the_circle(const VehicleDescription& vehicle, const Settings& chosen,
                                     const ManeuverOptions& options, const Plan& planned) {
    const double radius = chosen.at("radius"), first = planned.speeds.front();
    ScenarioDescription scenario = driving_at(vehicle, options, first, planned.stairs.rests.back() + interval);
    scenario.name = "constant_radius";
    const double ahead = vehicle.chassis.center_of_mass[0];
    scenario.initial.position = {-ahead, 0};
    scenario.initial.angular_velocity = {0, 0, first / radius};
    scenario.driver.steering.emplace();
    scenario.driver.steering->path = circle(radius);
    scenario.driver.speed->speed = planned.stairs.signal;
    if (scenario.driver.shifting) scenario.driver.shifting->gear = steady_gear(vehicle, radius);
    scenario.driver.ending = {.path_offset = lost, .roll = fallen, .earliest = planned.begun};
    return scenario;
}

double off(const History& history, double radius, std::size_t row) {
    return std::abs(std::hypot(history.x[row], history.y[row] - radius) - radius);
}

std::vector<SteadyTurn> rests_of(const History& history, const Plan& planned, double radius) {
    std::vector<SteadyTurn> out;
    for (std::size_t i = 0; i < planned.speeds.size() && planned.stairs.rests[i] <= history.time.back(); ++i) {
        const double end = planned.stairs.rests[i];
        const SteadyTurn rest = steady_turn(history, end - window, end);
        if (rest.speed < slow_share * planned.speeds[i] || off(history, radius, row_at(history, end)) > off_circle)
            break;
        if (std::abs(rest.curvature() * radius - 1) <= other_circle) out.push_back(rest);
    }
    return out;
}

Verdict held(const History& history, const Plan& planned, double radius, double small) {
    double farthest = 0, reached = 0;
    for (std::size_t i = row_at(history, planned.begun); i < history.size() && reached <= small; ++i) {
        farthest = std::max(farthest, off(history, radius, i));
        reached = std::max(reached, history.speed[i] * history.speed[i] / radius);
    }
    const double wanted = std::min(small, planned.speeds.back() * planned.speeds.back() / radius);
    const bool there = reached >= slow_share * slow_share * wanted;
    return {fmt::format("within {:.1f} m of the circle up to {:g} m/s^2", off_circle, wanted),
            there && farthest <= off_circle,
            there ? fmt::format("{:.2f} m", farthest)
                  : fmt::format("not reached: {:.2f} m up to {:.2f} m/s^2", farthest, reached)};
}

// The largest lateral acceleration that is held, sought by drives that each come to theirs in the same way, whatever was driven
// before: so it is of the vehicle, and not of the steps.
class Limit {
public:
    Limit(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options, Outcome& outcome)
        : vehicle_(vehicle),
          chosen_(chosen),
          options_(options),
          outcome_(outcome),
          most_(static_cast<long>(chosen.at("largest_lateral_acceleration") / resolution + 1e-9)) {}

    // From one that was held on the way up; NaN where none is or a drive broke off [m/s^2].
    double find(double held_before) {
        const long start = std::clamp(std::lround(held_before / resolution), 1L, most_);
        long low = 0, high = most_ + 1, width = first_width;
        if (holds(start)) {
            low = start;
            for (; low < most_ && high > most_; width *= 2) {
                const long next = std::min(low + width, most_);
                (holds(next) ? low : high) = next;
            }
        } else {
            high = start;
            for (; high > 1 && low == 0; width *= 2) {
                const long next = std::max(high - width, 1L);
                (holds(next) ? low : high) = next;
            }
        }
        while (high - low > 1 && !outcome_.failed) {
            const long middle = (low + high) / 2;
            (holds(middle) ? low : high) = middle;
        }
        return outcome_.failed || low == 0 ? std::numeric_limits<double>::quiet_NaN() : held_.at(low);
    }

private:
    static constexpr long first_width = 8;  // of the bracket, in steps of the resolution

    bool holds(long level) {
        if (outcome_.failed) return false;
        constexpr double calm = 0.5, near = 0.9;  // of what is tried: where it starts, and from where it goes gently
        const double a = static_cast<double>(level) * resolution, radius = chosen_.at("radius");
        const Plan planned = plan({calm * a, near * a, a}, brisk, chosen_);
        const double from = 1 - (1 - share_of_stairs) * std::pow(0.8, tried_++), to = 0.2 + 0.8 * from;
        ManeuverOptions unseen = options_;
        unseen.keep_runs = false;
        const Trial trial =
            drive_share(vehicle_, round_the_circle(vehicle_, chosen_, options_, planned), unseen, interval, {from, to});
        if (!add_search_trial(outcome_, trial) || trial.stopped != Stopped::no || trial.ended) return false;
        const std::vector<SteadyTurn> rests = rests_of(trial.history, planned, radius);
        if (rests.size() < planned.speeds.size() || !rests.back().settled()) return false;
        for (std::size_t i = row_at(trial.history, trial.history.time.back() - window); i < trial.history.size(); ++i) {
            if (off(trial.history, radius, i) > off_circle) return false;
        }
        held_[level] = std::min(rests.back().lateral_acceleration(), rests.back().acceleration);
        return true;
    }

    const VehicleDescription& vehicle_;
    const Settings& chosen_;
    const ManeuverOptions& options_;
    Outcome& outcome_;
    long most_;
    int tried_ = 0;
    std::map<long, double> held_;  // as measured [m/s^2]
};

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double radius = chosen.at("radius"), small = chosen.at("small_lateral_acceleration");
    const Plan planned = plan(levels(chosen), gentle, chosen);
    Trial trial = drive_share(vehicle, round_the_circle(vehicle, chosen, options, planned), options, interval,
                              {0, share_of_stairs});
    const std::vector<SteadyTurn> rests = rests_of(trial.history, planned, radius);
    evaluate({.geometry = turning_geometry(vehicle),
              .small = small,
              .fixed_wheel = false,
              .half_width = 1.2 * chosen.at("step")},
             rests, outcome);
    outcome.verdicts.push_back(held(trial.history, planned, radius, small));
    outcome.course.line = circle(radius).points;
    finish_steady(outcome, std::move(trial), rests.size());
    if (rests.empty() || outcome.failed) return outcome;
    const double largest = Limit(vehicle, chosen, options, outcome).find(rests.back().lateral_acceleration());
    outcome.figures.push_back(
        {"largest lateral acceleration", "m/s^2",
         fmt::format("that was held on the circle, steadily for a second; sought to {:g} m/s^2", resolution), largest});
    return outcome;
}

}  // namespace

Maneuver constant_radius() {
    return {
        .name = "constant_radius",
        .title = "Steady-state circular driving, constant radius",
        .standard = "ISO 4138",
        .summary = "The driver follows a circle and goes faster in steps until the vehicle cannot hold it any more.",
        .settings = settings,
        .obstacle = needs_steering_and_drive,
        .drive = drive_it,
        .course = [](const VehicleDescription&, const Settings& chosen) {
            return Course{.cones = {}, .boundaries = {}, .line = circle(chosen.at("radius")).points};
        }};
}

}  // namespace hamilcar
