#include "hamilcar/maneuver/fishhook_run.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/slow_steer.hpp"

namespace hamilcar::fishhook_run {

namespace {

constexpr double steering_rate = 720 * degree;  // [rad/s]
constexpr double steering = 1, lift = 0.9;      // when the wheel begins to turn, when the foot leaves [s]
constexpr double longest_dwell = 1.5;           // that feedback waits [s]
constexpr double calm = 1.5;                    // roll rate that ends the dwell [deg/s]
constexpr double hold = 3;                      // of the counter-steer [s]
constexpr double unloaded = 1e-3;               // of its load standing: a side that carries no more is off the road [1]

// The wheels of one side of a unit.
using Side = std::vector<std::string>;

std::vector<Side> sides(const VehicleDescription& vehicle) {
    std::vector<Side> out(2 * (vehicle.trailers.size() + 1));
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        out[2 * unit + (wheel.wheel.center[1] > 0 ? 0 : 1)].push_back(wheel.name);
    });
    std::erase_if(out, [](const Side& side) { return side.empty(); });
    return out;
}

std::vector<double> load(const Recording& recording, const Side& side) {
    std::vector<double> sum(recording.size());
    for (const std::string& wheel : side) {
        const auto load = recording[channel::wheel_load(wheel)].values;
        std::ranges::transform(sum, load, sum.begin(), std::plus());
    }
    return sum;
}

Drive turn(const TestRun& test, const Run& run, double angle, bool first_turn_only, const DriveOptions& options) {
    const double out = angle / steering_rate, back = 2 * out, turned_back = steering + out + run.dwell;
    const double speed = run.speed * kilometer_per_hour, first = run.side * angle;
    ScenarioDescription scenario = steered_at(
        test, speed,
        turned({{0, 0}, {steering, 0}, {steering + out, first}, {turned_back, first}, {turned_back + back, -first}}));
    scenario.duration = first_turn_only ? turned_back : turned_back + back + hold;
    scenario.name = fmt::format("fishhook at {:g} km/h, to the {} first", run.speed, run.side > 0 ? "left" : "right");
    lift_foot(scenario, speed, lift);
    return test.drive(scenario, options);
}

}  // namespace

void evaluate(const VehicleDescription& vehicle, const Drive& drive, Run& run) {
    const Recording& recording = drive.recording;
    for (const Side& side : sides(vehicle)) {
        const std::vector<double> carried = load(recording, side);
        double lifted = 0;
        for (const double now : carried) {
            run.lightest = std::min(run.lightest, now / carried.front());
            lifted = now / carried.front() <= unloaded ? lifted + 1 / recording.rate() : 0;
            run.lifted = std::max(run.lifted, lifted);
        }
    }
    run.roll = largest(recording, channel::roll);
    run.lateral_acceleration = largest_magnitude(smoothed(recording[channel::lateral_acceleration]));
    run.tips = drive.stopped == Stopped::fell_over || run.lifted >= tip_up_time;
}

double calm_after(const Recording& recording, double reached) {
    const Series roll = recording[channel::roll];
    for (std::size_t i = sample_at(roll, reached) + 1; i < roll.values.size(); ++i) {
        const double rate = (std::abs(roll.values[i]) - std::abs(roll.values[i - 1])) * roll.rate;
        if (rate <= calm) return roll.time(i) - reached;
    }
    return longest_dwell;
}

Drive drive(const TestRun& test, Run& run, double angle, bool feedback, Share share) {
    const double middle = feedback ? 0.5 * (share.from + share.to) : share.from;
    EnergyBalance before;
    std::vector<ValidityWarning> validity_before;
    if (feedback) {
        Run first = run;
        first.dwell = longest_dwell;
        Drive drive = turn(test, first, angle, true, {.share = {share.from, middle}, .replay = false});
        if (drive.breaks_off()) return drive;
        before = drive.energy, validity_before = drive.validity;
        run.dwell = calm_after(drive.recording, steering + angle / steering_rate);
    }
    Drive drive = turn(test, run, angle, false, {.share = {middle, share.to}});
    evaluate(test.vehicle, drive, run);
    drive.energy += before;
    add_warnings(std::move(validity_before), "", drive.validity);
    return drive;
}

}  // namespace hamilcar::fishhook_run
