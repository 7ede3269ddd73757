// ISO 9816: from a steady circle the throttle is released, while the steering wheel stays where it is. A vehicle that turns in
// surprises its driver; the values after one and two seconds say how much.
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/circle_braking.hpp"

namespace hamilcar {

namespace {

void add_figures(TestRun& test, const Recording& recording, double after) {
    const auto run = circle_braking::evaluated(recording, wheel_names(test.vehicle), after);
    const std::string when = fmt::format(" after {:g} s", after);
    test.figure("yaw rate ratio" + when, "", run.yaw_rate_ratio,
                "yaw rate over that of a vehicle that stays on its circle");
    test.figure("lateral acceleration ratio" + when, "", run.acceleration_ratio, "likewise");
    test.figure("path deviation" + when, "m", run.deviation, "of the center of mass from the circle, inward positive");
    test.figure("sideslip change" + when, "deg", run.sideslip_change, "since the throttle was released");
    test.figure("deceleration" + when, "m/s^2", run.deceleration, "mean since then");
    test.figure("largest yaw acceleration" + when, "deg/s^2", run.largest_yaw_acceleration, "either way, until then");
}

void run(TestRun& test) {
    constexpr double share = 0.7;  // of the maneuver that the circle takes
    test.outcome.course.line = circle(test["radius"]);
    const auto settled = circle_braking::settle(test, share);
    if (!settled) return;
    Drive drive = test.drive(circle_braking::braking(test, *settled, 0), {.share = {share, 1}});
    drive.warnings.clear();  // that a rolling car does not hold its speed
    if (!test.take(drive)) return;
    circle_braking::add_steady_figures(test, circle_braking::steady(*settled));
    for (const double after : {1.0, 2.0}) add_figures(test, drive.recording, after);
    circle_braking::add_time_charts(test, "with the throttle released", {{"throttle released", &drive.recording}});
}

}  // namespace

Maneuver power_off_in_turn() {
    return {.name = "power_off_in_turn",
            .title = "Power-off reaction in a turn",
            .standard = "ISO 9816",
            .summary =
                "From a steady circle the throttle is released with the steering held: whether the vehicle turns in.",
            .settings = [](const VehicleDescription& vehicle) { return circle_braking::circle_settings(vehicle, 4); },
            .unsupported_reason = needs_steering_and_drive,
            .run = run,
            .course = [](const auto&, const Settings& chosen) { return Course{.line = circle(chosen.at("radius"))}; }};
}

}  // namespace hamilcar
