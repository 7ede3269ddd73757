// ISO 7401, step input: the steering wheel jumps to an angle and stays. How fast, how far beyond and where the vehicle follows.
//
// Times count from when the steering wheel has turned by half. The response time ends at 90 percent of the steady value, the
// peak response time at the peak; the TB value is the yaw rate's peak response time times the steady sideslip angle.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/lateral.hpp"

namespace hamilcar {

namespace {

constexpr double window = 1;        // of the steady values, at the end [s]
constexpr double interval = 0.005;  // between rows [s]
constexpr double risen = 0.9;       // of the steady value
constexpr double visible = 1e-3;    // overshoot below which there is no peak
constexpr double tolerance = 0.1;   // of the wanted lateral acceleration
constexpr double slowed = 0.1;      // of the speed before the step: a vehicle that loses more has no steady turn
constexpr double latest = 2, latest_heavy = 4;  // that a peak answers the step, after half of it; later it drifts [s]
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {speed_setting(vehicle, 80, 80),
            acceleration_setting(vehicle, 4, 2, "in the steady turn after the step"),
            {"rate", "deg/s", "of the steering wheel, in the mean over its turn", 400, 10, 2000},
            {"duration", "s", "from the step on", is_heavy(vehicle) ? 10.0 : 6.0, 3, 60}};
}

// One output after the step.
struct StepResponse {
    double steady;                    // [unit]
    double response_time, peak_time;  // NaN where it does not come [s]
    double overshoot;                 // over the steady value, less one [1]
};

StepResponse response_of(const History& history, const std::vector<double>& column, double half, double end) {
    StepResponse out{mean_over(history, column, end - window, end), none, none, 0};
    const std::vector<double> relative = scaled(column, 1 / out.steady);
    const Series series = series_of(history, relative);
    if (const auto there = first_crossing(series, risen, Crossing::rising, straight_ahead))
        out.response_time = *there - half;
    const auto highest = peak(series, Extreme::highest, straight_ahead, end - window);
    if (highest && highest->value > 1 + visible) {
        out.peak_time = highest->time - half;
        out.overshoot = highest->value - 1;
    }
    return out;
}

void add_figures(Outcome& outcome, const std::string& of, const std::string& unit, double factor,
                 const StepResponse& response, double angle) {
    outcome.figures.push_back({"steady " + of, unit, "in the last second", response.steady * factor});
    outcome.figures.push_back({of + " gain", unit + "/deg", "steady, per angle of the steering wheel",
                               response.steady * factor / (angle / degree)});
    outcome.figures.push_back(
        {of + " response time", "s", "from half the steering to 90 percent", response.response_time});
    outcome.figures.push_back(
        {of + " peak response time", "s", "from half the steering to the peak", response.peak_time});
    outcome.figures.push_back({of + " overshoot", "%", "of the peak over the steady value", 100 * response.overshoot});
}

std::vector<io::Chart> response_charts(const History& history) {
    const auto absolute = [&](const std::string& what, const std::string& unit, std::vector<double> y) {
        return io::Chart{.title = what + " over time",
                         .x_label = "time [s]",
                         .y_label = what + " [" + unit + "]",
                         .curves = {{.label = what, .x = history.time, .y = std::move(y)}}};
    };
    const auto share = [&](const std::string& label, const std::vector<double>& column) {
        const double steady = mean_over(history, column, history.time.back() - window, history.time.back());
        return io::Curve{.label = label, .x = history.time, .y = scaled(column, 1 / steady)};
    };
    const io::Chart shares{
        .title = "step response",
        .x_label = "time [s]",
        .y_label = "of the steady value [1]",
        .curves = {share("steering wheel angle", history.steering_wheel), share("yaw rate", history.yaw_rate),
                   share("lateral acceleration", history.lateral_acceleration), share("roll angle", history.roll)}};
    return {shares, absolute("steering wheel angle", "deg", scaled(history.steering_wheel, 1 / degree)),
            absolute("yaw rate", "deg/s", scaled(history.yaw_rate, 1 / degree)),
            absolute("lateral acceleration", "m/s^2", history.lateral_acceleration),
            absolute("sideslip angle", "deg", scaled(sideslip_of(history), 1 / degree))};
}

// What is read off is the answer to a step only if the vehicle turns steadily in the end, at the speed of the beginning.
void add_verdicts(const History& history, double speed, double wanted, double allowed, const StepResponse& yaw,
                  const StepResponse& lateral, Outcome& outcome) {
    outcome.verdicts.push_back(speed_held(history, speed, straight_ahead - 1, straight_ahead));
    const double end = history.time.back(), before = history.speed[row_at(history, straight_ahead)];
    const double lost = 1 - mean_over(history, history.speed, end - window, end) / before;
    outcome.verdicts.push_back(
        {fmt::format("at most {:g} percent of the speed before the step lost in the last second", 100 * slowed),
         lost <= slowed, fmt::format("{:.1f} percent", std::max(0.0, 100 * lost))});
    outcome.verdicts.push_back({fmt::format("steady lateral acceleration within 10 percent of {:.3g} m/s^2", wanted),
                                std::abs(lateral.steady / wanted - 1) <= tolerance,
                                fmt::format("{:.3g} m/s^2", lateral.steady)});
    const auto spoken = [](double time) {
        return std::isnan(time) ? std::string("no peak") : fmt::format("{:.2f} s", time);
    };
    outcome.verdicts.push_back(
        {fmt::format("no peak of yaw rate or lateral acceleration later than {:g} s", allowed),
         !(yaw.peak_time > allowed || lateral.peak_time > allowed),
         fmt::format("yaw rate {}, lateral acceleration {}", spoken(yaw.peak_time), spoken(lateral.peak_time))});
}

// `speed` [m/s] and steady lateral acceleration [m/s^2] as wanted, `allowed` for a peak to come [s]. Returns the lateral
// acceleration that was reached.
double evaluate_step(const History& history, double speed, double wanted, double allowed, Outcome& outcome) {
    const double end = history.time.back(), angle = history.steering_wheel.back();
    const auto half = first_crossing(series_of(history, history.steering_wheel), angle / 2, Crossing::rising);
    const double from = half.value_or(straight_ahead);
    const StepResponse yaw = response_of(history, history.yaw_rate, from, end);
    const StepResponse lateral = response_of(history, history.lateral_acceleration, from, end);
    const StepResponse roll = response_of(history, history.roll, from, end);
    const double sideslip = mean_over(history, sideslip_of(history), end - window, end) / degree;
    outcome.figures.push_back({"steering wheel angle", "deg", "of the step", angle / degree});
    add_figures(outcome, "yaw rate", "deg/s", 1 / degree, yaw, angle);
    add_figures(outcome, "lateral acceleration", "m/s^2", 1, lateral, angle);
    outcome.figures.push_back({"steady roll angle", "deg", "in the last second", roll.steady / degree});
    outcome.figures.push_back({"roll overshoot", "%", "of the peak over the steady value", 100 * roll.overshoot});
    outcome.figures.push_back({"steady sideslip", "deg", "of the center of mass", sideslip});
    outcome.figures.push_back({"TB value", "deg s", "yaw rate's peak response time times steady sideslip",
                               yaw.peak_time * std::abs(sideslip)});
    add_verdicts(history, speed, wanted, allowed, yaw, lateral, outcome);
    for (io::Chart& chart : response_charts(history)) outcome.charts.push_back(std::move(chart));
    return lateral.steady;
}

ScenarioDescription step(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options,
                         double angle) {
    const double turning = std::abs(angle) / (chosen.at("rate") * degree);
    const double end = straight_ahead + std::max(chosen.at("duration"), turning + 2 * window);
    ScenarioDescription scenario =
        steered_at(vehicle, options, chosen.at("speed") * kilometer_per_hour,
                   {.time = {0, straight_ahead, straight_ahead + turning, end}, .value = {0, 0, angle, angle}});
    scenario.name = "step_steer";
    return scenario;
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double speed = chosen.at("speed") * kilometer_per_hour, wanted = chosen.at("lateral_acceleration");
    const Amplitude amplitude = amplitude_for(vehicle, speed, wanted);
    const Aim aim{.lateral_acceleration = amplitude.lateral_acceleration,
                  .scenario = [&](double angle) { return step(vehicle, chosen, options, angle); },
                  .reached =
                      [](const History& history) {
                          const double end = history.time.back();
                          return mean_over(history, history.lateral_acceleration, end - window, end);
                      }};
    Trial trial = drive_aimed(vehicle, aim, amplitude.angle, options, interval, outcome);
    std::string reached = "";
    if (take_whole(outcome, trial)) {
        const double allowed = is_heavy(vehicle) ? latest_heavy : latest;
        reached = fmt::format("; the last second had {:.3g} m/s^2 at {:.3g} km/h",
                              evaluate_step(trial.history, speed, wanted, allowed, outcome),
                              trial.history.speed.back() / kilometer_per_hour);
    }
    if (!amplitude.note.empty()) outcome.notes.push_back(amplitude.note + reached);
    return outcome;
}

}  // namespace

Maneuver step_steer() {
    return {.name = "step_steer",
            .title = "Step input of the steering wheel",
            .standard = "ISO 7401",
            .summary = "The steering wheel jumps to an angle: response times, overshoot and steady gains.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
