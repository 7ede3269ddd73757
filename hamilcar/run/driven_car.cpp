#include "hamilcar/run/driven_car.hpp"

#include <cmath>
#include <numbers>

#include "hamilcar/analysis/wheel_motion.hpp"
#include "hamilcar/block/road_wheels.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

constexpr double default_lock =
    2.5 * std::numbers::pi;          // where a vehicle file does not say how far the rack goes [rad]
constexpr double some_steer = 1e-3;  // a wheel that turns less per rack is not steered [rad/m]

struct Mean {
    double sum = 0, weight = 0;
    void add(double value, double share = 1) { sum += share * value, weight += share; }
    double value(double fallback) const { return weight > 0 ? sum / weight : fallback; }
};

// Steered and other wheels of the motor vehicle: turn per rack, and the places along x of either.
struct SteeredWheels {
    Mean steer, steered_x, fixed_x;
};

SteeredWheels steered_wheels(const VehicleDescription& vehicle, const Model<double>& model,
                             const State<double>& state) {
    const auto motions = wheel_motions(vehicle, model, state, 0);
    SteeredWheels out;
    std::size_t i = 0;
    for_each_wheel(vehicle, [&](const auto&, std::size_t unit) {
        const WheelMotion& motion = motions[i++];
        if (unit != 0) return;
        const double steer = motion.steer[5];
        const bool steered = std::abs(steer) > some_steer;
        (steered ? out.steered_x : out.fixed_x).add(motion.design_center[0]);
        if (steered) out.steer.add(steer);
    });
    return out;
}

// Of the wheels that drive: those of differentials, or those with a share of a prescribed torque.
double driven_radius(const Vehicle<double>& vehicle) {
    Mean radius;
    std::vector<double> radii;
    for (const Suspension<double>& suspension : vehicle.suspensions) {
        for (const auto& wheel : suspension.wheels) radii.push_back(rolling_radius(wheel.tire));
    }
    for (const int wheel : vehicle.powertrain.wheels) radius.add(radii[static_cast<std::size_t>(wheel)]);
    if (radius.weight > 0) return radius.value(0);
    std::size_t i = 0;
    for (const Suspension<double>& suspension : vehicle.suspensions) {
        for (const auto& wheel : suspension.wheels) radius.add(radii[i++], wheel.drive_share);
    }
    return radius.value(0);
}

// As it grows below the command at which valves act or a booster reaches its limit: that is where a driver brakes most.
double full_brake_force(const Vehicle<double>& vehicle, const BrakeSystemDescription& brakes) {
    double sum = 0;
    const auto add = [&](const auto& wheel) { sum += wheel.brake.max_torque / rolling_radius(wheel.tire); };
    for (const Suspension<double>& suspension : vehicle.suspensions) {
        for (const auto& wheel : suspension.wheels) add(wheel);
    }
    return sum * brakes.gain_below_knee();
}

void add_steering(const VehicleDescription& vehicle, const Model<double>& model, const State<double>& state,
                  DrivenCar& car) {
    const Column column(vehicle.steering);
    const SteeredWheels wheels = steered_wheels(vehicle, model, state);
    const double front = wheels.steered_x.value(0), wheelbase = std::abs(front - wheels.fixed_x.value(0));
    if (wheelbase > 0) car.wheelbase = wheelbase;
    car.center_behind = front - vehicle.chassis.center_of_mass[0];
    if (!column.exists() || wheels.steer.weight == 0) return;
    car.lock = vehicle.steering.rack_travel > 0 ? column.angle(vehicle.steering.rack_travel) : default_lock;
    car.wheels_per_angle = wheels.steer.value(0) * column.center_ratio();
}

void add_power(const VehicleDescription& vehicle, DrivenCar& car) {
    car.powered = !vehicle.power_units.empty();
    if (!car.powered) return;
    const PowerUnitDescription& unit = vehicle.power_units.front();
    car.gearbox = unit.gearbox;
    car.gears = static_cast<int>(unit.gearbox.ratios.size());
    car.has_reverse = unit.gearbox.reverse_ratio > 0;
    const auto* clutch = std::get_if<ClutchDescription>(&unit.coupling);
    car.has_clutch = clutch && clutch->capacity > 0;
    if (const auto* engine = std::get_if<EngineDescription>(&unit.source)) car.idle_speed = engine->idle_speed;
}

}  // namespace

DrivenCar driven_car(const VehicleDescription& vehicle, const Model<double>& model, const State<double>& state) {
    DrivenCar car;
    car.mass = model.vehicle.total_mass;
    car.wheel_radius = driven_radius(model.vehicle);
    car.full_brake_force = full_brake_force(model.vehicle, vehicle.brakes);
    add_steering(vehicle, model, state, car);
    add_power(vehicle, car);
    return car;
}

}  // namespace hamilcar
