// Over a single cleat, all wheels of an axle at once: how hard it knocks on the seat and on the wheels, and how long the
// vehicle goes on swinging.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/ride.hpp"

namespace hamilcar {

namespace {

constexpr double approach = 1.5;  // driven before the first wheel comes to the cleat [s]
constexpr double swinging = 3;    // watched after the last one [s]
constexpr double counted = 2;     // from the first contact on, that r.m.s. values are taken over [s]

std::vector<Setting> settings(const VehicleDescription&) {
    return {
        {"speed", "km/h", "over the cleat", 40, 5, 150},
        {"height", "mm", "of the cleat; negative: a pothole", 25, -150, 150},
        {"length", "mm", "of the cleat along the road", 100, 10, 5000},
        {"ramp", "mm", "of its edges, within the length", 50, 5, 500},
    };
}

// Where the cleat begins [m].
double cleat_start(double speed, const std::vector<Axle>& axles) {
    return approach * speed + axles.front().x;
}

// A ramp is over in no time: several steps on it, each a whole part of a millisecond, so that rows fall on steps [s].
double step_for(const TestRun& test, double step) {
    constexpr double steps = 8, interval = 1e-3, finest = 10;  // on the ramp; [s]; parts of it
    const double wanted = std::min(test["ramp"], test["length"] / 2) / test["speed"] / steps;
    return std::min(step, interval / std::clamp(std::ceil(interval / wanted), 1.0, finest));
}

ScenarioDescription over_the_cleat(const TestRun& test, const std::vector<Axle>& axles) {
    const double speed = test["speed"], crossing = (axles.front().x - axles.back().x) / speed;
    ScenarioDescription scenario = driving_at(test, speed, approach + crossing + swinging);
    scenario.solver.step = step_for(test, std::min(scenario.solver.step, ride::max_step));
    ObstacleDescription cleat;
    cleat.start = cleat_start(speed, axles);
    cleat.length = test["length"];
    cleat.height = test["height"];
    cleat.ramp = std::min(test["ramp"], cleat.length / 2);
    scenario.road.obstacles.push_back(cleat);
    return scenario;
}

// When an axle's wheels stand above a place [s].
double passing(const Recording& recording, const Axle& axle, double x) {
    return first_crossing(recording[channel::contact_x(axle.wheels.front())], x, Crossing::rising).value_or(not_shown);
}

// After `from`: how long until the seat keeps within a tenth of the largest knock.
double decay(const Series& seat, double level, double from) {
    constexpr double small = 0.1;
    const std::vector<double> knock = shifted(seat.values, -level);
    const double largest = largest_magnitude(knock);
    double last = from;
    for (std::size_t i = sample_at(seat, from); i < knock.size(); ++i) {
        if (std::abs(knock[i]) > small * largest) last = seat.time(i);
    }
    return last - from;
}

void add_load_figures(TestRun& test, const Recording& recording, const std::vector<Axle>& axles, double first) {
    constexpr double before = 0.5;     // of smooth road, that stands for rest [s]
    const double clear = first - 0.1;  // ahead of the tires' patch [s]
    for (const Axle& axle : axles) {
        const double rest = ride::loads(recording, axle, clear - before, clear).mean;
        const ride::Loads loads = ride::loads(recording, axle, clear, recording.end());
        test.figure("largest load of " + axle.name, "%", 100 * loads.max / rest, "of a wheel, of its load before");
        test.figure("least load of " + axle.name, "%", 100 * loads.min / rest, "likewise; 0: it leaves the road");
    }
}

void add_charts(TestRun& test, const Recording& recording, const std::vector<Axle>& axles, double first) {
    const std::string from_contact = "time from the first contact [s]";
    test.chart("Acceleration on the seat", from_contact, "acceleration [m/s^2]",
               {over_time(recording, "vertical", channel::seat_z, 1, first),
                over_time(recording, "longitudinal", channel::seat_x, 1, first)});
    io::Chart& load = test.chart("Wheel loads", from_contact, "load [N]");
    for (const Axle& axle : axles) {
        load.curves.push_back(over_time(recording, axle.name, channel::wheel_load(axle.wheels.front()), 1, first));
    }
    test.chart("Pitch", from_contact, "angle [deg]", {over_time(recording, "", channel::pitch, 1, first)});
}

void add_seat_figures(TestRun& test, const Recording& recording, double first, double last) {
    const Series z = recording[channel::seat_z], x = recording[channel::seat_x];
    const double clear = first - 0.1, level = mean(ride::within(z, 0, clear));
    const auto up = peak(z, Extreme::highest, clear), down = peak(z, Extreme::lowest, clear);
    const auto ahead = peak(x, Extreme::largest, clear);
    test.figure("peak acceleration upward", "m/s^2", up ? up->value - level : 0, "on the seat, not filtered");
    test.figure("peak acceleration downward", "m/s^2", down ? level - down->value : 0, "likewise");
    test.figure("peak acceleration along x", "m/s^2", ahead ? ahead->value : 0, "likewise, with its sign");
    ride::add_figures(test, ride::felt(recording, clear, std::min(first + counted, recording.end())));
    test.figure("decay", "s", decay(z, level, last),
                "from the last contact until the seat keeps within a tenth of the largest value");
}

void run(TestRun& test) {
    const std::vector<Axle> all = axles(test.vehicle);
    const ScenarioDescription scenario = over_the_cleat(test, all);
    Drive drive = test.drive(scenario, ride::drive_options);
    const bool whole = test.take_whole(drive);
    const double start = scenario.road.obstacles.back().start;
    const double first = passing(drive.recording, all.front(), start);
    const double last = passing(drive.recording, all.back(), start);
    if (std::isnan(first) || std::isnan(last)) {
        if (whole) test.fail("it did not come over the cleat");
        return;
    }
    add_seat_figures(test, drive.recording, first, last);
    add_load_figures(test, drive.recording, all, first);
    add_charts(test, drive.recording, all, first);
}

}  // namespace

Maneuver cleat() {
    return {.name = "cleat",
            .title = "Ride over a cleat",
            .standard = "ISO 2631-1 (weightings)",
            .summary =
                "All wheels over a single cleat at a steady speed: knocks on seat and wheels, and how they die away.",
            .settings = settings,
            .run = run};
}

}  // namespace hamilcar
