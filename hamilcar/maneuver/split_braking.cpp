// Braking with one side on ice: ISO 14512 (cars) and ISO 16234 (heavy vehicles). The grip that is left on the other side
// turns the vehicle; the test shows how much of that happens before a driver could answer, in the first second with the
// steering held. With a driver who steers against it, it shows what he has to do and how long the way is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/braking.hpp"
#include "hamilcar/maneuver/catalog.hpp"

namespace hamilcar {

namespace {

constexpr double first_second = 1;  // that a driver needs to answer, as in ISO 14512 [s]
// Steering that UN R13-H (annex 6, 5.3.6) leaves to the driver of a car with an anti-lock system: in the first two
// seconds, and in all [rad].
constexpr double early = 2;  // [s]
constexpr double largest_early = 120 * degree, largest_steering = 240 * degree;
constexpr double spun = 60 * degree;  // of heading: past any correction [rad]

// ISO 14512 is for all braking up to where a wheel on the good side locks. Half a g asked for is below that.
double usual_pedal(const VehicleDescription& vehicle) {
    constexpr double asked = 0.5;  // [g]
    constexpr double grain = 5;    // [%]
    const double full = straight::full_brake_force(vehicle);
    if (full <= 0) return 100;
    const double share = asked * straight::total_mass(vehicle) * standard_gravity / full;
    return std::clamp(std::round(share * 100 / grain) * grain, grain, 100.0);
}

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = straight::is_heavy(vehicle);
    return {
        {"speed", "km/h", "from which is braked", heavy ? 50.0 : 80.0, 20, 200},
        {"pedal", "%", "of its full travel; as usual asks for about half a g", usual_pedal(vehicle), 5, 100},
        {"pedal_rise", "s", "from nothing to that", heavy ? 0.4 : 0.1, 0.01, 2},
        {"friction", "", "of the good side, times the tires' own", 1, 0.1, 1.5},
        {"low_friction", "", "of the other side, likewise", 0.2, 0.02, 1.5},
        {"low_side", "", "1: the left side is slippery; -1: the right one", 1, -1, 1, SettingKind::side},
        {"steering", "", "on the way to standstill: 0: held straight; 1: the driver corrects", 1, 0, 1,
         SettingKind::toggle},
    };
}

std::string obstacle(const VehicleDescription& vehicle) {
    return straight::full_brake_force(vehicle) > 0 ? "" : "it has no brakes";
}

RoadDescription split_road(const RoadDescription& road, const Settings& chosen) {
    RoadDescription out = road;
    FrictionPatchDescription slippery;
    slippery.friction = chosen.at("low_friction") / chosen.at("friction");
    (chosen.at("low_side") == 1 ? slippery.right : slippery.left) = 0;
    out.friction *= chosen.at("friction");
    out.patches.push_back(slippery);
    return out;
}

void add_response_figures(Outcome& outcome, const History& history) {
    const Series yaw = straight::series(history, history.yaw), rate = straight::series(history, history.yaw_rate);
    const std::vector<double> over_ground = straight::ground_speed(history);
    const Series y = straight::series(history, history.y), speed = straight::series(history, over_ground);
    const double from = braking::approach, to = from + first_second;
    const auto fastest = peak(rate, Extreme::largest, from, to);
    outcome.figures.push_back(
        {"yaw rate after 1 s", "deg/s", "steering held; to the left positive", interpolated(rate, to) / degree});
    outcome.figures.push_back({"peak yaw rate in the first second", "deg/s", "likewise",
                               fastest ? fastest->value / degree : braking::nowhere});
    outcome.figures.push_back({"change of heading in the first second", "deg", "likewise",
                               (interpolated(yaw, to) - interpolated(yaw, from)) / degree});
    outcome.figures.push_back({"lateral offset after 1 s", "m", "of the center of mass, to the left positive",
                               interpolated(y, to) - interpolated(y, from)});
    outcome.figures.push_back({"mean deceleration in the first second", "m/s^2", "speed lost over time",
                               (interpolated(speed, from) - interpolated(speed, to)) / first_second});
}

void add_stop_figures(Outcome& outcome, const braking::Stop& stop) {
    outcome.figures.push_back({"stopping distance", "m", "from the pedal to standstill", stop.distance});
    outcome.figures.push_back({"stopping time", "s", "likewise", stop.time});
    outcome.figures.push_back(
        {"MFDD", "m/s^2", "mean fully developed deceleration, between 80 and 10 percent of the speed", stop.developed});
    outcome.figures.push_back({"largest change of heading", "deg", "on the way to standstill", stop.heading / degree});
    outcome.figures.push_back({"farthest wheel beside the line", "m", "the middle of its outer tire", stop.beside});
}

// What the driver did with the wheel, and whether he kept the lane.
void add_correction(Outcome& outcome, const VehicleDescription& vehicle, const History& history,
                    const braking::Stop& stop) {
    const Series wheel = straight::series(history, history.steering_wheel);
    const auto soon = peak(wheel, Extreme::largest, braking::approach, braking::approach + early);
    const auto most = peak(wheel, Extreme::largest, braking::approach);
    const double in_time = soon ? std::abs(soon->value) : 0, in_all = most ? std::abs(most->value) : 0;
    outcome.figures.push_back(
        {"steering in the first 2 s", "deg", "largest angle of the steering wheel", in_time / degree});
    outcome.figures.push_back({"steering in all", "deg", "likewise", in_all / degree});
    const auto spoken = [](double angle) { return fmt::format("{:.0f} deg", angle / degree); };
    outcome.verdicts.push_back({"steering at most 120 deg in the first 2 s (UN R13-H, with anti-lock system)",
                                in_time <= largest_early, spoken(in_time)});
    outcome.verdicts.push_back({"steering at most 240 deg in all (UN R13-H, with anti-lock system)",
                                in_all <= largest_steering, spoken(in_all)});
    outcome.verdicts.push_back({"all wheels within a lane 3.5 m wide",
                                stop.beside + half_tire(vehicle) <= braking::lane_width / 2,
                                fmt::format("a wheel {:.2f} m beside the middle", stop.beside)});
}

std::vector<double> from_pedal(const History& history) {
    std::vector<double> time(history.time);
    for (double& t : time) t -= braking::approach;
    return straight::thinned(time);
}

void add_yaw_chart(Outcome& outcome, const History& history) {
    io::Chart yaw{"Yaw rate, steering held", "time from the pedal [s]", "yaw rate [deg/s]", {}};
    yaw.vertical_marks = {{first_second, "1 s"}};
    yaw.curves.push_back({"", from_pedal(history), straight::thinned(straight::scaled(history.yaw_rate, 1 / degree))});
    outcome.charts.push_back(std::move(yaw));
}

void add_path_charts(Outcome& outcome, const History& history) {
    const auto thinned = [](const std::vector<double>& values) { return straight::thinned(values); };
    io::Chart steering{"Steering wheel", "time from the pedal [s]", "angle [deg]", {}};
    steering.curves.push_back({"", from_pedal(history), thinned(straight::scaled(history.steering_wheel, 1 / degree))});
    io::Chart path{"Path", "x [m]", "y [m]", {{"center of mass", thinned(history.x), thinned(history.y)}}};
    path.horizontal_marks = {{braking::lane_width / 2, "lane"}, {-braking::lane_width / 2, ""}};
    outcome.charts.push_back(std::move(steering)), outcome.charts.push_back(std::move(path));
}

ScenarioDescription split_stop(const VehicleDescription& vehicle, const Settings& chosen,
                               const ManeuverOptions& options, bool corrects) {
    ManeuverOptions here = options;
    here.road = split_road(options.road, chosen);
    const braking::Use use{.speed = chosen.at("speed") * kilometer_per_hour,
                           .pedal = chosen.at("pedal") / 100,
                           .rise = chosen.at("pedal_rise"),
                           .engine_drives = false};
    constexpr double poor = 0.5;  // what locked wheels hold at worst [1]
    const double asked = use.pedal * straight::full_brake_force(vehicle) / straight::total_mass(vehicle);
    const double grip = poor * (chosen.at("friction") + chosen.at("low_friction")) / 2;
    ScenarioDescription scenario = braking::stop(vehicle, here, use, 0.5 * std::min(asked, grip * standard_gravity));
    scenario.name = "split_braking";
    if (corrects) straight::follow_straight_line(scenario, vehicle, use.speed * scenario.duration);
    return scenario;
}

// The first second with the steering held, whatever comes after.
bool hold_at_first(Outcome& outcome, const VehicleDescription& vehicle, const Settings& chosen,
                   const ManeuverOptions& options, double share) {
    ScenarioDescription scenario = split_stop(vehicle, chosen, options, false);
    constexpr double reserve = 0.1;  // so that there are rows up to the second's end [s]
    scenario.duration = braking::approach + first_second + reserve;
    TrialOptions only_rows = straight::trial_options(options, 0, share);
    only_rows.film = false;
    Trial trial = drive(vehicle, scenario, only_rows);
    if (!take_whole(outcome, trial)) return false;
    add_response_figures(outcome, trial.history);
    add_yaw_chart(outcome, trial.history);
    return true;
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    constexpr double at_first = 0.2;  // of the progress
    const bool corrects = chosen.at("steering") == 1 && needs_steering(vehicle).empty();
    if (chosen.at("steering") == 1 && !corrects) outcome.notes.push_back(needs_steering(vehicle) + ": straight on");
    if (!hold_at_first(outcome, vehicle, chosen, options, at_first)) return outcome;
    Trial trial =
        drive(vehicle, split_stop(vehicle, chosen, options, corrects), straight::trial_options(options, at_first, 1));
    braking::end_at_standstill(trial);
    const bool whole = take_whole(outcome, trial);
    const braking::Stop stop = braking::evaluated(trial.history);
    add_stop_figures(outcome, stop);
    braking::add_lock_figures(outcome, vehicle, stop);
    if (corrects && whole) add_correction(outcome, vehicle, trial.history, stop);
    if (std::abs(stop.heading) > spun) outcome.notes.push_back("the vehicle turned round");
    if (whole && std::isnan(stop.distance)) {
        outcome.failed = fmt::format("it did not come to a stop within {:.0f} s: {:.0f} km/h were left",
                                     trial.history.time.back(), trial.history.speed.back() / kilometer_per_hour);
    }
    add_path_charts(outcome, trial.history);
    braking::add_charts(outcome, vehicle, trial.history);
    return outcome;
}

}  // namespace

Maneuver split_braking() {
    return {.name = "split_braking",
            .title = "Braking on split friction",
            .standard = "ISO 14512 / ISO 16234",
            .summary =
                "A stop with one side on a slippery surface: how far the vehicle turns before a driver could answer.",
            .settings = settings,
            .obstacle = obstacle,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
