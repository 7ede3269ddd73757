#include "hamilcar/maneuver/fishhook_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/slow_steer.hpp"

namespace hamilcar::fishhook_run {

namespace {

constexpr double steering_rate = 720 * degree;  // [rad/s]
constexpr double steering = 1, lift = 0.9;      // when the wheel begins to turn, when the foot leaves [s]
constexpr double longest_dwell = 1.5;           // that feedback waits [s]
constexpr double calm = 1.5 * degree;           // roll rate that ends the dwell [rad/s]
constexpr double hold = 3;                      // of the counter-steer [s]
constexpr double unloaded = 1e-3;               // of its load standing: a side that carries no more is off the road [1]

// The wheels of one side of a unit, by their numbers in a History.
using Side = std::vector<std::size_t>;

std::vector<Side> sides(const VehicleDescription& vehicle) {
    std::vector<Side> out(2 * (vehicle.trailers.size() + 1));
    std::size_t i = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        out[2 * unit + (wheel.wheel.center[1] > 0 ? 0 : 1)].push_back(i++);
    });
    std::erase_if(out, [](const Side& side) { return side.empty(); });
    return out;
}

double load(const History& history, const Side& side, std::size_t row) {
    double sum = 0;
    for (const std::size_t wheel : side) sum += history.wheel_load[wheel][row];
    return sum;
}

double largest(const std::vector<double>& values) {
    double out = 0;
    for (const double value : values) out = std::max(out, std::abs(value));
    return out;
}

}  // namespace

void evaluate(const VehicleDescription& vehicle, const Trial& trial, Run& run) {
    const History& h = trial.history;
    const double interval = 1 / row_rate(h);
    for (const Side& side : sides(vehicle)) {
        double lifted = 0;
        const double standing = load(h, side, 0);
        for (std::size_t i = 0; i < h.size(); ++i) {
            const double part = load(h, side, i) / standing;
            run.lightest = std::min(run.lightest, part);
            lifted = part <= unloaded ? lifted + interval : 0;
            run.lifted = std::max(run.lifted, lifted);
        }
    }
    run.roll = largest(h.roll), run.lateral_acceleration = largest(smoothed(h.lateral_acceleration, 1 / interval));
    run.tips = trial.stopped == Stopped::fell_over || run.lifted >= tip_up_time;
}

double calm_after(const History& h, double reached) {
    for (std::size_t i = row_at(h, reached) + 1; i < h.size(); ++i) {
        const double rate = (std::abs(h.roll[i]) - std::abs(h.roll[i - 1])) / (h.time[i] - h.time[i - 1]);
        if (rate <= calm) return h.time[i] - reached;
    }
    return longest_dwell;
}

Fishhook::Fishhook(const VehicleDescription& vehicle, const ManeuverOptions& options, double angle, bool feedback)
    : vehicle_(vehicle), options_(options), angle_(angle), feedback_(feedback) {}

Trial Fishhook::drive(Run& run, bool film, double from, double to) const {
    const double middle = feedback_ ? 0.5 * (from + to) : from;
    EnergyBook before;
    if (feedback_) {
        Run first = run;
        first.dwell = longest_dwell;
        Trial trial = turn(first, false, true, share(options_, from, middle));
        if (trial.breaks_off()) return trial;
        before = trial.energy;
        run.dwell = calm_after(trial.history, steering + angle_ / steering_rate);
    }
    Trial trial = turn(run, film, false, share(options_, middle, to));
    evaluate(vehicle_, trial, run);
    trial.energy += before;
    return trial;
}

Trial Fishhook::turn(const Run& run, bool film, bool first_turn_only, std::function<bool(double)> keep_going) const {
    const double out = angle_ / steering_rate, back = 2 * out, turned_back = steering + out + run.dwell;
    const double speed = run.speed * kilometer_per_hour, most = run.side * angle_;
    ScenarioDescription scenario =
        driving_at(vehicle_, options_, speed, first_turn_only ? turned_back : turned_back + back + hold);
    scenario.name = fmt::format("fishhook at {:g} km/h, to the {} first", run.speed, run.side > 0 ? "left" : "right");
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering =
        turned({{0, 0}, {steering, 0}, {steering + out, most}, {turned_back, most}, {turned_back + back, -most}});
    lift_foot(scenario, speed, lift);
    return hamilcar::drive(vehicle_, scenario, {.film = film, .keep_going = std::move(keep_going)});
}

}  // namespace hamilcar::fishhook_run
