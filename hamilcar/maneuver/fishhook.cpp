// NHTSA's fishhook (Federal Register 68, No. 198, 2003-10-14, page 59250): from a straight drive with the foot off the throttle
// the steering wheel turns at 720 deg/s to 6.5 A, A the angle of slowly increasing steer at 0.3 g, and then as far to the other
// side: after 250 ms (fixed timing), or when the roll rate has died away to 1.5 deg/s (roll rate feedback). There it is held for
// 3 s. Faster and faster, until two wheels of a side lift off. With feedback each run is driven twice: the first time the wheel
// stays at its first angle and tells when the roll rate dies away.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/fishhook_run.hpp"
#include "hamilcar/maneuver/search.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"

namespace hamilcar {

namespace {

using fishhook_run::Run;

constexpr double factor = 6.5;      // of A [1]
constexpr double test_speed = 80;   // of slowly increasing steer [km/h]
constexpr double finest = 2;        // of the speed that is sought [km/h]
constexpr double slow_share = 0.2;  // of the maneuver that slowly increasing steer takes [1]
constexpr double heaviest = 4536;   // that NHTSA drives it with: 10 000 lb [kg]

std::vector<Setting> settings(const VehicleDescription&) {
    return {{"speed", "km/h", "the highest that is tried", 80, 20, 150},
            {"least_speed", "km/h", "the lowest that is tried", 56, 10, 150},
            {"step", "km/h", "between speeds, before the limit is bisected", 8, 1, 40},
            flag_setting("feedback", "counter-steer as the roll rate dies away; otherwise after 250 ms", true)};
}

// Speeds upward, both directions at each, until the vehicle tips; then between the last two.
class Ascent {
public:
    Ascent(TestRun& test, double angle)
        : test_(test), angle_(angle), max_(test.typed("speed")), step_(test.typed("step")) {
        const double min = test.typed("least_speed");
        count_ = std::ceil((max_ - min) / step_) + 1 + std::ceil(std::log2(std::max(step_ / finest, 1.0)));
        const auto next = [&](const Bracket& found) -> std::optional<double> {
            if (runs.empty()) return min;
            if (std::isnan(found.low) || found.low == max_) return {};
            return std::isnan(found.high) ? std::min(found.low + step_, max_) : found.middle();
        };
        narrow(speeds, finest, next, [&](double speed) { return try_speed(speed); });
    }

    std::vector<Run> runs;
    Recording last;
    Bracket speeds;  // without tip-up and with it [km/h]

private:
    // Whether it did not tip; nothing if a run broke off.
    std::optional<bool> try_speed(double speed) {
        bool tips = false;
        for (const double side : {1.0, -1.0}) {
            if (tips) break;
            Run run{.speed = speed, .side = side};
            const auto part = [&](double n) { return std::min(1.0, slow_share + (1 - slow_share) * n / (2 * count_)); };
            const double n = static_cast<double>(runs.size());
            Drive drive = fishhook_run::drive(test_, run, angle_, test_.is_on("feedback"), {part(n), part(n + 1)});
            if (!test_.take_energy(drive)) return {};
            runs.push_back(run);
            keep(drive, run);
            last = std::move(drive.recording);
            tips = run.tips;
        }
        return !tips;
    }

    // Only the replay of the latest run is kept, and of the latest that tipped.
    void keep(Drive& drive, const Run& run) {
        if (drive.stopped == Stopped::fell_over) test_.note("at {:g} km/h: {}", run.speed, drive.trouble);
        if (drive.replay.columns.empty()) return;
        (run.tips ? tipping_replay_ : replay_) = std::move(drive.replay);
        test_.outcome.runs.clear();
        for (const io::PageRun& replay : {replay_, tipping_replay_}) {
            if (!replay.columns.empty()) test_.outcome.runs.push_back(replay);
        }
    }

    TestRun& test_;
    double angle_;       // [rad]
    double max_, step_;  // [km/h]
    double count_;       // of speeds, about
    io::PageRun replay_, tipping_replay_;
};

void add_charts(TestRun& test, const Ascent& ascent) {
    std::vector<Run> runs = ascent.runs;
    std::ranges::stable_sort(runs, {}, &Run::speed);
    const auto least_load = [](const Run& run) { return 100 * run.lightest; };
    test.chart("Least load of a side", "speed [km/h]", "over its load standing [%]",
               over_runs_by_side(runs, &Run::side, &Run::speed, least_load));
    test.chart("Largest roll angle", "speed [km/h]", "roll angle [deg]",
               over_runs_by_side(runs, &Run::side, &Run::speed, &Run::roll));
    const std::string title = fmt::format("Last run, {:g} km/h", ascent.runs.back().speed);
    test.chart(title + ": steering wheel", "time [s]", "angle [deg]",
               {over_time(ascent.last, "steering wheel", channel::steering_wheel)});
    test.chart(title + ": roll", "time [s]", "roll angle [deg]", {over_time(ascent.last, "roll angle", channel::roll)});
}

void add_figures(TestRun& test, const Ascent& ascent, double angle) {
    double lightest = 1, lifted = 0, roll = 0, acceleration = 0;
    for (const Run& run : ascent.runs) {
        lightest = std::min(lightest, run.lightest), lifted = std::max(lifted, run.lifted);
        roll = std::max(roll, run.roll), acceleration = std::max(acceleration, run.lateral_acceleration);
    }
    test.figure("steering wheel angle", "deg", angle / degree, "each way");
    test.figure("highest speed without tip-up", "km/h", ascent.speeds.low, "in both directions");
    test.figure("lowest speed with tip-up", "km/h", ascent.speeds.high, "two wheels of a side lift off, or worse");
    test.figure("least load of a side", "%", 100 * lightest, "of its load standing, of all runs");
    test.figure("longest two-wheel lift", "s", lifted, "of all runs");
    test.figure("largest roll angle", "deg", roll, "of all runs");
    test.figure("largest lateral acceleration", "m/s^2", acceleration, "of the motor vehicle below 6 Hz, of all runs");
    test.figure("dwell", "s", ascent.runs.back().dwell, "of the steering wheel at its first angle, last run");
    const double tipped = ascent.speeds.high;
    test.verdict(fmt::format("no two-wheel lift of {:g} s or more up to {:g} km/h", fishhook_run::tip_up_time,
                             test.typed("speed")),
                 std::isnan(tipped),
                 std::isnan(tipped) ? fmt::format("{:.2g} s at most", lifted) : fmt::format("at {:g} km/h", tipped));
}

void run(TestRun& test) {
    if (test["least_speed"] > test["speed"]) {
        test.reject("least_speed", "expected at most 'speed', {:g} [km/h]", test.typed("speed"));
    }
    if (total_mass(test.vehicle) > heaviest) {
        test.note("the test is made for light vehicles of up to {:g} kg; this one is heavier", heaviest);
    }
    const auto slow = slow_steer(test, test_speed * kilometer_per_hour, {0, slow_share});
    if (!slow) return;
    const double lock = steering_lock(test.vehicle), wanted = factor * slow->angle * degree;
    const double angle = std::min(wanted, lock);
    if (angle == lock) {
        test.note("{:g} A would be {:.0f} deg, beyond the steering wheel's lock: it is turned to {:.0f} deg", factor,
                  wanted / degree, lock / degree);
    }
    const Ascent ascent(test, angle);
    if (test.outcome.failed) return;
    add_figures(test, ascent, angle);
    add_charts(test, ascent);
}

}  // namespace

Maneuver fishhook() {
    return {.name = "fishhook",
            .title = "Fishhook",
            .standard = "NHTSA dynamic rollover test",
            .summary =
                "The steering wheel jerked to one side and then all the way to the other: whether two wheels lift off.",
            .settings = settings,
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
