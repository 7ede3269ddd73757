#include "hamilcar/maneuver/lane_change.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/course_driver.hpp"
#include "hamilcar/maneuver/search.hpp"

namespace hamilcar {

namespace {

constexpr double finest = 1;                   // of the speed that is sought [km/h]
constexpr double widening = 1.15;              // between two speeds while none has failed, or none has passed
constexpr double slowest = 15, fastest = 200;  // that are tried [km/h]
constexpr int max_speeds = 14;                 // of a search, the first one among them
constexpr double entry_tolerance = 3;          // of the speed at the first cones, for a run to be one of it [km/h]

// As the box's front or rear passes a place, by its center's x; NaN where it never came there [km/h].
double speed_at(const Recording& recording, double x) {
    const auto there = first_crossing(recording[channel::x], x, Crossing::rising);
    return there ? interpolated(recording[channel::speed], *there) / kilometer_per_hour : not_shown;
}

// What it entered the course at, the box's front at the first cones; NaN where it never came there [km/h].
double entry_speed(const VehicleDescription& vehicle, const LaneChange& change, const Recording& recording) {
    return speed_at(recording, change.lanes.front().begin - footprint(vehicle).front);
}

double largest_rate(const Series& series) {
    double out = 0;
    for (std::size_t i = 1; i < series.values.size(); ++i) {
        out = std::max(out, std::abs(series.values[i] - series.values[i - 1]) * series.rate);
    }
    return out;
}

void add_figures(TestRun& test, const LaneChange& change, const CourseDrive& drive) {
    const Recording& recording = drive.drive.recording;
    const Footprint box = footprint(test.vehicle);
    test.figure("entry speed", "km/h", entry_speed(test.vehicle, change, recording),
                "as the front comes to the first cones");
    test.figure("exit speed", "km/h", speed_at(recording, change.lanes.back().end - box.rear),
                "as the rear leaves the last cones");
    test.figure("least clearance", "m", drive.passage.clearance,
                "between the vehicle's box, or a trailer's tires, and the rows of cones; negative: across");
    test.figure("place of the least clearance", "m", drive.passage.place,
                "of the center of mass behind the first cones");
    test.figure("cones hit", "", static_cast<double>(drive.passage.cones),
                "that the vehicle's box or a trailer's tires ran over");
    const auto add_largest = [&](const std::string& name, const std::string& unit, const char* channel,
                                 const std::string& meaning = "either way") {
        test.figure("largest " + name, unit, largest(recording, channel), meaning);
    };
    add_largest("steering wheel angle", "deg", channel::steering_wheel);
    test.figure("largest steering wheel rate", "deg/s", largest_rate(recording[channel::steering_wheel]), "either way");
    add_largest("lateral acceleration", "m/s^2", channel::lateral_acceleration, "of the motor vehicle, either way");
    add_largest("yaw rate", "deg/s", channel::yaw_rate);
    add_largest("sideslip angle", "deg", channel::sideslip, "of the center of mass, either way");
    add_largest("roll angle", "deg", channel::roll);
}

void add_path_chart(TestRun& test, const LaneChange& change, const Recording& recording) {
    const Course& course = test.outcome.course;
    io::Curve line{.label = "line to follow"};
    const double margin = 20;  // beyond the cones [m]
    for (const auto& [x, y] : course.line) {
        if (x < change.lanes.front().begin - margin || x > change.lanes.back().end + margin) continue;
        line.x.push_back(x), line.y.push_back(y);
    }
    io::Chart& chart = test.chart(change.title + ": path", "x [m]", "y [m]",
                                  {line, over_channel(recording, channel::x, "center of mass", channel::y)});
    chart.equal_axes = true;
    io::Marks cones{.label = "cones"};
    for (const auto& [x, y] : course.cones) cones.x.push_back(x), cones.y.push_back(y);
    chart.marks = {cones};
    for (const Gate& gate : course.boundaries) {
        chart.lines.push_back({gate.from[0], gate.from[1], gate.to[0], gate.to[1]});
    }
}

void add_charts(TestRun& test, const LaneChange& change, const Recording& recording) {
    add_path_chart(test, change, recording);
    const auto over_x = [&](const std::string& label, const char* channel) {
        return over_channel(recording, channel::x, label, channel);
    };
    test.chart("Steering wheel", "x [m]", "angle [deg]", {over_x("steering wheel", channel::steering_wheel)});
    test.chart("Lateral acceleration", "x [m]", "lateral acceleration [m/s^2]",
               {over_x("lateral acceleration", channel::lateral_acceleration)});
    test.chart("Yaw rate, sideslip and roll", "x [m]", "[deg/s], [deg]",
               {over_x("yaw rate [deg/s]", channel::yaw_rate), over_x("sideslip angle [deg]", channel::sideslip),
                over_x("roll angle [deg]", channel::roll)});
}

// What the search knows.
struct Found {
    Bracket bracket;                                          // as wanted [km/h]
    bool clean = false;                                       // at its lower end
    double entry = not_shown;                                 // there, as measured [km/h]
    double too_fast = not_shown, too_fast_entry = not_shown;  // last that it could not enter at, and what it had then

    // Whether it went well: one that stopped on the way tells as little of a limit as one that went through.
    bool add(const CourseDrive& drive, double entered_at) {
        if (std::abs(entered_at - drive.speed) > entry_tolerance) {
            too_fast = drive.speed, too_fast_entry = entered_at;
            return false;
        }
        if (!drive.passage.clean() && !drive.passage.too_slow()) return false;
        clean = drive.passage.clean(), entry = entered_at;
        return true;
    }
};

void add_search_notes(TestRun& test, const Found& found) {
    const auto [low, failed] = found.bracket;
    if (!found.clean) {
        test.note("no speed was found at which the course is driven without a cone hit{}{}",
                  std::isnan(failed) ? "" : fmt::format(", down to {:g} km/h", failed),
                  std::isnan(low) ? "" : fmt::format("; at {:g} km/h it stopped on the way", low));
    } else if (std::isnan(failed)) {
        test.note("no cone fell up to {:g} km/h, where the search ended", low);
    } else if (failed == found.too_fast) {
        test.note(
            "no cone fell up to {:g} km/h; at {:g} km/h, where the search ended, the course was entered at "
            "{:.1f} km/h",
            low, found.too_fast, found.too_fast_entry);
    }
}

// The highest clean speed by steps outward and then bisection; the run at it is kept.
void search(TestRun& test, const LaneChange& change, CourseDriver& driver, const CourseDrive& first) {
    Found found;
    const auto add = [&](const CourseDrive& drive) {
        return found.add(drive, entry_speed(test.vehicle, change, drive.drive.recording));
    };
    // Whole kilometers per hour between the two, else farther out.
    const auto next = [&](const Bracket& now) -> std::optional<double> {
        const double speed = std::floor(std::isnan(now.high)  ? now.low * widening + finest
                                        : std::isnan(now.low) ? now.high / widening
                                                              : now.middle() + 0.5 * finest);
        if (!driver.may_go_on() || speed < slowest || speed > fastest) return {};
        return speed;
    };
    const auto try_speed = [&](double speed) -> std::optional<bool> {
        CourseDrive now = driver.drive(speed);
        if (!test.take_energy(now.drive)) return {};
        const bool went_well = add(now);
        if (went_well && found.clean && !now.drive.replay.columns.empty()) {
            test.outcome.runs = {std::move(now.drive.replay)};
        }
        return went_well;
    };
    (add(first) ? found.bracket.low : found.bracket.high) = first.speed;
    narrow(found.bracket, finest, next, try_speed);
    if (test.outcome.failed) return;
    test.figure("highest clean entry speed", "km/h", found.clean ? found.entry : not_shown,
                "that was found without a cone hit, as measured");
    add_search_notes(test, found);
}

// Of the drive at the speed that was asked for. A course entered at another speed is no run of this one, however clean.
void add_verdicts(TestRun& test, const CourseDrive& drive, double entry) {
    const Passage& p = drive.passage;
    const bool entered = std::abs(entry - drive.speed) <= entry_tolerance;
    test.verdict(fmt::format("entered within {:g} km/h of {:g} km/h", entry_tolerance, drive.speed), entered,
                 std::isnan(entry) ? "it did not come to the first cones" : fmt::format("{:.1f} km/h", entry));
    const std::string room = p.clearance < 0 ? fmt::format("a row of cones crossed by {:.2f} m", -p.clearance)
                                             : fmt::format("{:.2f} m of clearance", p.clearance);
    test.verdict("no cone is hit and no border crossed", p.clean(),
                 p.too_slow()  ? "the vehicle stopped before the end of the course"
                 : !p.complete ? "the course was not driven to its end"
                               : fmt::format("{} cones, {}", p.cones, room));
    if (!entered && !std::isnan(entry)) {
        test.note("the course was entered at {:.1f} km/h, not at {:g} km/h: this is no run of that speed", entry,
                  drive.speed);
    }
    if (!p.complete) {
        test.note("the drive at {:g} km/h ended {:.1f} m behind the first cones{}", drive.speed,
                  drive.drive.recording[channel::x].values.back(), drive.drive.ended ? ": " + *drive.drive.ended : "");
    }
}

void drive_lane_change(TestRun& test, const LaneChange& change) {
    CourseDriver driver(test, change, test.is_on("search") ? max_speeds : 1);
    test.outcome.course = driver.course();
    if (is_heavy(test.vehicle)) {
        test.note("the course is made for cars and light trucks of up to 3.5 t; this vehicle is heavier");
    }
    CourseDrive first = driver.drive(test.typed("speed"));
    if (!first.drive.breaks_off()) {
        add_figures(test, change, first);
        add_charts(test, change, first.drive.recording);
        add_verdicts(test, first, entry_speed(test.vehicle, change, first.drive.recording));
        if (test.is_on("search")) search(test, change, driver, first);
    }
    test.take(first.drive);
}

}  // namespace

std::vector<Setting> lane_change_settings(double default_speed, bool default_search) {
    return {{"speed", "km/h", "at which the course is entered", default_speed, slowest, fastest},
            flag_setting("search", "also seek the highest entry speed without a cone hit", default_search),
            {"attempts", "", "at each speed, each with what the driver learned from the one before", 6, 1, 20,
             SettingKind::whole},
            {"preview_time", "s", "how far ahead the driver looks", 0.4, 0.2, 2}};
}

double default_entry_speed(const VehicleDescription& vehicle, double standard, double acceleration) {
    constexpr double part = 0.6, step = 5;  // of the acceleration that tips it over [1]; [km/h]
    const double bearable = part * tipping_acceleration(vehicle);
    return std::max(rounded_down(standard * std::min(1.0, std::sqrt(bearable / acceleration)), step), slowest);
}

Maneuver through_lanes(LaneChange (*lanes)(const VehicleDescription&), Maneuver named) {
    named.unsupported_reason = needs_steering_and_drive;
    named.run = [lanes](TestRun& test) { drive_lane_change(test, lanes(test.vehicle)); };
    named.course = [lanes](const VehicleDescription& vehicle, const Settings&) {
        return lane_course(lanes(vehicle).lanes, footprint(vehicle));
    };
    return named;
}

}  // namespace hamilcar
