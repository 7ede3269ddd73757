// ISO 7401, step input: the steering wheel jumps to an angle and stays. How fast, how far beyond and where the vehicle follows.
//
// Times count from when the steering wheel has turned by half. The response time ends at 90 percent of the steady value, the
// peak response time at the peak; the TB value is the yaw rate's peak response time times the steady sideslip angle.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/amplitude.hpp"
#include "hamilcar/maneuver/catalog.hpp"

namespace hamilcar {

namespace {

constexpr double window = 1;      // of the steady values, at the end [s]
constexpr double risen = 0.9;     // of the steady value
constexpr double visible = 1e-3;  // overshoot below which there is no peak
constexpr double slowed = 0.1;    // of the speed before the step: a vehicle that loses more has no steady turn
constexpr double latest = 2, latest_heavy = 4;  // that a peak answers the step, after half of it; later it drifts [s]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {speed_setting(vehicle, 80, 80),
            acceleration_setting(vehicle, 4, 2, "in the steady turn after the step"),
            {"rate", "deg/s", "of the steering wheel, in the mean over its turn", 400, 10, 2000},
            {"duration", "s", "from the step on", is_heavy(vehicle) ? 10.0 : 6.0, 3, 60}};
}

double steady(const Recording& recording, const char* channel) {
    return mean(between(recording[channel], recording.end() - window).values);
}

// One output after the step, in its channel's unit.
struct StepResponse {
    double steady;
    double response_time = not_shown, peak_time = not_shown;  // [s]
    double overshoot = 0;                                     // over the steady value, less one [1]
};

StepResponse response_of(const Recording& recording, const char* channel, double half) {
    StepResponse out{steady(recording, channel)};
    Series series = recording[channel];
    const std::vector<double> relative = scaled(series.values, 1 / out.steady);
    series.values = relative;
    if (const auto there = first_crossing(series, risen, Crossing::rising, straight_ahead)) {
        out.response_time = *there - half;
    }
    const auto highest = peak(series, Extreme::highest, straight_ahead, recording.end() - window);
    if (highest && highest->value > 1 + visible) {
        out.peak_time = highest->time - half, out.overshoot = highest->value - 1;
    }
    return out;
}

void add_figures(TestRun& test, const std::string& of, const std::string& unit, const StepResponse& response,
                 double angle) {
    test.figure("steady " + of, unit, response.steady, "in the last second");
    test.figure(of + " gain", unit + "/deg", response.steady / angle, "steady, per angle of the steering wheel");
    test.figure(of + " response time", "s", response.response_time, "from half the steering to 90 percent");
    test.figure(of + " peak response time", "s", response.peak_time, "from half the steering to the peak");
    test.figure(of + " overshoot", "%", 100 * response.overshoot, "of the peak over the steady value");
}

void add_charts(TestRun& test, const Recording& recording) {
    const auto share = [&](const std::string& label, const char* channel) {
        return over_time(recording, label, channel, 1 / steady(recording, channel));
    };
    test.chart("step response", "time [s]", "of the steady value [1]",
               {share("steering wheel angle", channel::steering_wheel), share("yaw rate", channel::yaw_rate),
                share("lateral acceleration", channel::lateral_acceleration), share("roll angle", channel::roll)});
    const auto add = [&](const std::string& what, const std::string& unit, const char* channel) {
        test.chart(what + " over time", "time [s]", what + " [" + unit + "]", {over_time(recording, what, channel)});
    };
    add("steering wheel angle", "deg", channel::steering_wheel);
    add("yaw rate", "deg/s", channel::yaw_rate);
    add("lateral acceleration", "m/s^2", channel::lateral_acceleration);
    add("sideslip angle", "deg", channel::sideslip);
}

// What is read off is the answer to a step only if the vehicle turns steadily in the end, at the speed of the beginning.
void add_verdicts(TestRun& test, const Recording& recording, const StepResponse& yaw, const StepResponse& lateral) {
    judge_speed(test, recording);
    const Series speed = recording[channel::speed];
    const double lost = 1 - steady(recording, channel::speed) / speed.values[sample_at(speed, straight_ahead)];
    test.verdict(fmt::format("at most {:g} percent of the speed before the step lost in the last second", 100 * slowed),
                 lost <= slowed, fmt::format("{:.1f} percent", std::max(0.0, 100 * lost)));
    const double allowed = is_heavy(test.vehicle) ? latest_heavy : latest;
    judge_lateral_acceleration(test, "steady lateral acceleration", lateral.steady);
    const auto spoken = [](double time) {
        return std::isnan(time) ? std::string("no peak") : fmt::format("{:.2f} s", time);
    };
    test.verdict(fmt::format("no peak of yaw rate or lateral acceleration later than {:g} s", allowed),
                 !(yaw.peak_time > allowed || lateral.peak_time > allowed),
                 fmt::format("yaw rate {}, lateral acceleration {}", spoken(yaw.peak_time), spoken(lateral.peak_time)));
}

void evaluate(TestRun& test, const Recording& recording) {
    const Series wheel = recording[channel::steering_wheel];
    const double angle = wheel.values.back();
    const double half = first_crossing(wheel, angle / 2, Crossing::rising).value_or(straight_ahead);
    const StepResponse yaw = response_of(recording, channel::yaw_rate, half);
    const StepResponse lateral = response_of(recording, channel::lateral_acceleration, half);
    const StepResponse roll = response_of(recording, channel::roll, half);
    const double sideslip = steady(recording, channel::sideslip);
    test.figure("steering wheel angle", "deg", angle, "of the step");
    add_figures(test, "yaw rate", "deg/s", yaw, angle);
    add_figures(test, "lateral acceleration", "m/s^2", lateral, angle);
    test.figure("steady roll angle", "deg", roll.steady, "in the last second");
    test.figure("roll overshoot", "%", 100 * roll.overshoot, "of the peak over the steady value");
    test.figure("steady sideslip", "deg", sideslip, "of the center of mass");
    test.figure("TB value", "deg s", yaw.peak_time * std::abs(sideslip),
                "yaw rate's peak response time times steady sideslip");
    add_verdicts(test, recording, yaw, lateral);
    add_charts(test, recording);
}

void run(TestRun& test) {
    const Amplitude amplitude = amplitude_for(test.vehicle, test["speed"], test["lateral_acceleration"]);
    const auto step = [&](double angle) -> SignalDescription {
        const double turning = std::abs(angle) / test["rate"];
        const double end = straight_ahead + std::max(test["duration"], turning + 2 * window);
        return {.time = {0, straight_ahead, straight_ahead + turning, end}, .value = {0, 0, angle, angle}};
    };
    const auto reached = [](const Recording& recording) { return steady(recording, channel::lateral_acceleration); };
    Drive drive =
        drive_aimed(test, {amplitude.lateral_acceleration, step, reached, 0.005}, test["speed"], amplitude.angle);
    std::string end;
    if (test.take_whole(drive)) {
        evaluate(test, drive.recording);
        end = fmt::format("; the last second had {:.3g} m/s^2 at {:.3g} km/h", reached(drive.recording),
                          drive.recording[channel::speed].values.back() / kilometer_per_hour);
    }
    if (!amplitude.note.empty()) test.outcome.notes.push_back(amplitude.note + end);
}

}  // namespace

Maneuver step_steer() {
    return {.name = "step_steer",
            .title = "Step input of the steering wheel",
            .standard = "ISO 7401",
            .summary = "The steering wheel jumps to an angle: response times, overshoot and steady gains.",
            .settings = settings,
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
