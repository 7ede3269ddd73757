// Electric drives for any test: the electric hatchback with a battery, with a motor for every rear wheel, and with brakes that its motors
// help.
#pragma once

#include "support/active_chassis.hpp"

namespace hamilcar::test {

// Of 36 kW h, with limits that its motors' 170 kW do not reach.
inline BatteryDescription usual_battery() {
    return {.exists = true,
            .capacity = 100 * 3600,
            .initial_charge = 0.6,
            .charge = {0, 0.1, 0.5, 1},
            .voltage = {280, 330, 355, 400},
            .resistance = 0.08,
            .max_discharge = 180e3,
            .max_charge = 120e3,
            .auxiliary_power = 500};
}

inline MotorDescription& motor_of(VehicleDescription& car, std::size_t unit) {
    return std::get<MotorDescription>(car.power_units[unit].source);
}

inline VehicleDescription electric_car(double brake_regeneration = 0) {
    VehicleDescription car = shipped("electric_hatchback");
    car.battery = usual_battery();
    for (std::size_t i = 0; i < car.power_units.size(); ++i) {
        motor_of(car, i).efficiency = 0.9, motor_of(car, i).brake_regeneration = brake_regeneration;
    }
    return car;
}

// In place of the rear motor one for each wheel, of half its torque, with the differential's ratio as their own; in the chassis, or in the
// wheels, whose carriers then take the reaction.
inline VehicleDescription with_wheel_motors(VehicleDescription car, bool in_wheel) {
    const PowerUnitDescription both = car.power_units[1];
    const DifferentialDescription rear = car.differentials[1];
    car.power_units.pop_back(), car.differentials.pop_back();
    for (const DrivenPart& wheel : rear.outputs) {
        PowerUnitDescription unit = both;
        unit.name = wheel.number == 2 ? "rear_left_motor" : "rear_right_motor";
        unit.output = wheel, unit.gearbox.ratios = {rear.ratio}, unit.gearbox.reverse_ratio = rear.ratio;
        unit.inertia /= 2, unit.in_wheel = in_wheel;
        MotorDescription& motor = std::get<MotorDescription>(unit.source);
        motor.max_torque /= 2, motor.max_power /= 2;
        car.power_units.push_back(unit);
        if (!in_wheel) continue;
        SuspensionWheelDescription* own = nullptr;
        std::size_t number = 0;
        for (SuspensionDescription& suspension : car.suspensions) {
            for (SuspensionWheelDescription& one : suspension.wheels) {
                if (number++ == wheel.number) own = &one;
            }
        }
        own->drive_reaction = own->part;
        own->wheel.spin_inertia += rear.ratio * rear.ratio * unit.inertia;
    }
    return car;
}

// In a forward gear, with the pedal over time.
inline ScenarioDescription pedal(double duration, double speed, const SignalDescription& throttle) {
    ScenarioDescription s = scenario(duration, speed);
    s.throttle = throttle;
    s.gear = {{0}, {1}, Interpolation::steps};
    return s;
}

}  // namespace hamilcar::test
