// Along a random road of an ISO 8608 class: what people feel of it by ISO 2631-1, and how the wheels' loads vary.
#include <algorithm>
#include <bit>
#include <cmath>

#include "hamilcar/analysis/ride_weighting.hpp"
#include "hamilcar/analysis/spectrum.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/ride.hpp"

namespace hamilcar {

namespace {

constexpr double smooth = 10, fade = 5;  // ahead of the foremost wheel; in and out of the road's roughness [m]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {
        {"speed", "km/h", "that the driver holds", is_heavy(vehicle) ? 60.0 : 80.0, 10, 200},
        choice_setting("road_class", "of ISO 8608, from A (very good) on",
                       {{"A", 1}, {"B", 2}, {"C", 3}, {"D", 4}, {"E", 5}, {"F", 6}, {"G", 7}, {"H", 8}}, "C"),
        {"length", "m", "that is evaluated", 300, 50, 1500},
        {"seed", "", "another one: another road of the same class", 1, 0, 1e6, SettingKind::whole},
    };
}

// Between them the center of mass has all wheels on the road [m].
struct Stretch {
    double begin, end;
};

struct Plan {
    ScenarioDescription scenario;
    Stretch stretch;
};

Plan along_the_road(const TestRun& test, const std::vector<Axle>& axles) {
    const double speed = test["speed"], center = test.vehicle.chassis.center_of_mass[0];
    RandomRoadDescription road;
    road.road_class = test.choice("road_class").front();
    road.seed = static_cast<std::uint64_t>(std::llround(test["seed"]));
    road.start = axles.front().x + smooth;
    road.track_width = track_width(test.vehicle);
    road.fade = fade;
    Stretch stretch;
    stretch.begin = road.start + fade + center - axles.back().x;
    stretch.end = stretch.begin + test["length"];
    road.length = stretch.end + axles.front().x - center + 2 * fade - road.start;
    constexpr double slack = 1.5;  // of the time at that speed; a road may be too rough for it
    const double way = stretch.end - center + fade;
    ScenarioDescription scenario = driving_at(test, speed, slack * way / speed);
    scenario.solver.step = std::min(scenario.solver.step, ride::max_step);
    scenario.road.random.push_back(road);
    scenario.driver.ending.distance = way;
    follow_straight_line(scenario, test.vehicle, way);
    return {scenario, stretch};
}

// ISO 2631-1, annex C: how people in public transport call a total value. The ranges overlap.
std::string called(double total) {
    struct Range {
        double from, to;  // [m/s^2]
        const char* word;
    };
    constexpr double any = 1e9;
    static constexpr Range ranges[] = {{0, 0.315, "not uncomfortable"},   {0.315, 0.63, "a little uncomfortable"},
                                       {0.5, 1, "fairly uncomfortable"},  {0.8, 1.6, "uncomfortable"},
                                       {1.25, 2.5, "very uncomfortable"}, {2, any, "extremely uncomfortable"}};
    std::string out;
    for (const Range& range : ranges) {
        if (total >= range.from && total < range.to) out += (out.empty() ? "" : " to ") + std::string(range.word);
    }
    return out;
}

// A power of two, for a resolution of about a quarter of a hertz, and at least three spectra to average.
std::size_t segment(std::size_t count, double rate) {
    constexpr double resolution = 0.25;  // [Hz]
    const std::size_t fine = std::bit_floor(static_cast<std::size_t>(rate / resolution));
    return std::min(fine, std::bit_floor(count / 2));
}

io::Curve density(const std::string& label, std::span<const double> values, double rate) {
    constexpr double lowest = 0.3, highest = 50;  // [Hz]
    const Spectrum spectrum =
        power_spectrum(std::vector<double>(values.begin(), values.end()), rate, segment(values.size(), rate));
    io::Curve curve{label, {}, {}};
    for (std::size_t i = 1; i < spectrum.density.size(); ++i) {
        const double f = static_cast<double>(i) * spectrum.resolution;
        if (f >= lowest && f <= highest) curve.x.push_back(f), curve.y.push_back(spectrum.density[i]);
    }
    return curve;
}

void add_charts(TestRun& test, const Recording& recording, const std::vector<Axle>& axles, double from, double to) {
    const Series z = recording[channel::seat_z];
    const std::vector<double> weighted = ride_weighted(RideWeighting::vertical, z.values, z.rate);
    const auto spectrum = [&](const std::string& label, const Series& series) {
        return density(label, ride::within(series, from, to), series.rate);
    };
    io::Chart& power = test.chart(
        "Spectrum of the seat's acceleration", "frequency [Hz]", "density [(m/s^2)^2/Hz]",
        {spectrum("vertical", z), spectrum("vertical, weighted", {weighted, z.rate, z.start}),
         spectrum("lateral", recording[channel::seat_y]), spectrum("longitudinal", recording[channel::seat_x])});
    power.log_x = power.log_y = true;
    test.chart("Vertical acceleration on the seat", "time [s]", "acceleration [m/s^2]",
               {curve("not weighted", recording.time(), z.values), curve("weighted", recording.time(), weighted)});
    io::Chart& load = test.chart("Wheel loads on the left", "x [m]", "load [N]");
    for (const Axle& axle : axles) {
        const std::string& wheel = axle.wheels.front();
        load.curves.push_back(curve(axle.name, recording[channel::contact_x(wheel)].values,
                                    recording[channel::wheel_load(wheel)].values));
    }
}

void add_figures(TestRun& test, const Recording& recording, const std::vector<Axle>& axles, double from, double to) {
    const ride::Comfort comfort = ride::felt(recording, from, to);
    ride::add_figures(test, comfort);
    test.note("a total value of {:.2f} m/s^2: {}, as ISO 2631-1 (annex C) puts it", comfort.total,
              called(comfort.total));
    test.figure("mean speed", "km/h", mean(ride::within(recording[channel::speed], from, to)) / kilometer_per_hour,
                "on the stretch");
    for (const Axle& axle : axles) {
        const ride::Loads loads = ride::loads(recording, axle, from, to);
        test.figure("load variation of " + axle.name, "%", 100 * loads.deviation / loads.mean,
                    "standard deviation of a wheel's load over its mean");
        test.figure("least load of " + axle.name, "%", 100 * loads.min / loads.mean,
                    "of its mean; 0: the wheel leaves the road");
    }
}

void run(TestRun& test) {
    const std::vector<Axle> all = axles(test.vehicle);
    const Plan plan = along_the_road(test, all);
    Drive drive = test.drive(plan.scenario, ride::drive_options);
    const bool whole = test.take_whole(drive);
    const Recording& recording = drive.recording;
    const Series x = recording[channel::x];
    const auto from = first_crossing(x, plan.stretch.begin, Crossing::rising);
    const auto to = first_crossing(x, plan.stretch.end, Crossing::rising);
    constexpr double shortest = 1;  // of the rough road, that something can be said about [s]
    if (!from || recording.end() < *from + shortest) {
        if (whole) test.fail("it did not get along the road");
        return;
    }
    if (whole && !to) {
        test.fail("after {:.0f} s it had come {:.0f} m along the road", recording.end(),
                  x.values.back() - plan.stretch.begin);
    }
    const double until = to.value_or(recording.end());
    add_figures(test, recording, all, *from, until);
    add_charts(test, recording, all, *from, until);
}

}  // namespace

Maneuver rough_road() {
    return {.name = "rough_road",
            .title = "Ride on a rough road",
            .standard = "ISO 8608 / ISO 2631-1",
            .summary = "Along a random road of a class: the comfort on the seat and the loads of the wheels.",
            .settings = settings,
            .run = run};
}

}  // namespace hamilcar
