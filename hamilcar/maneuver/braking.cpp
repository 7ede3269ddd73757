#include "hamilcar/maneuver/braking.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/butterworth.hpp"

namespace hamilcar::braking {

namespace {

constexpr double percent = 100;
constexpr double locked = 90;                               // percent of slip
constexpr double locking_counts = 15 * kilometer_per_hour;  // above it, as in UN R13-H [m/s]
constexpr LowPass instrument{.order = 4, .cutoff = 10};     // of decelerations in diagrams

std::size_t pedal_row(const Recording& recording) {
    return sample_at(recording[channel::speed], approach);
}

// How many rows there are until it stands: then it rocks on its tires, which says nothing of the braking.
std::size_t rows_to_standstill(const Recording& recording, std::span<const double> speed) {
    std::size_t row = pedal_row(recording);
    while (row < speed.size() && speed[row] > standing) ++row;
    return row;
}

// The slip of a wheel over time, in percent: 0 rolls as before the pedal, 100 locked, or across its direction.
std::vector<double> slip(const Recording& recording, const std::string& wheel) {
    const std::size_t at = pedal_row(recording);
    const auto turning = recording[channel::wheel_spin(wheel)].values;
    const std::vector<double> speed = ground_speed(recording);
    const double rolling = recording[channel::speed].values[at] / turning[at];
    std::vector<double> out(recording.size(), 0);
    const std::size_t rows = rows_to_standstill(recording, speed);
    for (std::size_t i = 0; i < rows; ++i) {
        if (speed[i] > standing) out[i] = percent * (1 - turning[i] * rolling / speed[i]);
    }
    return out;
}

double lock_time(const Recording& recording, const std::string& wheel, std::span<const double> speed) {
    const std::vector<double> slipping = slip(recording, wheel);
    for (std::size_t i = pedal_row(recording); i < speed.size() && speed[i] > locking_counts; ++i) {
        if (slipping[i] > locked) return recording.time()[i] - approach;
    }
    return not_shown;
}

}  // namespace

Setting initial_speed_setting(const VehicleDescription& vehicle, double default_value, double default_heavy,
                              double max_speed) {
    return {"speed", "km/h", "from which is braked", is_heavy(vehicle) ? default_heavy : default_value, 20, max_speed};
}
Setting rise_setting(const VehicleDescription& vehicle) {
    return {"pedal_rise", "s", "from nothing to that", is_heavy(vehicle) ? 0.4 : 0.1, 0.01, 2};
}

double asked_deceleration(const TestRun& test) {
    return test["pedal"] * brake_force_per_command(test.vehicle) / total_mass(test.vehicle);
}

ScenarioDescription stop(const TestRun& test, double rise, bool engine_connected, double deceleration) {
    constexpr double reserve = 4;       // [s]
    constexpr double suddenly = 0.005;  // from the speed to none, that the foot leaves the throttle [s]
    const double speed = test["speed"];
    ScenarioDescription scenario = driving_at(test, speed, approach + rise + speed / deceleration + reserve);
    lift_foot(scenario, speed, approach, suddenly);
    scenario.brake = {{approach, approach + rise}, {0, test["pedal"]}, Interpolation::linear};
    if (!engine_connected && scenario.driver.shifting) {
        const double gear = scenario.driver.shifting->gear.value_or(1);
        scenario.driver.shifting.reset();
        scenario.gear = {{0, approach}, {gear, 0}, Interpolation::steps};
    }
    return scenario;
}

std::vector<double> ground_speed(const Recording& recording) {
    const auto along = recording[channel::speed].values, across = recording[channel::lateral_speed].values;
    std::vector<double> out;
    for (std::size_t i = 0; i < along.size(); ++i) out.push_back(std::hypot(along[i], across[i]));
    return out;
}

std::vector<double> distance(const Recording& recording) {
    const auto x = recording[channel::x].values, y = recording[channel::y].values;
    std::vector<double> out(x.size(), 0);
    for (std::size_t i = 1; i < out.size(); ++i) out[i] = out[i - 1] + std::hypot(x[i] - x[i - 1], y[i] - y[i - 1]);
    return out;
}

void end_at_standstill(Drive& drive) {
    constexpr double at_rest = 0.5;  // that is kept of it [s]
    Series speed = drive.recording[channel::speed];
    const std::vector<double> over_ground = ground_speed(drive.recording);
    speed.values = over_ground;
    const auto stands = first_crossing(speed, standing, Crossing::falling, approach);
    if (!stands || drive.recording.end() < *stands + at_rest) return;
    const std::size_t count = sample_at(speed, *stands + at_rest) + 1;
    drive.recording.keep_rows(count);
    for (std::vector<double>& column : drive.replay.values) column.resize(std::min(column.size(), count));
}

bool check_stop(TestRun& test, const Drive& drive, const Stop& stop) {
    if (!std::isnan(stop.distance)) return true;
    test.fail("it did not come to a stop within {:.0f} s: {:.0f} km/h were left", drive.recording.end(),
              drive.recording[channel::speed].values.back() / kilometer_per_hour);
    return false;
}

double mean_fully_developed(const Series& speed, const Series& distance, double initial_speed) {
    const auto braked = between_levels(speed, 0.8 * initial_speed, 0.1 * initial_speed, Crossing::falling);
    if (!braked) return not_shown;
    const double way = interpolated(distance, braked->end) - interpolated(distance, braked->begin);
    return (0.64 - 0.01) * initial_speed * initial_speed / (2 * way);  // UN R13-H, with 25.92 = 2 x 3.6^2
}

Stop evaluated(const VehicleDescription& vehicle, const Recording& recording) {
    const std::vector<double> way = distance(recording), over_ground = ground_speed(recording);
    const double rate = recording.rate();
    const Series speed{over_ground, rate}, driven{way, rate};
    Stop out;
    out.initial_speed = interpolated(speed, approach);
    out.developed = mean_fully_developed(speed, driven, out.initial_speed);
    if (const auto stands = first_crossing(speed, standing, Crossing::falling, approach)) {
        const double deceleration = out.developed;  // that also takes the little speed left
        out.distance =
            interpolated(driven, *stands) - interpolated(driven, approach) + standing * standing / (2 * deceleration);
        out.time = *stands - approach + standing / deceleration;
    }
    const std::size_t at = pedal_row(recording);
    const std::vector<double> heading = continued(recording[channel::heading].values);
    for (std::size_t i = at; i < heading.size(); ++i) {
        const double turned = heading[i] - heading[at];
        if (std::abs(turned) > std::abs(out.heading)) out.heading = turned;
    }
    for (const std::string& wheel : wheel_names(vehicle)) {
        out.lock[wheel] = lock_time(recording, wheel, over_ground);
        const auto y = recording[channel::contact_y(wheel)].values.subspan(at);
        out.beside = std::max(out.beside, largest_magnitude(y));
    }
    return out;
}

double nth_lock(const Axle& axle, const Stop& stop, std::size_t n) {
    std::vector<double> locks;
    for (const std::string& wheel : axle.wheels) {
        if (!std::isnan(stop.lock.at(wheel))) locks.push_back(stop.lock.at(wheel));
    }
    const std::size_t wanted = std::min(axle.wheels.size(), n);
    std::ranges::sort(locks);
    return locks.size() < wanted ? not_shown : locks[wanted - 1];
}

void add_figures(TestRun& test, const Stop& stop) {
    test.figure("stopping distance", "m", stop.distance, "from the pedal to standstill");
    test.figure("stopping time", "s", stop.time, "likewise");
    test.figure("MFDD", "m/s^2", stop.developed,
                "mean fully developed deceleration, between 80 and 10 percent of the initial speed");
    for (const Axle& axle : axles(test.vehicle)) {
        test.figure("lock of " + axle.name, "s", nth_lock(axle, stop, 1),
                    "from the pedal to the first wheel of it that slips by 90 percent, above 15 km/h");
    }
}

void judge_lane(TestRun& test, const Stop& stop) {
    test.verdict("all wheels within a lane 3.5 m wide", stop.beside + half_tire(test.vehicle) <= lane_width / 2,
                 fmt::format("a wheel {:.2f} m beside the middle", stop.beside));
}

void add_charts(TestRun& test, const Recording& recording) {
    const std::size_t rows = rows_to_standstill(recording, ground_speed(recording)), at = pedal_row(recording);
    const auto shown = [rows](std::string label, std::span<const double> x, std::span<const double> y) {
        return curve(std::move(label), x.first(rows), y.first(rows));
    };
    const std::vector<double> way = distance(recording), from_pedal = shifted(way, -way[at]),
                              time = shifted(recording.time(), -approach);
    const std::vector<double> deceleration = low_passed_both_ways(
        scaled(recording[channel::longitudinal_acceleration].values, -1), recording.rate(), instrument);
    const std::string from_pedal_on = "time from the pedal [s]";
    const std::vector<double> speed = scaled(recording[channel::speed].values, 1 / kilometer_per_hour);
    test.chart("Speed over distance", "distance from the pedal [m]", "speed [km/h]", {shown("", from_pedal, speed)});
    test.chart("Deceleration, below 10 Hz", from_pedal_on, "deceleration [m/s^2]", {shown("", time, deceleration)});
    io::Chart& slipping = test.chart("Slip of the wheels", from_pedal_on, "slip [%]");
    for (const std::string& wheel : wheel_names(test.vehicle)) {
        slipping.curves.push_back(shown(wheel, time, slip(recording, wheel)));
    }
    test.chart("Pitch and heading", from_pedal_on, "angle [deg]",
               {shown("pitch, nose down", time, recording[channel::pitch].values),
                shown("heading, to the left", time, continued(recording[channel::heading].values))});
}

}  // namespace hamilcar::braking
