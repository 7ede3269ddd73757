// Braking with one side on ice: ISO 14512 (cars) and ISO 16234 (heavy vehicles). The friction that is left on the other side
// turns the vehicle; the test shows how much of that happens before a driver could answer, in the first second with the
// steering held. With a driver who steers against it, it shows how much steering that takes and how long the way is.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/braking.hpp"
#include "hamilcar/maneuver/catalog.hpp"

namespace hamilcar {

namespace {

constexpr double first_second = 1;  // that a driver needs to answer, as in ISO 14512 [s]
// Steering that UN R13-H (annex 6, 5.3.6) leaves to the driver of a car with an anti-lock system: in the first two
// seconds, and in all.
constexpr double early = 2;                                    // [s]
constexpr double largest_early = 120, largest_steering = 240;  // [deg]
constexpr double spun = 60;                                    // of heading: past any correction [deg]

// ISO 14512 is for all braking up to where a wheel on the good side locks. Half a g asked for is below that.
double default_pedal(const VehicleDescription& vehicle) {
    constexpr double asked = 0.5;  // [g]
    constexpr double grain = 5;    // [%]
    const double full = brake_force_per_command(vehicle);
    if (full <= 0) return 100;
    const double share = asked * total_mass(vehicle) * standard_gravity / full;
    return std::clamp(std::round(share * 100 / grain) * grain, grain, 100.0);
}

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {
        braking::initial_speed_setting(vehicle, 80, 50, 200),
        {"pedal", "%", "of its full travel; the default asks for about half a g", default_pedal(vehicle), 5, 100},
        braking::rise_setting(vehicle),
        {"friction", "", "of the good side, times the tires' own", 1, 0.1, 1.5},
        {"low_friction", "", "of the other side, likewise", 0.2, 0.02, 1.5},
        choice_setting("low_side", "that is slippery", {{"left", 1}, {"right", -1}}, "left"),
        flag_setting("steering", "on the way to standstill the driver corrects; otherwise the steering is held", true),
    };
}

RoadDescription split_road(const TestRun& test) {
    RoadDescription out = test.options.road;
    FrictionPatchDescription slippery;
    slippery.friction = test["low_friction"] / test["friction"];
    (test.choice("low_side") == "left" ? slippery.right : slippery.left) = 0;
    out.friction *= test["friction"];
    out.patches.push_back(slippery);
    return out;
}

void add_response(TestRun& test, const Recording& recording) {
    const std::vector<double> over_ground = braking::ground_speed(recording),
                              heading = continued(recording[channel::heading].values);
    const Series yaw{heading, recording.rate()}, speed{over_ground, recording.rate()};
    const Series rate = recording[channel::yaw_rate], y = recording[channel::y];
    const double from = braking::approach, to = from + first_second;
    const auto fastest = peak(rate, Extreme::largest, from, to);
    test.figure("yaw rate after 1 s", "deg/s", interpolated(rate, to), "steering held; to the left positive");
    test.figure("peak yaw rate in the first second", "deg/s", fastest ? fastest->value : not_shown, "likewise");
    test.figure("change of heading in the first second", "deg", interpolated(yaw, to) - interpolated(yaw, from),
                "likewise");
    test.figure("lateral offset after 1 s", "m", interpolated(y, to) - interpolated(y, from),
                "of the center of mass, to the left positive");
    test.figure("mean deceleration in the first second", "m/s^2",
                (interpolated(speed, from) - interpolated(speed, to)) / first_second, "speed lost over time");
    test.chart("Yaw rate, steering held", "time from the pedal [s]", "yaw rate [deg/s]",
               {over_time(recording, "", channel::yaw_rate, 1, from)})
        .vertical_marks = {{first_second, "1 s"}};
}

// What the driver did with the steering wheel, and whether the vehicle kept to its lane.
void add_correction(TestRun& test, const Recording& recording, const braking::Stop& stop) {
    const Series wheel = recording[channel::steering_wheel];
    const auto soon = peak(wheel, Extreme::largest, braking::approach, braking::approach + early);
    const auto largest = peak(wheel, Extreme::largest, braking::approach);
    const double in_time = soon ? std::abs(soon->value) : 0, in_all = largest ? std::abs(largest->value) : 0;
    test.figure("steering in the first 2 s", "deg", in_time, "largest angle of the steering wheel");
    test.figure("steering in all", "deg", in_all, "likewise");
    test.verdict("steering at most 120 deg in the first 2 s (UN R13-H, with anti-lock system)",
                 in_time <= largest_early, fmt::format("{:.0f} deg", in_time));
    test.verdict("steering at most 240 deg in all (UN R13-H, with anti-lock system)", in_all <= largest_steering,
                 fmt::format("{:.0f} deg", in_all));
    braking::judge_lane(test, stop);
}

void add_path_charts(TestRun& test, const Recording& recording) {
    if (recording.has(channel::steering_wheel)) {
        test.chart("Steering wheel", "time from the pedal [s]", "angle [deg]",
                   {over_time(recording, "", channel::steering_wheel, 1, braking::approach)});
    }
    test.chart("Path", "x [m]", "y [m]", {over_channel(recording, channel::x, "center of mass", channel::y)})
        .horizontal_marks = {{braking::lane_width / 2, "lane"}, {-braking::lane_width / 2, ""}};
}

ScenarioDescription split_stop(const TestRun& test, bool corrects) {
    constexpr double poor = 0.5;  // what locked wheels hold at worst [1]
    const double held = poor * (test["friction"] + test["low_friction"]) / 2 * standard_gravity;
    ScenarioDescription scenario =
        braking::stop(test, test["pedal_rise"], false, 0.5 * std::min(braking::asked_deceleration(test), held));
    scenario.road = split_road(test);
    if (corrects) follow_straight_line(scenario, test.vehicle, test["speed"] * scenario.duration);
    return scenario;
}

// The first second with the steering held, whatever comes after.
bool hold_at_first(TestRun& test, double share) {
    ScenarioDescription scenario = split_stop(test, false);
    constexpr double reserve = 0.1;  // so that there are rows up to the second's end [s]
    scenario.duration = braking::approach + first_second + reserve;
    Drive drive = test.drive(scenario, {.share = {0, share}, .replay = false});
    if (!test.take_whole(drive)) return false;
    add_response(test, drive.recording);
    return true;
}

void run(TestRun& test) {
    constexpr double at_first = 0.2;  // of the progress
    const bool steers = needs_steering(test.vehicle).empty(), corrects = test.is_on("steering") && steers;
    if (test.is_on("steering") && !steers) test.note("{}: straight on", needs_steering(test.vehicle));
    if (!hold_at_first(test, at_first)) return;
    Drive drive = test.drive(split_stop(test, corrects), {.share = {at_first, 1}});
    braking::end_at_standstill(drive);
    const bool whole = test.take_whole(drive);
    const braking::Stop stop = braking::evaluated(test.vehicle, drive.recording);
    braking::add_figures(test, stop);
    test.figure("largest change of heading", "deg", stop.heading, "on the way to standstill");
    test.figure("farthest wheel beside the line", "m", stop.beside, "the middle of its outer tire");
    if (corrects && whole) add_correction(test, drive.recording, stop);
    if (std::abs(stop.heading) > spun) test.note("the vehicle turned round");
    if (whole) braking::check_stop(test, drive, stop);
    add_path_charts(test, drive.recording);
    braking::add_charts(test, drive.recording);
}

}  // namespace

Maneuver split_braking() {
    return {.name = "split_braking",
            .title = "Braking on split friction",
            .standard = "ISO 14512 / ISO 16234",
            .summary =
                "A stop with one side on a slippery surface: how far the vehicle turns before a driver could answer.",
            .settings = settings,
            .unsupported_reason = needs_brakes,
            .run = run};
}

}  // namespace hamilcar
