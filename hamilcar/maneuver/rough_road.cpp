// Along a random road of an ISO 8608 class: what people feel of it by ISO 2631-1, and how the wheels' loads vary.
#include <fmt/format.h>

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
        {"speed", "km/h", "that the driver holds", straight::is_heavy(vehicle) ? 60.0 : 80.0, 10, 200},
        {"road_class", "", "of ISO 8608: 1 is A (very good), 3 is C, 8 is H", 3, 1, 8, SettingKind::whole},
        {"length", "m", "that is evaluated", 300, 50, 1500},
        {"seed", "", "another one: another road of the same class", 1, 0, 1e6, SettingKind::whole},
    };
}

std::string obstacle(const VehicleDescription&) {
    return "";
}

double track_width(const VehicleDescription& vehicle) {
    double left = 0, right = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        left = std::max(left, wheel.wheel.center[1]), right = std::min(right, wheel.wheel.center[1]);
    });
    constexpr double least = 0.5;  // where all wheels follow each other in one track [m]
    return std::max(left - right, least);
}

// Between them the center of mass has all wheels on the road [m].
struct Stretch {
    double begin, end;
};

struct Drive {
    ScenarioDescription scenario;
    Stretch stretch;
};

Drive along_the_road(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    const std::vector<straight::Axle> axles = straight::axles(vehicle);
    const double speed = chosen.at("speed") * kilometer_per_hour, center = vehicle.chassis.center_of_mass[0];
    RandomRoadDescription road;
    road.road_class = static_cast<char>('A' + std::lround(chosen.at("road_class")) - 1);
    road.seed = static_cast<std::uint64_t>(std::llround(chosen.at("seed")));
    road.start = axles.front().x + smooth;
    road.track_width = track_width(vehicle);
    road.fade = fade;
    Stretch stretch;
    stretch.begin = road.start + fade + center - axles.back().x;
    stretch.end = stretch.begin + chosen.at("length");
    road.length = stretch.end + axles.front().x - center + 2 * fade - road.start;
    constexpr double patience = 1.5;  // of the time at that speed; a road may be too rough for it
    const double way = stretch.end - center + fade;
    ScenarioDescription scenario = driving_at(vehicle, ride::with_fine_step(options), speed, patience * way / speed);
    scenario.name = "rough_road";
    scenario.road.random.push_back(road);
    scenario.driver.ending.distance = way;
    straight::follow_straight_line(scenario, vehicle, way);
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

void add_charts(Outcome& outcome, const History& history, const std::vector<straight::Axle>& axles, double from,
                double to) {
    const double rate = straight::series(history, history.seat_z).rate;
    const auto part = [&](const std::vector<double>& values) { return ride::between(history, values, from, to); };
    const auto thinned = [](const std::vector<double>& values) { return straight::thinned(values); };
    io::Chart power{
        "Spectrum of the seat's acceleration", "frequency [Hz]", "density [(m/s^2)^2/Hz]", {}, true, {}, true};
    power.curves.push_back(density("vertical", part(history.seat_z), rate));
    const std::vector<double> weighted = ride_weighted(RideWeighting::vertical, history.seat_z, rate);
    power.curves.push_back(density("vertical, weighted", part(weighted), rate));
    power.curves.push_back(density("lateral", part(history.seat_y), rate));
    power.curves.push_back(density("longitudinal", part(history.seat_x), rate));
    io::Chart seat{"Vertical acceleration on the seat", "time [s]", "acceleration [m/s^2]", {}};
    seat.curves.push_back({"not weighted", thinned(history.time), thinned(history.seat_z)});
    seat.curves.push_back({"weighted", thinned(history.time), thinned(weighted)});
    io::Chart load{"Wheel loads on the left", "x [m]", "load [N]", {}};
    for (const straight::Axle& axle : axles) {
        const std::size_t wheel = axle.wheels.front();
        load.curves.push_back({axle.name, thinned(history.wheel_x[wheel]), thinned(history.wheel_load[wheel])});
    }
    for (auto* chart : {&power, &seat, &load}) outcome.charts.push_back(std::move(*chart));
}

void add_figures(Outcome& outcome, const History& history, const std::vector<straight::Axle>& axles, double from,
                 double to) {
    const ride::Comfort comfort = ride::felt(history, from, to);
    ride::add_figures(outcome, comfort);
    outcome.notes.push_back(fmt::format("a total value of {:.2f} m/s^2: {}, as ISO 2631-1 (annex C) puts it",
                                        comfort.total, called(comfort.total)));
    outcome.figures.push_back({"mean speed", "km/h", "on the stretch",
                               straight::mean(ride::between(history, history.speed, from, to)) / kilometer_per_hour});
    for (const straight::Axle& axle : axles) {
        const ride::Loads loads = ride::loads(history, axle, from, to);
        outcome.figures.push_back({"load variation of " + axle.name, "%",
                                   "standard deviation of a wheel's load over its mean",
                                   100 * loads.deviation / loads.mean});
        outcome.figures.push_back({"least load of " + axle.name, "%", "of its mean; 0: the wheel leaves the road",
                                   100 * loads.least / loads.mean});
    }
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const Drive along = along_the_road(vehicle, chosen, options);
    Trial trial = drive(vehicle, along.scenario, ride::trial_options(options));
    ride::thin_out(trial.film, trial.history);
    const bool whole = take_whole(outcome, trial);
    const Series x = straight::series(trial.history, trial.history.x);
    const auto from = first_crossing(x, along.stretch.begin, Crossing::rising);
    const auto to = first_crossing(x, along.stretch.end, Crossing::rising);
    constexpr double least = 1;  // of the rough road, that something can be said about [s]
    if (!from || trial.history.time.back() < *from + least) {
        if (whole) outcome.failed = "it did not get along the road";
        return outcome;
    }
    if (whole && !to) {
        outcome.failed = fmt::format("after {:.0f} s it had come {:.0f} m along the road", trial.history.time.back(),
                                     trial.history.x.back() - along.stretch.begin);
    }
    const double until = to.value_or(trial.history.time.back());
    const std::vector<straight::Axle> axles = straight::axles(vehicle);
    add_figures(outcome, trial.history, axles, *from, until);
    add_charts(outcome, trial.history, axles, *from, until);
    return outcome;
}

}  // namespace

Maneuver rough_road() {
    return {.name = "rough_road",
            .title = "Ride on a rough road",
            .standard = "ISO 8608 / ISO 2631-1",
            .summary = "Along a random road of a class: the comfort on the seat and the loads of the wheels.",
            .settings = settings,
            .obstacle = obstacle,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
