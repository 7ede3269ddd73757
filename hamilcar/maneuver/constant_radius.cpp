// ISO 4138, constant radius: round one circle faster and faster, in steps of lateral acceleration with a rest on each, until
// the driver cannot hold the circle or the speed any more.
#include <algorithm>
#include <cmath>
#include <map>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/search.hpp"
#include "hamilcar/maneuver/steady_turn.hpp"

namespace hamilcar {

namespace {

constexpr double gentle = 0.25;          // acceleration from rest to rest: at the limit more upsets the car [m/s^2]
constexpr double brisk = 1;              // likewise, far from the limit [m/s^2]
constexpr double shortest_ramp = 2;      // [s]
constexpr double resolution = 0.02;      // of the largest lateral acceleration [m/s^2]
constexpr double share_of_stairs = 0.5;  // of the progress
constexpr double off_circle = 0.5;       // ISO 4138's tolerance [m]
constexpr double lost = 2;               // off the circle: the driver gives up [m]
constexpr double unsteady = 0.005;       // share of the acceleration: one that turns in so much faster is not held
constexpr double other_circle = 0.02;    // share of the curvature: a state so far off is not steady
constexpr double interval = 0.02;        // between rows [s]
constexpr int circle_points = 180;

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {{"radius", "m", "of the circle of the center of mass", 100, 20, 1000},
            {"step", "m/s^2", "of lateral acceleration from one rest to the next, beyond the small ones",
             heavy ? 0.2 : 0.5, 0.05, 2},
            rest_setting(),
            {"largest_lateral_acceleration", "m/s^2", "up to which it is tried", heavy ? 6.0 : 14.0, 1, 60},
            small_setting(vehicle)};
}

// Rests on these lateral accelerations [m/s^2], the way to the largest one gentle, to the others at a rate of `rate` [m/s^2].
Stairs plan(const std::vector<double>& accelerations, double rate, const TestRun& test) {
    return stairs(accelerations, test["radius"], test["rest"], 0, [&](const std::vector<double>& v, std::size_t i) {
        return std::max(shortest_ramp, (v[i + 1] - v[i]) / (v[i + 1] == v.back() ? gentle : rate));
    });
}

// As many small ones as the gradients are fitted to, whatever the step beyond: so that these do not depend on it.
std::vector<double> levels(const TestRun& test) {
    constexpr int small_ones = 12;
    const double limit = test["largest_lateral_acceleration"] * (1 + 1e-9), small = test["small_lateral_acceleration"];
    std::vector<double> out;
    for (int i = 1; i <= small_ones && i * small / small_ones <= limit; ++i) out.push_back(i * small / small_ones);
    for (double a = small + test["step"]; a <= limit; a += test["step"]) out.push_back(a);
    return out;
}

ScenarioDescription round_the_circle(const TestRun& test, const Stairs& planned) {
    const double radius = test["radius"];
    ScenarioDescription scenario = climbing(test, planned, radius);
    scenario.duration += interval;
    scenario.initial.position = {-test.vehicle.chassis.center_of_mass[0], 0};
    scenario.initial.angular_velocity = {0, 0, planned.speeds.front() / radius};
    scenario.driver.steering =
        PathFollowerDescription{.path = {.points = circle(radius, circle_points), .closed = true}};
    scenario.driver.ending.path_offset = lost, scenario.driver.ending.earliest = planned.begun;
    return scenario;
}

// Distance from the circle of every row [m].
std::vector<double> off(const Recording& recording, double radius) {
    const auto x = recording[channel::x].values, y = recording[channel::y].values;
    std::vector<double> out;
    for (std::size_t i = 0; i < x.size(); ++i) out.push_back(std::abs(std::hypot(x[i], y[i] - radius) - radius));
    return out;
}

std::vector<SteadyTurn> rests_on_circle(const Recording& recording, const Stairs& planned, double radius) {
    const std::vector<double> offset = off(recording, radius);
    const Series x = recording[channel::x];
    std::vector<SteadyTurn> out = rests_of(
        recording, planned, [&](const SteadyTurn&, double end) { return offset[sample_at(x, end)] > off_circle; });
    std::erase_if(out,
                  [&](const SteadyTurn& rest) { return !(std::abs(rest.curvature() * radius - 1) <= other_circle); });
    return out;
}

void judge_circle(TestRun& test, const Recording& recording, const Stairs& planned) {
    const double radius = test["radius"], small = test["small_lateral_acceleration"];
    const Series speed = recording[channel::speed];
    const std::vector<double> offset = off(recording, radius);
    double farthest = 0, reached = 0;
    for (std::size_t i = sample_at(speed, planned.begun); i < recording.size() && reached <= small; ++i) {
        farthest = std::max(farthest, offset[i]);
        reached = std::max(reached, speed.values[i] * speed.values[i] / radius);
    }
    const double wanted = std::min(small, planned.speeds.back() * planned.speeds.back() / radius);
    const bool there = reached >= steady_speed_share * steady_speed_share * wanted;
    test.verdict(fmt::format("within {:.1f} m of the circle up to {:g} m/s^2", off_circle, wanted),
                 there && farthest <= off_circle,
                 there ? fmt::format("{:.2f} m", farthest)
                       : fmt::format("not reached: {:.2f} m up to {:.2f} m/s^2", farthest, reached));
}

// Of a drive that comes gently to the last speed: what is held there, or nothing.
std::optional<SteadyTurn> held_at_end(const Drive& drive, const Stairs& planned, double radius) {
    const Recording& recording = drive.recording;
    if (drive.stopped != Stopped::no || drive.ended) return {};
    const std::vector<SteadyTurn> rests = rests_on_circle(recording, planned, radius);
    if (rests.size() < planned.speeds.size() || rests.back().unsteadiness() > unsteady) return {};
    const std::vector<double> offset = off(recording, radius);
    const std::size_t last = sample_at(recording[channel::x], recording.end() - steady_window);
    if (std::ranges::any_of(std::span(offset).subspan(last), [](double here) { return here > off_circle; })) return {};
    return rests.back();
}

// The largest lateral acceleration that is held, sought by drives that each come to theirs in the same way, whatever was driven
// before: so it is of the vehicle, and not of the steps. From one that was held on the way up [m/s^2]; nothing where none is or
// a drive broke off. Levels are in steps of the resolution.
std::optional<SteadyTurn> largest_held(TestRun& test, double held_before) {
    const double most = std::floor(test["largest_lateral_acceleration"] / resolution + 1e-9), radius = test["radius"];
    int tried = 0;
    double width = 8;  // of the next step outward
    std::map<double, SteadyTurn> held;
    const auto next = [&](const Bracket& now) -> std::optional<double> {
        if (tried == 0) return std::clamp(std::round(held_before / resolution), 1.0, most);
        if (now.low > 0 && now.high <= most) return std::floor(now.middle());
        const double level = now.low > 0 ? std::min(now.low + width, most) : std::max(now.high - width, 1.0);
        width *= 2;
        return level;
    };
    const auto holds = [&](double level) -> std::optional<bool> {
        constexpr double calm = 0.5, near = 0.9;  // of what is tried: where it starts, and from where it goes gently
        const double a = level * resolution;
        // Three rests: near the limit driver and vehicle swing about the circle for long before they are calm, or lost.
        const Stairs planned = plan({calm * a, near * a, a, a, a}, brisk, test);
        const double from = 1 - (1 - share_of_stairs) * std::pow(0.8, tried++), to = 0.2 + 0.8 * from;
        const Drive drive =
            test.drive(round_the_circle(test, planned), {.interval = interval, .share = {from, to}, .replay = false});
        if (!test.take_energy(drive)) return {};
        const auto reached = held_at_end(drive, planned, radius);
        if (reached) held.emplace(level, *reached);
        return reached.has_value();
    };
    Bracket found{0, most + 1};  // beyond what is tried
    narrow(found, 1, next, holds);
    if (test.outcome.failed || found.low == 0) return {};
    return held.at(found.low);
}

void run(TestRun& test) {
    const Stairs planned = plan(levels(test), gentle, test);
    Drive drive = test.drive(round_the_circle(test, planned), {.interval = interval, .share = {0, share_of_stairs}});
    std::vector<SteadyTurn> states = rests_on_circle(drive.recording, planned, test["radius"]);
    judge_circle(test, drive.recording, planned);
    test.outcome.course.line = circle(test["radius"], circle_points);
    finish_steady(test, drive, states.size());
    std::optional<SteadyTurn> last;
    if (!states.empty() && !test.outcome.failed) last = largest_held(test, states.back().lateral_acceleration());
    if (last) {  // states beyond it were held for a moment, by the way that led to them
        std::erase_if(states, [&](const SteadyTurn& state) {
            return state.lateral_acceleration() >= last->lateral_acceleration();
        });
        states.push_back(*last);
    }
    evaluate(test, states, 1.2 * test["step"]);
    test.figure("largest lateral acceleration", "m/s^2", last ? last->lateral_acceleration() : not_shown,
                fmt::format("that was held on the circle, steadily for a second; sought to {:g} m/s^2", resolution));
}

}  // namespace

Maneuver constant_radius() {
    return {
        .name = "constant_radius",
        .title = "Steady-state circular driving, constant radius",
        .standard = "ISO 4138",
        .summary = "The driver follows a circle and goes faster in steps until the vehicle cannot hold it any more.",
        .settings = settings,
        .unsupported_reason = needs_steering_and_drive,
        .run = run,
        .course = [](const auto&, const Settings& chosen) {
            return Course{.line = circle(chosen.at("radius"), circle_points)};
        }};
}

}  // namespace hamilcar
