// A stop straight ahead with all that the brakes give, engine disconnected: the type-0 test of UN R13-H for cars and of
// UN R13 for trucks, ISO 21994's stopping distance where there is an anti-lock system.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/braking.hpp"
#include "hamilcar/maneuver/catalog.hpp"

namespace hamilcar {

namespace {

// Stopping distance linear v + v^2 / square with v in km/h, and the deceleration beside it. Cold brakes: UN R13-H, annex 3,
// 2.1.1; UN R13, annex 4, 2.1.1 (N2, N3).
struct Limits {
    double linear, square, developed;  // [m h/km], [(km/h)^2/m], [m/s^2]
    double distance(double speed) const {
        const double v = speed / kilometer_per_hour;
        return linear * v + v * v / square;
    }
};
Limits limits(bool heavy, bool engine_drives) {
    if (heavy) return engine_drives ? Limits{0.15, 103.5, 4.0} : Limits{0.15, 130, 5.0};
    return engine_drives ? Limits{0.1, 1 / 0.0067, 5.76} : Limits{0.1, 1 / 0.0060, 6.43};
}
constexpr double largest_heading = 15;  // off the straight line, both regulations [deg]
constexpr double simultaneous = 0.1;    // as good as at once, in the order of lock, both regulations [s]
constexpr double high_friction = 0.8;   // factor from which the regulations' limits mean something [1]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {
        braking::initial_speed_setting(vehicle, 100, 60, 250),
        {"pedal", "%", "of its full travel", 100, 5, 100},
        braking::rise_setting(vehicle),
        {"friction", "", "of the road, times the tires' own", 1, 0.05, 1.5},
        flag_setting("engine_connected", "a gear stays in; otherwise the gearbox goes to neutral with the pedal",
                     false),
    };
}

std::string spoken(double lock) {
    return std::isnan(lock) ? "does not lock" : fmt::format("locks after {:.3f} s", lock);
}

// The order in which the motor vehicle's axles lock under a pedal that goes down slowly: the rear before the front one would
// turn the vehicle round. An axle is locked with its second wheel: on one wheel the other still holds it straight.
void add_lock_order(TestRun& test, const braking::Stop& stop) {
    std::vector<Axle> all = axles(test.vehicle);
    std::erase_if(all, [](const Axle& axle) { return axle.of_trailer; });
    if (all.size() < 2) return;
    const double front = braking::nth_lock(all.front(), stop, 2);
    double rear = not_shown;
    for (std::size_t i = 1; i < all.size(); ++i) rear = std::fmin(rear, braking::nth_lock(all[i], stop, 2));
    test.figure("lock of the front axle, slow pedal", "s", front, "from the pedal to its second wheel");
    test.figure("lock of the rear axles, slow pedal", "s", rear, "likewise");
    if (is_heavy(test.vehicle)) return;  // of these UN R13 asks something else, with an anti-lock system
    test.verdict("under a slow pedal no rear axle locks before the front axle (UN R13-H annex 5, FMVSS 135 S7.2)",
                 std::isnan(rear) || front <= rear + simultaneous,
                 fmt::format("front {}, rear {}{}", spoken(front), spoken(rear),
                             front > rear && front <= rear + simultaneous ? ": within 0.1 s, at once" : ""));
}

void add_verdicts(TestRun& test, const braking::Stop& stop) {
    const bool heavy = is_heavy(test.vehicle);
    const Limits limit = limits(heavy, test.is_on("engine_connected"));
    const std::string regulation = heavy ? "UN R13" : "UN R13-H";
    if (test["friction"] >= high_friction) {
        const double allowed = limit.distance(stop.initial_speed);
        test.verdict(fmt::format("stopping distance at most {:.1f} m ({})", allowed, regulation),
                     stop.distance <= allowed, fmt::format("{:.1f} m", stop.distance));
        test.verdict(
            fmt::format("mean fully developed deceleration at least {:.2f} m/s^2 ({})", limit.developed, regulation),
            stop.developed >= limit.developed, fmt::format("{:.2f} m/s^2", stop.developed));
    } else {
        test.note("the regulations' distances are for roads of high friction: no verdict on so little");
    }
    test.verdict("heading within 15 deg", std::abs(stop.heading) <= largest_heading,
                 fmt::format("{:.2f} deg", stop.heading));
    braking::judge_lane(test, stop);
}

void add_figures(TestRun& test, const Recording& recording, const braking::Stop& stop) {
    const double share = test["speed"] / stop.initial_speed;
    const Series pitch = recording[channel::pitch];
    const auto dive = peak(pitch, Extreme::highest, braking::approach);
    test.figure("initial speed", "km/h", stop.initial_speed / kilometer_per_hour, "as the pedal begins to move");
    braking::add_figures(test, stop);
    test.figure("stopping distance from the nominal speed", "m", stop.distance * share * share,
                "times the square of the nominal over the initial speed");
    test.figure("mean deceleration", "m/s^2", stop.initial_speed * stop.initial_speed / (2 * stop.distance),
                "v^2 / (2 s) from the pedal to standstill");
    test.figure("dive", "deg", dive ? dive->value - interpolated(pitch, braking::approach) : not_shown,
                "most that the pitch angle grows, nose down");
    test.figure("change of heading", "deg", stop.heading, "largest, to the left positive");
}

// With the pedal pressed within `rise` [s].
Drive braked(const TestRun& test, double rise, const DriveOptions& options) {
    // A locked wheel holds about three quarters of its peak, a truck's less; this leaves time.
    constexpr double poor = 0.35;  // [1]
    const double held = poor * test["friction"] * standard_gravity;
    ScenarioDescription scenario = braking::stop(test, rise, test.is_on("engine_connected"),
                                                 std::min(0.5 * braking::asked_deceleration(test), held));
    scenario.road.friction *= test["friction"];
    Drive drive = test.drive(scenario, options);
    braking::end_at_standstill(drive);
    return drive;
}

// So that the first axle locks about there after the pedal begins to move (UN R13-H annex 5: between 0.5 and 1 s).
double slow_rise(const TestRun& test) {
    constexpr double first_lock = 0.75;            // [s]
    constexpr double shortest = 0.2, longest = 8;  // [s]
    const double held = test["friction"] * standard_gravity;
    return std::clamp(first_lock * braking::asked_deceleration(test) / held, shortest, longest);
}

void run(TestRun& test) {
    Drive slow = braked(test, slow_rise(test), {.share = {0, 0.5}, .replay = false});
    if (!test.take_whole(slow)) return;
    Drive drive = braked(test, test["pedal_rise"], {.share = {0.5, 1}});
    if (!test.take_whole(drive)) return;
    const braking::Stop stop = braking::evaluated(test.vehicle, drive.recording);
    add_figures(test, drive.recording, stop);
    if (!braking::check_stop(test, drive, stop)) return;
    add_verdicts(test, stop);
    add_lock_order(test, braking::evaluated(test.vehicle, slow.recording));
    braking::add_charts(test, drive.recording);
}

}  // namespace

Maneuver straight_braking() {
    return {
        .name = "straight_braking",
        .title = "Braking straight ahead",
        .standard = "UN R13-H / UN R13 type-0, ISO 21994",
        .summary = "A stop from a speed with the pedal pressed at once, and which axle locks first under a slow pedal.",
        .settings = settings,
        .unsupported_reason = needs_brakes,
        .run = run};
}

}  // namespace hamilcar
