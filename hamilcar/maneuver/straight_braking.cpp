// A stop straight ahead with all that the brakes give, engine disconnected: the type-0 test of UN R13-H for cars and of
// UN R13 for trucks, ISO 21994's stopping distance where there is an anti-lock system.
#include <fmt/format.h>

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
constexpr double largest_heading = 15 * degree;  // off the straight line, both regulations [rad]
constexpr double simultaneous = 0.1;             // as good as at once, in the order of lock, both regulations [s]
constexpr double grips = 0.8;  // friction factor from which the regulations' limits mean something [1]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = straight::is_heavy(vehicle);
    return {
        {"speed", "km/h", "from which is braked", heavy ? 60.0 : 100.0, 20, 250},
        {"pedal", "%", "of its full travel", 100, 5, 100},
        {"pedal_rise", "s", "from nothing to that", heavy ? 0.4 : 0.1, 0.01, 2},
        {"friction", "", "of the road, times the tires' own", 1, 0.05, 1.5},
        {"engine_connected", "", "1: a gear stays in; 0: the gearbox goes to neutral with the pedal", 0, 0, 1,
         SettingKind::toggle},
    };
}

std::string obstacle(const VehicleDescription& vehicle) {
    return straight::full_brake_force(vehicle) > 0 ? "" : "it has no brakes";
}

std::string spoken(double lock) {
    return std::isnan(lock) ? "does not lock" : fmt::format("locks after {:.3f} s", lock);
}

// When an axle is locked: with its second wheel, on one wheel the other still holds it straight [s]; NaN where that never
// locks.
double second_lock(const straight::Axle& axle, const braking::Stop& stop) {
    std::vector<double> all;
    for (const std::size_t wheel : axle.wheels) {
        if (!std::isnan(stop.lock[wheel])) all.push_back(stop.lock[wheel]);
    }
    const std::size_t wanted = std::min<std::size_t>(axle.wheels.size(), 2);
    if (all.size() < wanted) return braking::nowhere;
    std::ranges::sort(all);
    return all[wanted - 1];
}

// The order in which the motor vehicle's axles lock under a pedal that goes down slowly: the rear before the front one would
// turn the vehicle round.
void add_lock_order(Outcome& outcome, const VehicleDescription& vehicle, const braking::Stop& stop) {
    std::vector<straight::Axle> all = straight::axles(vehicle);
    std::erase_if(all, [](const straight::Axle& axle) { return axle.of_trailer; });
    if (all.size() < 2) return;
    const double front = second_lock(all.front(), stop);
    double rear = braking::nowhere;
    for (std::size_t i = 1; i < all.size(); ++i) rear = std::fmin(rear, second_lock(all[i], stop));
    outcome.figures.push_back({"lock of the front axle, slow pedal", "s", "from the pedal to its second wheel", front});
    outcome.figures.push_back({"lock of the rear axles, slow pedal", "s", "likewise", rear});
    if (straight::is_heavy(vehicle)) return;  // of these UN R13 asks something else, with an anti-lock system
    outcome.verdicts.push_back(
        {"under a slow pedal no rear axle locks before the front axle (UN R13-H annex 5, FMVSS 135 S7.2)",
         std::isnan(rear) || front <= rear + simultaneous,
         fmt::format("front {}, rear {}", spoken(front), spoken(rear))});
}

void add_verdicts(Outcome& outcome, const VehicleDescription& vehicle, const Settings& chosen,
                  const braking::Stop& stop) {
    const bool heavy = straight::is_heavy(vehicle);
    const Limits limit = limits(heavy, chosen.at("engine_connected") == 1);
    const std::string regulation = heavy ? "UN R13" : "UN R13-H";
    if (chosen.at("friction") >= grips) {
        const double allowed = limit.distance(stop.initial_speed);
        outcome.verdicts.push_back({fmt::format("stopping distance at most {:.1f} m ({})", allowed, regulation),
                                    stop.distance <= allowed, fmt::format("{:.1f} m", stop.distance)});
        outcome.verdicts.push_back(
            {fmt::format("mean fully developed deceleration at least {:.2f} m/s^2 ({})", limit.developed, regulation),
             stop.developed >= limit.developed, fmt::format("{:.2f} m/s^2", stop.developed)});
    } else {
        outcome.notes.push_back(
            "the regulations' distances are for roads that grip well: no verdict on so little friction");
    }
    outcome.verdicts.push_back({"heading within 15 deg", std::abs(stop.heading) <= largest_heading,
                                fmt::format("{:.2f} deg", stop.heading / degree)});
    outcome.verdicts.push_back({"all wheels within a lane 3.5 m wide",
                                stop.beside + half_tire(vehicle) <= braking::lane_width / 2,
                                fmt::format("a wheel {:.2f} m beside the middle", stop.beside)});
}

void add_figures(Outcome& outcome, const VehicleDescription& vehicle, const Settings& chosen, const History& history,
                 const braking::Stop& stop) {
    const double wanted = chosen.at("speed") * kilometer_per_hour;
    const double share = wanted / stop.initial_speed;
    const Series pitch = straight::series(history, history.pitch);
    const double level = interpolated(pitch, braking::approach);
    const auto dive = peak(pitch, Extreme::highest, braking::approach);
    outcome.figures = {
        {"initial speed", "km/h", "as the pedal begins to move", stop.initial_speed / kilometer_per_hour},
        {"stopping distance", "m", "from there to standstill", stop.distance},
        {"stopping distance from the nominal speed", "m", "times the square of the nominal over the initial speed",
         stop.distance * share * share},
        {"stopping time", "s", "likewise", stop.time},
        {"MFDD", "m/s^2", "mean fully developed deceleration, between 80 and 10 percent of the initial speed",
         stop.developed},
        {"mean deceleration", "m/s^2", "v^2 / (2 s) from the pedal to standstill",
         stop.initial_speed * stop.initial_speed / (2 * stop.distance)},
        {"dive", "deg", "most that the pitch angle grows, nose down",
         dive ? (dive->value - level) / degree : braking::nowhere},
        {"change of heading", "deg", "largest, to the left positive", stop.heading / degree},
    };
    braking::add_lock_figures(outcome, vehicle, stop);
}

// A run of the test with the pedal used in one way or another.
Trial braked(const VehicleDescription& vehicle, const ManeuverOptions& options, double friction,
             const braking::Use& use, const TrialOptions& trial_options) {
    ManeuverOptions here = options;
    here.road.friction *= friction;
    // A locked wheel holds about three quarters of its peak, a truck's less; this leaves time.
    constexpr double poor = 0.35;  // [1]
    const double asked = use.pedal * straight::full_brake_force(vehicle) / straight::total_mass(vehicle);
    ScenarioDescription scenario =
        braking::stop(vehicle, here, use, std::min(0.5 * asked, poor * friction * standard_gravity));
    scenario.name = "straight_braking";
    Trial trial = drive(vehicle, scenario, trial_options);
    braking::end_at_standstill(trial);
    return trial;
}

// So that the first axle locks about there after the pedal begins to move (UN R13-H annex 5: between 0.5 and 1 s).
double slow_rise(const VehicleDescription& vehicle, double friction, double pedal) {
    constexpr double first_lock = 0.75;            // [s]
    constexpr double shortest = 0.2, longest = 8;  // [s]
    const double full = straight::full_brake_force(vehicle);
    const double grip = friction * straight::total_mass(vehicle) * standard_gravity;
    return std::clamp(first_lock * pedal * full / grip, shortest, longest);
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    const double friction = chosen.at("friction");
    braking::Use use{.speed = chosen.at("speed") * kilometer_per_hour,
                     .pedal = chosen.at("pedal") / 100,
                     .rise = slow_rise(vehicle, friction, chosen.at("pedal") / 100),
                     .engine_drives = chosen.at("engine_connected") == 1};
    Outcome outcome;
    TrialOptions slowly = straight::trial_options(options, 0, 0.5);
    slowly.film = false;
    Trial slow = braked(vehicle, options, friction, use, slowly);
    if (!take_whole(outcome, slow)) return outcome;
    use.rise = chosen.at("pedal_rise");
    Trial trial = braked(vehicle, options, friction, use, straight::trial_options(options, 0.5, 1));
    if (!take_whole(outcome, trial)) return outcome;
    const braking::Stop stop = braking::evaluated(trial.history);
    add_figures(outcome, vehicle, chosen, trial.history, stop);
    if (std::isnan(stop.distance)) {
        outcome.failed = fmt::format("it did not come to a stop within {:.0f} s: {:.0f} km/h were left",
                                     trial.history.time.back(), trial.history.speed.back() / kilometer_per_hour);
        return outcome;
    }
    add_verdicts(outcome, vehicle, chosen, stop);
    add_lock_order(outcome, vehicle, braking::evaluated(slow.history));
    braking::add_charts(outcome, vehicle, trial.history);
    return outcome;
}

}  // namespace

Maneuver straight_braking() {
    return {
        .name = "straight_braking",
        .title = "Braking straight ahead",
        .standard = "UN R13-H / UN R13 type-0, ISO 21994",
        .summary = "A stop from a speed with the pedal pressed at once, and which axle locks first under a slow pedal.",
        .settings = settings,
        .obstacle = obstacle,
        .drive = drive_it,
        .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
