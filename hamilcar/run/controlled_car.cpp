#include "hamilcar/run/controlled_car.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hamilcar/analysis/wheel_motion.hpp"
#include "hamilcar/block/road_wheels.hpp"
#include "hamilcar/io/error.hpp"

namespace hamilcar {

namespace {

constexpr double some_steer = 1e-3;  // a wheel that turns less per rack is not steered [rad/m]

// Of the motor vehicle about its center of mass, with everything on its suspensions as points.
double yaw_inertia(const VehicleDescription& vehicle) {
    double inertia = vehicle.chassis.inertia[2];
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        if (suspension.unit != 0) continue;
        for (const SuspensionBodyDescription& one : suspension.bodies) {
            const double x = one.body.center_of_mass[0] - vehicle.chassis.center_of_mass[0],
                         y = one.body.center_of_mass[1] - vehicle.chassis.center_of_mass[1];
            inertia += one.body.mass * (x * x + y * y) + one.body.inertia[2];
        }
    }
    return inertia;
}

// Adds all wheels that a part drives; returns the torque of all of them over that at the part, without locks.
double add_driven_wheels(const VehicleDescription& vehicle, const DrivenPart& part, std::vector<std::size_t>& to) {
    if (part.wheel) {
        to.push_back(part.number);
        return 1;
    }
    const DifferentialDescription& one = vehicle.differentials[part.number];
    const double first = add_driven_wheels(vehicle, one.outputs[0], to),
                 second = add_driven_wheels(vehicle, one.outputs[1], to);
    return one.ratio * (one.share * first + (1 - one.share) * second);
}

std::vector<ControlledUnit> controlled_units(const VehicleDescription& vehicle) {
    std::vector<ControlledUnit> out;
    for (const PowerUnitDescription& unit : vehicle.power_units) {
        ControlledUnit& own = out.emplace_back();
        own.name = unit.name;
        own.ratio = unit.gearbox.ratios[0] * add_driven_wheels(vehicle, unit.output, own.wheels);
        if (const auto* motor = std::get_if<MotorDescription>(&unit.source)) own.motor_torque = motor->max_torque;
    }
    return out;
}

bool is_driven(const ControlledCar& car, std::size_t wheel) {
    return std::ranges::any_of(car.units, [wheel](const ControlledUnit& unit) {
        return std::ranges::find(unit.wheels, wheel) != unit.wheels.end();
    });
}

// Axles with an actuator for their rack, by how their wheels turn with it.
std::vector<ControlledSteer> controlled_steers(const VehicleDescription& vehicle,
                                               const std::vector<WheelMotion>& motions) {
    std::vector<ControlledSteer> out;
    for (const AxleSteerDescription& one : vehicle.axle_steers) out.push_back({.axle = one.axle});
    std::size_t wheel = 0;
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        for (const SuspensionWheelDescription& own : suspension.wheels) {
            const WheelMotion& motion = motions[wheel++];
            if (!suspension.steered_by) continue;
            ControlledSteer& steer = out[*suspension.steered_by];
            steer.angle += 0.5 * vehicle.axle_steers[*suspension.steered_by].travel * motion.own_steer[5];
            steer.x = own.wheel.center[0] - vehicle.chassis.center_of_mass[0];
        }
    }
    return out;
}

// The one that a wheel's command sets, or one that is not adjustable.
DamperDescription adjustable_damper(const VehicleDescription& vehicle, const CommandLayout& layout, std::size_t wheel) {
    const int command = layout.damper(wheel);
    for (std::size_t s = 0; command >= 0 && s < vehicle.suspensions.size(); ++s) {
        const std::vector<SuspensionDamperDescription>& dampers = vehicle.suspensions[s].dampers;
        for (std::size_t i = 0; i < dampers.size(); ++i) {
            if (layout.damper(s, i) == command) return dampers[i].damper;
        }
    }
    return {};
}

}  // namespace

ControlledCar controlled_car(const VehicleDescription& vehicle, const Model<double>& model, const DrivenCar& driven,
                             const State<double>& state, const Input<double>& input) {
    ControlledCar out{.mass = driven.mass,
                      .yaw_inertia = yaw_inertia(vehicle),
                      .wheelbase = driven.wheelbase,
                      .center_behind = driven.center_behind,
                      .wheels_per_angle = driven.wheels_per_angle,
                      .full_pressure = vehicle.brakes.exists ? vehicle.brakes.full_pressure : 0,
                      .wheels = {},
                      .bars = {},
                      .units = {},
                      .steers = {}};
    for (const AntiRollBarDescription& bar : vehicle.anti_roll_bars) {
        out.bars.push_back({bar.left, bar.right, bar.max_force});
    }
    out.units = controlled_units(vehicle);
    State<double> start = state;
    const auto velocity = velocity_block(model, start, input);
    const auto momenta = momenta_block(model, start, input, velocity);
    const std::vector<RoadWheel> on_road = road_wheels(model, momenta, start);
    const std::vector<WheelMotion> motions = wheel_motions(vehicle, model, start, input.rack.displacement);
    out.steers = controlled_steers(vehicle, motions);
    const CommandLayout layout(vehicle);
    for_each_wheel(vehicle, [&](const SuspensionWheelDescription& wheel, std::size_t unit) {
        const std::size_t i = out.wheels.size();
        const Point& center =
            unit == 0 ? vehicle.chassis.center_of_mass : vehicle.trailers[unit - 1].chassis.center_of_mass;
        const DamperDescription damper = adjustable_damper(vehicle, layout, i);
        double load = 0;
        for (const RoadTire& tire : on_road[i].tires) load += tire.forces->tire.Fz;
        out.wheels.push_back({.name = wheel.name,
                              .unit = static_cast<int>(unit),
                              .x = wheel.wheel.center[0] - center[0],
                              .y = wheel.wheel.center[1] - center[1],
                              .radius = rolling_radius(*on_road[i].tires[0].tire),
                              .spin_inertia = wheel.wheel.spin_inertia,
                              .steered = unit == 0 && std::abs(motions[i].steer[5]) > some_steer,
                              .driven = is_driven(out, i),
                              .brake_torque = wheel.brake.max_torque,
                              .damper_soft = damper.soft,
                              .damper_firm = damper.firm,
                              .static_load = load});
    });
    return out;
}

std::shared_ptr<const ControlSystem> make_control(const ScenarioDescription& scenario,
                                                  const VehicleDescription& vehicle, const ControlledCar& car) {
    try {
        return std::make_shared<ControlSystem>(vehicle, car, scenario.solver.step);
    } catch (const std::invalid_argument& mistake) {
        const std::string message = mistake.what(), word = message.substr(0, message.find(' '));
        const bool is_key = word.find_first_of(".[") != std::string::npos;
        throw io::Error(io::ExitCode::bad_file,
                        is_key ? at_key(vehicle.places, word) + "key '" + word + "'" + message.substr(word.size())
                               : at_key(vehicle.places) + message);
    }
}

std::optional<double> free_steering_wheel(const Vehicle<double>& vehicle, const State<double>& state) {
    if (!vehicle.steering.exists()) return {};
    return vehicle.steering.state(state.values.data()).wheel;
}

void let_decide(const ControlSystem& control, const Column& column, const StepTime& now, std::span<double> memory,
                Schedule& schedule) {
    const auto at = [&](Control which) { return schedule.signal(which).at(now.time).value; };
    const double asked = column.exists() ? column.angle(at(Control::rack)) : 0;
    const DriverActions driver{.steering_wheel = now.steering_wheel.value_or(asked),
                               .brake = at(Control::brake),
                               .throttle = at(Control::throttle),
                               .gear = at(Control::gear)};
    std::array<double, max_commands> commands;
    const std::span<double> told(commands.data(), schedule.commands().size());
    std::ranges::copy(schedule.commands(), told.begin());
    control.act(now.step, driver, memory, told);
    schedule.set_commands(told);
}

}  // namespace hamilcar
