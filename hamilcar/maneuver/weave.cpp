// ISO 13674-1, on-center handling: the steering wheel weaves slowly about straight ahead. One output over another is a loop:
// its slope is a gain, its width what a driver feels as play. Characteristic values after Norman (1984, "Objective evaluation
// of on-center handling performance", SAE 840069).
#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/curves.hpp"
#include "hamilcar/analysis/spectrum.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

constexpr double past_the_end = 0.5;  // that the weave goes on, so that its last period is like the others [s]
constexpr double aside = 1;           // where gains off center are read [m/s^2]
constexpr double near = 0.25;         // about a level: of a slope's points, as a share of the amplitude [1]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {speed_setting(vehicle, 100, 80),
            acceleration_setting(vehicle, 2, 1, "of the weave's peaks"),
            {"frequency", "Hz", "of the weave", 0.2, 0.05, 1},
            {"periods", "", "that are evaluated, after one that is not", 3, 1, 20, SettingKind::whole}};
}

io::Curve loop_curve(const std::string& label, const Loop& loop) {
    return {.label = label, .x = {loop.x().begin(), loop.x().end()}, .y = {loop.y().begin(), loop.y().end()}};
}

// How much less lateral acceleration the vehicle has while it weaves than in steady driving, by linear theory [1].
double attenuation(const TestRun& test) {
    constexpr double nearly_none = 1e-3;  // [Hz]
    const Answer gain =
        theoretical_answer(test.vehicle, test["speed"], steered_outputs.back(), {nearly_none, test["frequency"]});
    return gain.frequency.empty() ? 1 : std::abs(gain.response[1]) / std::abs(gain.response[0]);
}

// Of the lateral acceleration, after the first period; NaN where the drive ended before [m/s^2].
double amplitude_of(const Recording& recording, double frequency) {
    const Series series = recording[channel::lateral_acceleration];
    const double from = straight_ahead + 1 / frequency;
    const auto highest = peak(series, Extreme::highest, from), lowest = peak(series, Extreme::lowest, from);
    return highest && lowest ? (highest->value - lowest->value) / 2 : not_shown;
}

// Whole periods.
struct Weave {
    std::span<const double> angle, acceleration, yaw_rate, torque;  // [deg], [m/s^2], [deg/s], [N m]
    double rate, frequency;                                         // of the rows, of the weave [Hz]
    double amplitude;                                               // of the lateral acceleration [m/s^2]
    double reach() const { return near * amplitude; }
    bool is_wide() const { return amplitude > aside + reach(); }
};

Weave weave_of(const TestRun& test, const Recording& recording) {
    const double frequency = test["frequency"], from = straight_ahead + 1 / frequency;
    const double to = straight_ahead + (1 + test["periods"]) / frequency - 0.5 / recording.rate();
    const auto part = [&](const char* channel) { return between(recording[channel], from, to).values; };
    return {part(channel::steering_wheel),
            part(channel::lateral_acceleration),
            part(channel::yaw_rate),
            part(channel::steering_torque),
            recording.rate(),
            frequency,
            amplitude_of(recording, frequency)};
}

void add_steering(TestRun& test, const Weave& weave) {
    const Loop by_acceleration(weave.acceleration, weave.angle), by_angle(weave.angle, weave.acceleration);
    test.figure("steering sensitivity", "m/s^2/deg", 1 / by_acceleration.slope(0, weave.reach()),
                "lateral acceleration over the angle, at none");
    test.figure("steering sensitivity at 1 m/s^2", "m/s^2/deg",
                weave.is_wide() ? 1 / by_acceleration.slope_aside(aside, weave.reach()) : not_shown,
                "the same off center");
    test.figure("angle dead band", "deg", by_acceleration.width(0), "the loop's width at no lateral acceleration");
    test.figure("lateral acceleration dead band", "m/s^2", by_angle.width(0), "the loop's height at no angle");
    const auto lag = [&](std::span<const double> output) {
        return -std::arg(response_at(weave.angle, output, weave.rate, weave.frequency)) /
               (2 * std::numbers::pi * weave.frequency);
    };
    const Loop yaw(weave.yaw_rate, weave.angle);
    test.figure("yaw rate gain", "deg/s/deg", 1 / yaw.slope(0, near * std::ranges::max(weave.yaw_rate)),
                "over the angle, at none");
    test.figure("lateral acceleration lag", "s", lag(weave.acceleration), "behind the steering wheel");
    test.figure("yaw rate lag", "s", lag(weave.yaw_rate), "behind the steering wheel");
    test.chart("lateral acceleration", "steering wheel angle [deg]", "lateral acceleration [m/s^2]",
               {loop_curve("lateral acceleration", by_angle)});
}

void add_torque(TestRun& test, const Weave& weave) {
    const Loop by_acceleration(weave.acceleration, weave.torque), by_angle(weave.angle, weave.torque),
        by_torque(weave.torque, weave.acceleration);
    const bool wide = weave.is_wide();
    test.figure("torque gradient", "N m/(m/s^2)", by_acceleration.slope(0, weave.reach()),
                "over lateral acceleration, at none");
    test.figure("torque gradient at 1 m/s^2", "N m/(m/s^2)",
                wide ? by_acceleration.slope_aside(aside, weave.reach()) : not_shown, "the same off center");
    test.figure("steering stiffness", "N m/deg", by_angle.slope(0, near * std::ranges::max(weave.angle)),
                "torque over the angle, straight ahead");
    test.figure("torque at 1 m/s^2", "N m",
                wide ? (by_acceleration.at(aside, true) - by_acceleration.at(-aside, false)) / 2 : not_shown,
                "while lateral acceleration grows");
    test.figure("torque dead band", "N m", by_acceleration.width(0), "the loop's height at no lateral acceleration");
    test.figure("returnability", "m/s^2", by_torque.width(0) / 2,
                "lateral acceleration that is left at no torque: half the loop's width");
    test.chart("steering torque", "lateral acceleration [m/s^2]", "steering torque [N m]",
               {loop_curve("steering torque", by_acceleration)});
    test.chart("steering torque over angle", "steering wheel angle [deg]", "steering torque [N m]",
               {loop_curve("steering torque over angle", by_angle)});
}

void run(TestRun& test) {
    const double speed = test["speed"], frequency = test["frequency"], wanted = test["lateral_acceleration"];
    const double angle = angle_for(test, speed, wanted / attenuation(test));
    const auto weaving = [&](double amplitude) {
        const auto angle_at = [&](double time) {
            const double since = std::max(time - straight_ahead, 0.0);
            return amplitude * std::sin(2 * std::numbers::pi * frequency * since);
        };
        return tabulated(angle_at, straight_ahead + (1 + test["periods"]) / frequency + past_the_end);
    };
    const auto reached = [&](const Recording& recording) { return amplitude_of(recording, frequency); };
    Drive drive = drive_aimed(test, {wanted, weaving, reached, 0.01}, speed, angle);
    if (!test.take_whole(drive)) return;
    const Weave weave = weave_of(test, drive.recording);
    test.figure("steering wheel angle", "deg", std::ranges::max(weave.angle), "amplitude");
    test.figure("lateral acceleration", "m/s^2", weave.amplitude, "amplitude");
    add_steering(test, weave);
    add_torque(test, weave);
    judge_speed(test, drive.recording, straight_ahead, drive.recording.end());
    judge_lateral_acceleration(test, "lateral acceleration", weave.amplitude);
}

}  // namespace

Maneuver weave() {
    return {.name = "weave",
            .title = "On-center weave",
            .standard = "ISO 13674-1",
            .summary = "The steering wheel weaves slowly about straight ahead: sensitivity, dead bands, lags, torque.",
            .settings = settings,
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
