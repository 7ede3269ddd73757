// ISO 13674-1, on-center handling: the steering wheel weaves slowly about straight ahead. One output over another is a loop:
// its slope is a gain, its width what a driver feels as play. Characteristic values after Norman (1984, "Objective evaluation
// of on-center handling performance", SAE 840069).
//
// A loop is read on two branches, on which the abscissa rises and falls; slopes are means of both, widths the distance between.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/spectrum.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

constexpr double interval = 0.01;     // between rows [s]
constexpr double past_the_end = 0.5;  // that the weave goes on, so that its last period is like the others [s]
constexpr double aside = 1;           // where gains off center are read [m/s^2]
constexpr double near = 0.25;         // about a level: of a slope's points, as a share of the amplitude [1]
constexpr double tolerance = 0.1;     // of the wanted lateral acceleration
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {speed_setting(vehicle, 100, 80),
            acceleration_setting(vehicle, 2, 1, "of the weave's peaks"),
            {"frequency", "Hz", "of the weave", 0.2, 0.05, 1},
            {"periods", "", "that are evaluated, after one that is not", 3, 1, 20, SettingKind::whole}};
}

SignalDescription weaving(double angle, double frequency, double periods) {
    return tabulated(
        [&](double time) {
            return time <= straight_ahead
                       ? 0
                       : angle * std::sin(2 * std::numbers::pi * frequency * (time - straight_ahead));
        },
        straight_ahead + (1 + periods) / frequency + past_the_end);
}

// One output over another.
class Loop {
public:
    Loop(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {}

    // y where x comes to a level, on the branch where x rises or on the other; mean of all passes.
    double at(double level, bool rising) const {
        double sum = 0, count = 0;
        for (std::size_t i = 1; i < x_.size(); ++i) {
            const double before = x_[i - 1] - level, now = x_[i] - level;
            if (!(rising ? before < 0 && now >= 0 : before > 0 && now <= 0)) continue;
            sum += y_[i - 1] + (y_[i] - y_[i - 1]) * before / (before - now), ++count;
        }
        return count > 0 ? sum / count : none;
    }
    double width(double level) const { return std::abs(at(level, true) - at(level, false)); }
    // dy/dx about a level, by lines through what is within `reach` of it; mean of both branches.
    double slope(double level, double reach) const {
        double sum = 0;
        for (const bool rising : {true, false}) {
            std::vector<double> x, y;
            for (std::size_t i = 1; i < x_.size(); ++i) {
                if (std::abs(x_[i] - level) > reach || (x_[i] > x_[i - 1]) != rising) continue;
                x.push_back(x_[i]), y.push_back(y_[i]);
            }
            if (x.size() < 3) return none;
            sum += fitted_line(x, y).slope;
        }
        return sum / 2;
    }
    // The mean of both sides, off center.
    double slope_aside(double level, double reach) const { return (slope(level, reach) + slope(-level, reach)) / 2; }
    io::Chart chart(const std::string& title, const std::string& x_label, const std::string& y_label) const {
        return {.title = title, .x_label = x_label, .y_label = y_label, .curves = {{.label = title, .x = x_, .y = y_}}};
    }

private:
    std::vector<double> x_, y_;
};

// How much less lateral acceleration the vehicle has while it weaves than in steady driving, by linear theory [1].
double attenuation(const VehicleDescription& vehicle, double speed, double frequency) {
    constexpr double nearly_none = 1e-3;  // [Hz]
    const SteeringGain gain = theoretical_gain(vehicle, speed, {nearly_none, frequency});
    if (gain.frequency.empty()) return 1;
    return std::abs(gain.lateral_acceleration[1]) / std::abs(gain.lateral_acceleration[0]);
}

// Whole periods, in degrees where angles are meant.
struct Weave {
    std::vector<double> angle, acceleration, yaw_rate, torque;
    double rate, frequency;  // of the rows, of the weave [Hz]
    double amplitude;        // of the lateral acceleration [m/s^2]
};

// Of the lateral acceleration, after the first period; NaN where the drive ended before [m/s^2].
double amplitude_of(const History& history, double frequency) {
    const Series series = series_of(history, history.lateral_acceleration);
    const double from = straight_ahead + 1 / frequency;
    const auto highest = peak(series, Extreme::highest, from), lowest = peak(series, Extreme::lowest, from);
    return highest && lowest ? (highest->value - lowest->value) / 2 : none;
}

Weave weave_of(const History& history, double frequency, double periods) {
    const std::size_t first = row_at(history, straight_ahead + 1 / frequency);
    const std::size_t last = row_at(history, straight_ahead + (1 + periods) / frequency);
    const auto part = [&](const std::vector<double>& column, double factor) {
        return column.size() < history.size() ? std::vector<double>()
                                              : scaled({column.begin() + static_cast<std::ptrdiff_t>(first),
                                                        column.begin() + static_cast<std::ptrdiff_t>(last)},
                                                       factor);
    };
    return {part(history.steering_wheel, 1 / degree), part(history.lateral_acceleration, 1),
            part(history.yaw_rate, 1 / degree),       part(history.steering_torque, 1),
            series_of(history, history.time).rate,    frequency,
            amplitude_of(history, frequency)};
}

using Add = std::function<void(const std::string&, const std::string&, const std::string&, double)>;

void add_steering(const Weave& weave, const Add& add, Outcome& outcome) {
    const Loop by_acceleration(weave.acceleration, weave.angle), by_angle(weave.angle, weave.acceleration);
    const double reach = near * weave.amplitude;
    const bool wide = weave.amplitude > aside + reach;
    add("steering sensitivity", "m/s^2/deg", "lateral acceleration over the angle, at none",
        1 / by_acceleration.slope(0, reach));
    add("steering sensitivity at 1 m/s^2", "m/s^2/deg", "the same off center",
        wide ? 1 / by_acceleration.slope_aside(aside, reach) : none);
    add("angle dead band", "deg", "the loop's width at no lateral acceleration", by_acceleration.width(0));
    add("lateral acceleration dead band", "m/s^2", "the loop's height at no angle", by_angle.width(0));
    const auto lag = [&](const std::vector<double>& output) {
        return -std::arg(response_at(weave.angle, output, weave.rate, weave.frequency)) /
               (2 * std::numbers::pi * weave.frequency);
    };
    const Loop yaw(weave.yaw_rate, weave.angle);
    constexpr double yaw_share = near;
    add("yaw rate gain", "deg/s/deg", "over the angle, at none",
        1 / yaw.slope(0, yaw_share * std::ranges::max(weave.yaw_rate)));
    add("lateral acceleration lag", "s", "behind the steering wheel", lag(weave.acceleration));
    add("yaw rate lag", "s", "behind the steering wheel", lag(weave.yaw_rate));
    outcome.charts.push_back(
        by_angle.chart("lateral acceleration", "steering wheel angle [deg]", "lateral acceleration [m/s^2]"));
}

void add_torque(const Weave& weave, const Add& add, Outcome& outcome) {
    if (weave.torque.empty()) return;
    const Loop by_acceleration(weave.acceleration, weave.torque), by_angle(weave.angle, weave.torque),
        by_torque(weave.torque, weave.acceleration);
    const double reach = near * weave.amplitude;
    const bool wide = weave.amplitude > aside + reach;
    add("torque gradient", "N m/(m/s^2)", "over lateral acceleration, at none", by_acceleration.slope(0, reach));
    add("torque gradient at 1 m/s^2", "N m/(m/s^2)", "the same off center",
        wide ? by_acceleration.slope_aside(aside, reach) : none);
    add("steering stiffness", "N m/deg", "torque over the angle, straight ahead",
        by_angle.slope(0, near * std::ranges::max(weave.angle)));
    add("torque at 1 m/s^2", "N m", "while lateral acceleration grows",
        wide ? (by_acceleration.at(aside, true) - by_acceleration.at(-aside, false)) / 2 : none);
    add("torque dead band", "N m", "the loop's height at no lateral acceleration", by_acceleration.width(0));
    add("returnability", "m/s^2", "lateral acceleration that is left at no torque: half the loop's width",
        by_torque.width(0) / 2);
    outcome.charts.push_back(
        by_acceleration.chart("steering torque", "lateral acceleration [m/s^2]", "steering torque [N m]"));
    outcome.charts.push_back(
        by_angle.chart("steering torque over angle", "steering wheel angle [deg]", "steering torque [N m]"));
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double speed = chosen.at("speed") * kilometer_per_hour, frequency = chosen.at("frequency");
    const double wanted = chosen.at("lateral_acceleration"), periods = chosen.at("periods");
    const Amplitude amplitude = amplitude_for(vehicle, speed, wanted / attenuation(vehicle, speed, frequency));
    if (!amplitude.note.empty()) outcome.notes.push_back(amplitude.note);
    const auto scenario = [&](double angle) {
        ScenarioDescription out = steered_at(vehicle, options, speed, weaving(angle, frequency, periods));
        out.name = "weave";
        return out;
    };
    const Aim aim{.lateral_acceleration = wanted, .scenario = scenario, .reached = [&](const History& history) {
                      return amplitude_of(history, frequency);
                  }};
    Trial trial = drive_aimed(vehicle, aim, amplitude.angle, options, interval, outcome);
    if (!take_whole(outcome, trial)) return outcome;
    const Weave weave = weave_of(trial.history, frequency, periods);
    const Add add = [&](const std::string& name, const std::string& unit, const std::string& meaning, double value) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    add("steering wheel angle", "deg", "amplitude", std::ranges::max(weave.angle));
    add("lateral acceleration", "m/s^2", "amplitude", weave.amplitude);
    add_steering(weave, add, outcome);
    add_torque(weave, add, outcome);
    outcome.verdicts.push_back(speed_held(trial.history, speed, straight_ahead, trial.history.time.back()));
    outcome.verdicts.push_back({fmt::format("lateral acceleration within 10 percent of {:.3g} m/s^2", wanted),
                                std::abs(weave.amplitude / wanted - 1) <= tolerance,
                                fmt::format("{:.3g} m/s^2", weave.amplitude)});
    return outcome;
}

}  // namespace

Maneuver weave() {
    return {.name = "weave",
            .title = "On-center weave",
            .standard = "ISO 13674-1",
            .summary = "The steering wheel weaves slowly about straight ahead: sensitivity, dead bands, lags, torque.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
