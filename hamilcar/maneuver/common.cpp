#include "hamilcar/maneuver/common.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/steering/column.hpp"
#include "hamilcar/tire/list.hpp"
#include "hamilcar/vehicle/build.hpp"

namespace hamilcar {

namespace {

// How fast the rotor of the first power unit turns per speed of the vehicle in direct drive [rad/m].
double rotor_per_speed(const VehicleDescription& vehicle) {
    const Vehicle<double> car(vehicle);
    std::vector<double> radii;
    for (const Suspension<double>& suspension : car.suspensions) {
        for (const auto& wheel : suspension.wheels) {
            radii.push_back(std::visit([](const auto& tire) { return tire.rolling_radius; }, wheel.tire));
        }
    }
    std::array<double, max_driven_wheels> turning{};
    for (std::size_t i = 0; i < car.powertrain.wheels.size(); ++i) {
        turning[i] = 1 / radii[static_cast<std::size_t>(car.powertrain.wheels[i])];
    }
    return car.powertrain.input_speeds(turning)[static_cast<std::size_t>(car.powertrain.units.front().output)];
}

}  // namespace

int gear_for(const VehicleDescription& vehicle, double speed) {
    if (vehicle.power_units.empty()) return 0;
    const PowerUnitDescription& unit = vehicle.power_units.front();
    const auto* engine = std::get_if<EngineDescription>(&unit.source);
    if (!engine) return 1;
    constexpr double lively = 2;  // times the idle speed
    const double shaft = rotor_per_speed(vehicle) * speed;
    int gear = static_cast<int>(unit.gearbox.ratios.size());
    while (gear > 1 && unit.gearbox.ratios[static_cast<std::size_t>(gear) - 1] * shaft < lively * engine->idle_speed) {
        --gear;
    }
    return gear;
}

ScenarioDescription driving_at(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed,
                               double duration) {
    ScenarioDescription scenario;
    scenario.duration = duration;
    scenario.solver = options.solver;
    scenario.road = options.road;
    scenario.initial.velocity = {speed, 0, 0};
    scenario.driver.speed.emplace();
    scenario.driver.speed->speed = {.time = {0}, .value = {speed}, .interpolation = Interpolation::linear};
    if (!vehicle.power_units.empty()) scenario.driver.shifting = ShiftingDescription{.gear = gear_for(vehicle, speed)};
    return scenario;
}

std::string needs_steering(const VehicleDescription& vehicle) {
    return vehicle.steering.rack_per_revolution > 0 ? "" : "it cannot be steered: its file has no [steering]";
}
std::string needs_drive(const VehicleDescription& vehicle) {
    return !vehicle.power_units.empty() || driven_share(vehicle) > 0 ? "" : "no wheel of it is driven";
}
std::string needs_steering_and_drive(const VehicleDescription& vehicle) {
    const std::string steering = needs_steering(vehicle);
    return steering.empty() ? needs_drive(vehicle) : steering;
}
std::string needs_power_units(const VehicleDescription& vehicle) {
    return vehicle.power_units.empty() ? "its file has no [[power_unit]]" : "";
}

double half_tire(const VehicleDescription& vehicle) {
    constexpr double least = 0.1;        // [m]
    constexpr double per_radius = 0.27;  // 11 R 22.5: 0.28 m wide, 1.05 m high
    double half = least;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        half = std::max(half, per_radius * casing_of(wheel.tire).radius);
    });
    return half;
}

Footprint footprint(const VehicleDescription& vehicle) {
    const Point& center = vehicle.chassis.center_of_mass;
    const double half = half_tire(vehicle);
    Footprint box{-1e9, 1e9, -1e9, 1e9};
    const auto add = [&](double x, double y, double beside, double ahead) {
        box.front = std::max(box.front, x - center[0] + ahead), box.rear = std::min(box.rear, x - center[0] - ahead);
        box.left = std::max(box.left, y - center[1] + beside), box.right = std::min(box.right, y - center[1] - beside);
    };
    for (const Point& point : vehicle.hull.points) add(point[0], point[1], 0, 0);
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        const Point& at = wheel.wheel.center;
        if (unit == 0) add(at[0], at[1], half + 0.5 * wheel.dual_spacing, at[2]);
    });
    return box;
}

double rear_end(const VehicleDescription& vehicle) {
    double rear = footprint(vehicle).rear;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        const Point& at = wheel.wheel.center;
        rear = std::min(rear, at[0] - at[2] - vehicle.chassis.center_of_mass[0]);
    });
    return rear;
}

double wheelbase(const VehicleDescription& vehicle) {
    double front = -1e9, rear = 1e9;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        if (unit != 0) return;
        front = std::max(front, wheel.wheel.center[0]), rear = std::min(rear, wheel.wheel.center[0]);
    });
    return front - rear;
}

double steer_per_angle(const VehicleDescription& vehicle) {
    constexpr double slow = 10;  // [m/s]; the ratio is that of the linkage at any speed
    if (vehicle.steering.rack_per_revolution <= 0) return 0;
    return 1 / steady_handling(vehicle, slow).steering_ratio;
}

double steering_lock(const VehicleDescription& vehicle) {
    constexpr double hair = 0.99;              // of the lock, within what a scenario's check allows
    constexpr double endless = 1000 * degree;  // where a file says nothing of stops
    const Column column(vehicle.steering);
    if (!column.exists() || vehicle.steering.rack_travel <= 0) return endless;
    return hair * column.angle(vehicle.steering.rack_travel);
}

double angle_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration) {
    const SteadyHandling handling = steady_handling(vehicle, speed);
    return lateral_acceleration / (handling.lateral_acceleration_gain * handling.rack_per_angle);
}

bool add_search_trial(Outcome& outcome, const Trial& trial) {
    outcome.energy += trial.energy;
    if (judge_energy(trial.energy.error(), trial.energy.turnover) == EnergyVerdict::doubtful) {
        const std::string note = "the energy account of a drive is off by more than 1 percent: try a smaller step";
        if (std::ranges::find(outcome.notes, note) == outcome.notes.end()) outcome.notes.push_back(note);
    }
    if (!trial.breaks_off()) return true;
    if (!outcome.failed) outcome.failed = trial.trouble;
    outcome.stopped = trial.stopped;
    return false;
}

bool add_trial(Outcome& outcome, Trial trial) {
    for (const std::string& complaint : trial.complaints) outcome.notes.push_back(complaint);
    if (trial.stopped == Stopped::fell_over) outcome.notes.push_back(trial.trouble);
    if (!trial.film.columns.empty()) outcome.runs.push_back(std::move(trial.film));
    return add_search_trial(outcome, trial);
}

bool take_whole(Outcome& outcome, Trial& trial) {
    for (const std::string& complaint : trial.complaints) outcome.notes.push_back(complaint);
    if (!trial.film.columns.empty()) outcome.runs.push_back(std::move(trial.film));
    if (!add_search_trial(outcome, trial)) return false;
    if (trial.stopped == Stopped::no) return true;
    outcome.failed = trial.trouble;
    return false;
}

std::size_t row_at(const History& history, double time) {
    const auto row = std::ranges::lower_bound(history.time, time - 1e-9);
    return std::min(static_cast<std::size_t>(row - history.time.begin()), history.size() - 1);
}

}  // namespace hamilcar
