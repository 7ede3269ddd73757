#include "hamilcar/analysis/pull.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/tire/list.hpp"
#include "hamilcar/vehicle/build.hpp"

namespace hamilcar {

namespace {

// With the pedal down, at a speed of the rotor [N m].
double full_torque(const EngineDescription& engine, double speed) {
    const TorqueCurve& curve = engine.torque.back();
    return interpolated(curve.speed, curve.torque, speed);
}
// Of a motor at a voltage that its battery has without load; the last of its map without one.
double full_torque(const ElectricMotor<double>& motor, const BatteryDescription& battery, double speed) {
    constexpr double endless = 1e9;  // [V]
    if (speed >= motor.max_speed) return 0;
    return motor.strongest(speed, battery.exists ? battery.voltage.back() : endless);
}

// Pull of one gear as a function of speed, with the vehicle looked at once.
class Pull {
public:
    explicit Pull(const VehicleDescription& vehicle) : vehicle_(vehicle), outputs_(output_speeds(vehicle)) {}

    double operator()(int gear, double speed) const {
        const BatteryDescription& battery = vehicle_.battery;
        double engines = 0, motors = 0, power = 0;
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
            const PowerUnitDescription& unit = vehicle_.power_units[i];
            const auto& ratios = unit.gearbox.ratios;
            const auto place = std::min(static_cast<std::size_t>(std::max(gear, 1)), ratios.size()) - 1;
            const double turns = ratios[place] * outputs_[i];  // of the rotor, over the speed [rad/m]
            const double passed = turns * unit.gearbox.efficiency;
            if (const auto* engine = std::get_if<EngineDescription>(&unit.source)) {
                engines += full_torque(*engine, turns * speed) * passed;
                continue;
            }
            const ElectricMotor<double> motor(std::get<MotorDescription>(unit.source));
            const double torque = full_torque(motor, battery, turns * speed);
            motors += torque * passed, power += motor.electric_power(torque, turns * speed);
        }
        const double most = battery.max_discharge - battery.auxiliary_power;
        return engines + (battery.exists && power > most ? motors * most / power : motors);
    }

private:
    const VehicleDescription& vehicle_;
    std::vector<double> outputs_;
};

double tire_coefficient(const TireDescription& tire) {
    return std::visit(
        [](const auto& t) -> double {
            using Kind = std::decay_t<decltype(t)>;
            if constexpr (std::is_same_v<Kind, SpringTireDescription>) {
                return 0;
            } else if constexpr (std::is_same_v<Kind, MagicFormulaDescription>) {
                return t.coefficients[QSY1];
            } else {
                return t.rolling_resistance;
            }
        },
        tire);
}

// Of all tires, by their coefficients, as if each carried the same [N].
double tire_resistance(const VehicleDescription& vehicle) {
    double sum = 0;
    int wheels = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { sum += tire_coefficient(wheel.tire), ++wheels; });
    return wheels ? sum / wheels * total_mass(vehicle) * vehicle.gravity : 0;
}

}  // namespace

std::vector<double> output_speeds(const VehicleDescription& vehicle) {
    const Vehicle<double> car(vehicle);
    const std::vector<double> radii = rolling_radii(vehicle);
    PowertrainMotion<double> rolling;
    rolling.axle_turns.fill(0);
    for (std::size_t i = 0; i < car.powertrain.wheels.size(); ++i) {
        rolling.wheels[i] = 1 / radii[static_cast<std::size_t>(car.powertrain.wheels[i])];
    }
    const auto inputs = car.powertrain.input_speeds(rolling);
    std::vector<double> out;
    for (const PowerUnit<double>& unit : car.powertrain.units) {
        out.push_back(car.powertrain.value(unit.output, rolling.wheels, inputs));
    }
    return out;
}

int highest_gear(const VehicleDescription& vehicle) {
    return vehicle.power_units.empty() ? 0 : static_cast<int>(vehicle.power_units.front().gearbox.ratios.size());
}

double full_pull(const VehicleDescription& vehicle, int gear, double speed) {
    return Pull(vehicle)(gear, speed);
}

double air_resistance(const VehicleDescription& vehicle, double speed) {
    return 0.5 * vehicle.aerodynamics.air_density * vehicle.aerodynamics.drag_area * speed * speed;
}

Resistance resistance(const VehicleDescription& vehicle, double speed) {
    const double air = air_resistance(vehicle, speed);
    if (driven_share(vehicle) <= 0) return {air, tire_resistance(vehicle)};
    double driven = 0, turning = 0;
    std::size_t number = 0;
    const std::vector<double> radii = rolling_radii(vehicle);
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        driven += wheel.drive_share, turning += wheel.drive_share / radii[number++];
    });
    try {  // a torque does work with the wheels' turning
        return {air, steady_handling(vehicle, speed).drive_torque * turning / driven - air};
    } catch (const NoSolution&) {
        return {air, tire_resistance(vehicle)};
    }
}

std::optional<Balance> fastest(const VehicleDescription& vehicle) {
    if (vehicle.power_units.empty()) return {};
    constexpr double slow = 15, step = 0.05, fastest_tried = 150;  // [m/s]
    const double rest = resistance(vehicle, slow).rest;            // hardly changes with the speed
    const Pull pull(vehicle);
    std::optional<Balance> best;
    for (int gear = 1; gear <= highest_gear(vehicle); ++gear) {
        for (double v = fastest_tried; v > 0; v -= step) {
            if (pull(gear, v) < air_resistance(vehicle, v) + rest) continue;
            if (!best || v > best->speed) best = Balance{gear, v};
            break;
        }
    }
    return best;
}

double rolling_mass(const VehicleDescription& vehicle) {
    double mass = total_mass(vehicle);
    std::size_t number = 0;
    const std::vector<double> radii = rolling_radii(vehicle);
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        mass += wheel.wheel.spin_inertia / (radii[number] * radii[number]);
        ++number;
    });
    return mass;
}

}  // namespace hamilcar
