// NHTSA's fishhook (Federal Register 68, No. 198, 2003-10-14, page 59250): from a straight drive with the foot off the throttle
// the steering wheel turns at 720 deg/s to 6.5 A, A the angle of slowly increasing steer at 0.3 g, and then as far to the other
// side: after 250 ms (fixed timing), or when the roll rate has died away to 1.5 deg/s (roll rate feedback). There it is held for
// 3 s. Faster and faster, until two wheels of a side lift off. With feedback each run is driven twice: the first time the wheel
// stays at its first angle and tells when the roll rate dies away.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/fishhook_run.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar {

namespace {

using fishhook_run::Fishhook, fishhook_run::Run;

constexpr double factor = 6.5;      // of A [1]
constexpr double test_speed = 80;   // of slowly increasing steer [km/h]
constexpr double finest = 2;        // of the speed that is sought [km/h]
constexpr double slow_share = 0.2;  // of the maneuver that slowly increasing steer takes [1]
constexpr double heaviest = 4536;   // that NHTSA drives it with: 10 000 lb [kg]
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

std::vector<Setting> settings(const VehicleDescription&) {
    return {
        {"speed", "km/h", "the highest that is tried", 80, 20, 150},
        {"least_speed", "km/h", "the lowest that is tried", 56, 10, 150},
        {"step", "km/h", "between speeds, before the limit is bisected", 8, 1, 40},
        {"feedback", "", "1: counter-steer as the roll rate dies away; 0: after 250 ms", 1, 0, 1, SettingKind::toggle}};
}

// Speeds upward, both directions at each, until the vehicle tips; then between the last two.
class Ascent {
public:
    Ascent(const Settings& settings, const ManeuverOptions& options, const Fishhook& fishhook, Outcome& outcome)
        : least_(settings.at("least_speed")),
          most_(settings.at("speed")),
          step_(settings.at("step")),
          keep_runs_(options.keep_runs),
          fishhook_(fishhook),
          outcome_(outcome) {
        count_ = std::ceil((most_ - least_) / step_) + 1 + std::ceil(std::log2(std::max(step_ / finest, 1.0)));
    }

    // False if a run broke off.
    bool go() {
        for (double speed = least_; std::isnan(tipped_); speed = std::min(speed + step_, most_)) {
            if (!try_speed(speed)) return false;
            if (speed == most_) break;
        }
        while (!std::isnan(tipped_) && !std::isnan(passed_) && tipped_ - passed_ > finest) {
            if (!try_speed(0.5 * (passed_ + tipped_))) return false;
        }
        return true;
    }

    const std::vector<Run>& runs() const { return runs_; }
    const History& last() const { return last_; }
    double passed() const { return passed_; }
    double tipped() const { return tipped_; }

private:
    bool try_speed(double speed) {
        bool tips = false;
        for (const double side : {1.0, -1.0}) {
            Run run{.speed = speed, .side = side};
            const auto part = [&](double n) { return std::min(1.0, slow_share + (1 - slow_share) * n / (2 * count_)); };
            const double n = static_cast<double>(runs_.size());
            Trial trial = fishhook_.drive(run, keep_runs_, part(n), part(n + 1));
            if (!add_search_trial(outcome_, trial)) return false;
            runs_.push_back(run);
            last_ = trial.history;
            keep(std::move(trial), run);
            tips = tips || run.tips;
            if (tips) break;
        }
        (tips ? tipped_ : passed_) = speed;
        return true;
    }

    // Only the film of the latest run is kept, and of the latest that tipped.
    void keep(Trial trial, const Run& run) {
        if (trial.stopped == Stopped::fell_over) {
            outcome_.notes.push_back(fmt::format("at {:g} km/h: {}", run.speed, trial.trouble));
        }
        if (trial.film.columns.empty()) return;
        (run.tips ? tipping_film_ : film_) = std::move(trial.film);
        outcome_.runs.clear();
        for (const io::PageRun& film : {film_, tipping_film_}) {
            if (!film.columns.empty()) outcome_.runs.push_back(film);
        }
    }

    double least_, most_, step_, count_;
    bool keep_runs_;
    const Fishhook& fishhook_;
    Outcome& outcome_;
    std::vector<Run> runs_;
    History last_;
    io::PageRun film_, tipping_film_;
    double passed_ = nowhere, tipped_ = nowhere;  // [km/h]
};

template <class Value>
io::Chart over_speed(const std::vector<Run>& runs, const std::string& title, const std::string& label, Value&& value) {
    io::Chart chart{.title = title, .x_label = "speed [km/h]", .y_label = label};
    std::vector<Run> sorted = runs;
    std::ranges::stable_sort(sorted, {}, &Run::speed);
    for (const double side : {1.0, -1.0}) {
        io::Curve curve{.label = side > 0 ? "left first" : "right first", .points = true};
        for (const Run& run : sorted) {
            if (run.side == side) curve.x.push_back(run.speed), curve.y.push_back(value(run));
        }
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

void add_charts(const Ascent& ascent, Outcome& outcome) {
    outcome.charts.push_back(over_speed(ascent.runs(), "Least load of a side", "over its load standing [%]",
                                        [](const Run& run) { return 100 * run.lightest; }));
    outcome.charts.push_back(over_speed(ascent.runs(), "Largest roll angle", "roll angle [deg]",
                                        [](const Run& run) { return run.roll / degree; }));
    const History& h = ascent.last();
    const std::string title = fmt::format("Last run, {:g} km/h", ascent.runs().back().speed);
    outcome.charts.push_back(
        {.title = title + ": steering wheel",
         .x_label = "time [s]",
         .y_label = "angle [deg]",
         .curves = {{.label = "steering wheel", .x = h.time, .y = straight::scaled(h.steering_wheel, 1 / degree)}}});
    outcome.charts.push_back(
        {.title = title + ": roll",
         .x_label = "time [s]",
         .y_label = "roll angle [deg]",
         .curves = {{.label = "roll angle", .x = h.time, .y = straight::scaled(h.roll, 1 / degree)}}});
}

// Returns the longest two-wheel lift [s].
double add_figures(const Ascent& ascent, double angle, Outcome& outcome) {
    double lightest = 1, lifted = 0, roll = 0, acceleration = 0;
    for (const Run& run : ascent.runs()) {
        lightest = std::min(lightest, run.lightest), lifted = std::max(lifted, run.lifted);
        roll = std::max(roll, run.roll), acceleration = std::max(acceleration, run.lateral_acceleration);
    }
    outcome.figures.push_back({"steering wheel angle", "deg", "each way", angle / degree});
    outcome.figures.push_back({"highest speed without tip-up", "km/h", "in both directions", ascent.passed()});
    outcome.figures.push_back(
        {"lowest speed with tip-up", "km/h", "two wheels of a side lift off, or worse", ascent.tipped()});
    outcome.figures.push_back({"least load of a side", "%", "of its load standing, of all runs", 100 * lightest});
    outcome.figures.push_back({"longest two-wheel lift", "s", "of all runs", lifted});
    outcome.figures.push_back({"largest roll angle", "deg", "of all runs", roll / degree});
    outcome.figures.push_back(
        {"largest lateral acceleration", "m/s^2", "of the motor vehicle below 6 Hz, of all runs", acceleration});
    outcome.figures.push_back(
        {"dwell", "s", "of the steering wheel at its first angle, last run", ascent.runs().back().dwell});
    return lifted;
}

Outcome drive_all(const VehicleDescription& vehicle, const Settings& settings, const ManeuverOptions& options) {
    if (settings.at("least_speed") > settings.at("speed")) {
        throw io::Error(
            io::ExitCode::bad_file,
            fmt::format("setting 'least_speed' of maneuver 'fishhook' = {:g}: expected at most 'speed', {:g} [km/h]",
                        settings.at("least_speed"), settings.at("speed")),
            "maneuver.settings.least_speed");
    }
    Outcome outcome;
    if (straight::total_mass(vehicle) > heaviest) {
        outcome.notes.push_back(
            fmt::format("the test is made for light vehicles of up to {:g} kg; this one is heavier", heaviest));
    }
    const SlowSteer test = slow_steer(vehicle, options, test_speed * kilometer_per_hour, 0, slow_share, outcome);
    if (test.failed) {
        outcome.failed = test.failed;
        return outcome;
    }
    add_slow_steer(test, outcome);
    const double lock = steering_lock(vehicle), angle = std::min(factor * test.angle, lock);
    if (angle == lock) {
        outcome.notes.push_back(
            fmt::format("{:g} A would be {:.0f} deg, beyond the steering wheel's lock: it is turned to {:.0f} deg",
                        factor, factor * test.angle / degree, lock / degree));
    }
    const Fishhook fishhook(vehicle, options, angle, settings.at("feedback") == 1);
    Ascent ascent(settings, options, fishhook, outcome);
    if (!ascent.go()) return outcome;
    const double lifted = add_figures(ascent, angle, outcome), tipped = ascent.tipped();
    outcome.verdicts.push_back(
        {fmt::format("no two-wheel lift of {:g} s or more up to {:g} km/h", fishhook_run::tip_up_time,
                     settings.at("speed")),
         std::isnan(tipped),
         std::isnan(tipped) ? fmt::format("{:.2g} s at most", lifted) : fmt::format("at {:g} km/h", tipped)});
    add_charts(ascent, outcome);
    return outcome;
}

}  // namespace

Maneuver fishhook() {
    return {.name = "fishhook",
            .title = "Fishhook",
            .standard = "NHTSA dynamic rollover test",
            .summary =
                "The steering wheel jerked to one side and then all the way to the other: whether two wheels lift off.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_all,
            .course = [](const VehicleDescription&, const Settings&) { return Course(); }};
}

}  // namespace hamilcar
