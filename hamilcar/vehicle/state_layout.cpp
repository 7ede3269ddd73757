#include "hamilcar/vehicle/state_layout.hpp"

#include <array>

#include "hamilcar/vehicle/command_layout.hpp"

namespace hamilcar {

namespace {

constexpr std::array kinds{
    StateKindInfo{StateKind::position, "r", "m", "Velocity", "position of the chassis's origin, ground axes"},
    StateKindInfo{StateKind::orientation, "p", "1", "Velocity", "quaternion of the chassis (or Bryant angles [rad])"},
    StateKindInfo{StateKind::momentum, "p_a", "kg m/s", "Momenta", "momentum of the whole vehicle, ground axes"},
    StateKindInfo{StateKind::angular_momentum, "L_a", "kg m^2/s", "Momenta",
                  "its angular momentum, as it belongs to the orientation"},
    StateKindInfo{StateKind::work, "-", "J", "Momenta", "work of the forces that keep no energy, since the start"},
    StateKindInfo{StateKind::independent, "V", "rad, m", "Velocity", "independent coordinates of a suspension"},
    StateKindInfo{StateKind::dependent, "W", "rad, m", "Momenta", "dependent coordinates of a suspension"},
    StateKindInfo{StateKind::suspension_momentum, "P_V", "kg m^2/s, kg m/s", "Momenta",
                  "momenta conjugate to the independent coordinates"},
    StateKindInfo{StateKind::spin_momentum, "p_s", "kg m^2/s", "Momenta", "spin momentum of a wheel"},
    StateKindInfo{StateKind::brake_windup, "z", "rad", "Momenta", "elastic wind-up of a brake that holds"},
    StateKindInfo{StateKind::tire_deflection, "u, v", "m", "Momenta", "deflections of a tire along and across it"},
    StateKindInfo{StateKind::hitch_angle, "V", "rad", "Velocity", "angles of a trailer against what pulls it"},
    StateKindInfo{StateKind::hitch_momentum, "P_V", "kg m^2/s", "Momenta", "momenta conjugate to these angles"},
    StateKindInfo{StateKind::rotor_momentum, "p_e", "kg m^2/s", "Momenta",
                  "momentum of an engine's or a motor's rotor"},
    StateKindInfo{StateKind::clutch_windup, "z", "rad", "Momenta", "elastic wind-up between rotor and gearbox"},
    StateKindInfo{StateKind::throttle, "-", "1", "Momenta", "throttle as it acts, after the delay of the torque"},
    StateKindInfo{StateKind::converter_torque, "-", "N m", "Momenta", "torque of the oil of a torque converter"},
    StateKindInfo{StateKind::gearbox_momentum, "p_g", "kg m^2/s", "Momenta",
                  "momentum of a gearbox's input that has an inertia"},
    StateKindInfo{StateKind::shafts_windup, "z", "rad", "Momenta", "wind-up of the shafts behind it, play included"},
    StateKindInfo{StateKind::differential_windup, "z", "rad", "Momenta", "elastic wind-up of a differential's shafts"},
    StateKindInfo{StateKind::battery_charge, "-", "1", "Momenta", "charge of the battery, 1 full"},
    StateKindInfo{StateKind::battery_voltage, "-", "V", "Momenta", "voltage at its terminals"},
    StateKindInfo{StateKind::energy_supplied, "-", "J", "Momenta", "energy from engines and motors, since the start"},
    StateKindInfo{StateKind::control_pressure, "-", "Pa", "Momenta", "pressure that the brake pedal makes, of a unit"},
    StateKindInfo{StateKind::brake_pressure, "-", "Pa", "Momenta", "pressure at a wheel's brake"},
    StateKindInfo{StateKind::brake_temperature, "-", "degC", "Momenta", "temperature of a brake's disc or drum"},
    StateKindInfo{StateKind::rack_displacement, "r", "m", "Velocity", "displacement of a rack that moves on its own"},
    StateKindInfo{StateKind::rack_momentum, "P_r", "kg m/s", "Momenta", "momentum conjugate to it"},
    StateKindInfo{StateKind::steering_wheel_angle, "-", "rad", "Momenta", "angle of the steering wheel"},
    StateKindInfo{StateKind::steering_wheel_momentum, "-", "kg m^2/s", "Momenta", "its momentum against the chassis"},
    StateKindInfo{StateKind::steering_windup, "z", "m, rad", "Momenta",
                  "elastic wind-up of the dry friction of rack and steering wheel"},
    StateKindInfo{StateKind::assist_force, "-", "N", "Momenta", "force of the power assist on the rack"},
    StateKindInfo{StateKind::actuator, "-", "1", "Momenta", "what an actuator of a damper or a bar has come to"},
    StateKindInfo{StateKind::axle_steer, "-", "1", "Velocity", "displacement of an axle's own rack over its travel"},
    StateKindInfo{StateKind::axle_steer_rate, "-", "1/s", "Momenta", "its rate"},
};

constexpr bool in_order() {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i].kind != static_cast<StateKind>(i)) return false;
    }
    return kinds.size() == static_cast<std::size_t>(StateKind::axle_steer_rate) + 1;
}
static_assert(in_order());

}  // namespace

bool is_momentum(StateKind kind) {
    switch (kind) {
        case StateKind::momentum:
        case StateKind::angular_momentum:
        case StateKind::suspension_momentum:
        case StateKind::spin_momentum:
        case StateKind::hitch_momentum:
        case StateKind::rotor_momentum:
        case StateKind::gearbox_momentum:
        case StateKind::rack_momentum:
        case StateKind::steering_wheel_momentum: return true;
        default: return false;
    }
}

std::span<const StateKindInfo> state_kinds() {
    return kinds;
}

StateLayout::StateLayout(const VehicleDescription& description) {
    add_chassis();
    for (const SuspensionDescription& suspension : description.suspensions) add_suspension(suspension);
    for (const TrailerDescription& trailer : description.trailers) add_trailer(trailer);
    add_powertrain(description);
    add_brakes(description);
    add_steering(description.steering);
    add_actuators(description);
}

void StateLayout::add_chassis() {
    for (const char* axis : {"x", "y", "z"}) add(StateKind::position, std::string("position.") + axis);
    for (const char* part : {"w", "x", "y", "z"}) add(StateKind::orientation, std::string("orientation.") + part);
    for (const char* axis : {"x", "y", "z"}) add(StateKind::momentum, std::string("momentum.") + axis);
    for (const char* axis : {"x", "y", "z"}) add(StateKind::angular_momentum, std::string("angular_momentum.") + axis);
    add(StateKind::work, "work");
}

void StateLayout::add_suspension(const SuspensionDescription& suspension) {
    const int first = size();
    const int dependent = suspension.linkage.equation_count(),
              independent = suspension.linkage.coordinate_count() - dependent;
    const auto add_all = [&](StateKind kind, int count, const char* what) {
        for (int i = 1; i <= count; ++i) add(kind, suspension.name + what + std::to_string(i));
    };
    add_all(StateKind::independent, independent, ".independent.");
    add_all(StateKind::dependent, dependent, ".dependent.");
    add_all(StateKind::suspension_momentum, independent, ".momentum.");
    SuspensionPlaces places{.offset = first, .size = 0, .wheels = {}};
    for (const SuspensionWheelDescription& wheel : suspension.wheels) {
        places.wheels.push_back(size() - first);
        add_wheel(wheel);
    }
    places.size = size() - first;
    suspensions_.push_back(std::move(places));
}

void StateLayout::add_wheel(const SuspensionWheelDescription& wheel) {
    add(StateKind::spin_momentum, wheel.name + ".spin_momentum");
    add(StateKind::brake_windup, wheel.name + ".brake_windup");
    for (int tire = 0; tire < wheel.tires(); ++tire) {
        const char* which = tire == 0 ? "" : "_2";
        add(StateKind::tire_deflection, wheel.name + ".deflection_x" + which);
        add(StateKind::tire_deflection, wheel.name + ".deflection_y" + which);
    }
}

void StateLayout::add_trailer(const TrailerDescription& trailer) {
    trailers_.push_back(size());
    const std::vector<std::string> angles = hitch_angles(trailer.hitch);
    for (const std::string& angle : angles) add(StateKind::hitch_angle, trailer.name + ".hitch." + angle);
    for (const std::string& angle : angles) add(StateKind::hitch_momentum, trailer.name + ".hitch_momentum." + angle);
}

void StateLayout::add_powertrain(const VehicleDescription& description) {
    for (const PowerUnitDescription& unit : description.power_units) {
        powertrain_.units.push_back(size());
        add(StateKind::rotor_momentum, unit.name + ".momentum");
        add(StateKind::clutch_windup, unit.name + ".windup");
        add(StateKind::throttle, unit.name + ".throttle");
        add(StateKind::converter_torque, unit.name + ".converter_torque");
        if (!unit.shafts.exists) continue;
        add(StateKind::gearbox_momentum, unit.name + ".gearbox_momentum");
        add(StateKind::shafts_windup, unit.name + ".shafts_windup");
    }
    powertrain_.differentials = size();
    if (description.power_units.empty()) return;
    for (const DifferentialDescription& one : description.differentials) {
        add(StateKind::differential_windup, one.name + ".windup");
    }
    powertrain_.battery = size();
    if (description.battery.exists) {
        add(StateKind::battery_charge, "battery.charge"), add(StateKind::battery_voltage, "battery.voltage");
    }
    powertrain_.supplied = size();
    add(StateKind::energy_supplied, "energy_supplied");
}

void StateLayout::add_actuators(const VehicleDescription& description) {
    actuators_ = size();
    const CommandLayout commands(description);
    for (const CommandLayout::Actuator& one : commands.actuators()) {
        add(StateKind::actuator, commands.commands()[static_cast<std::size_t>(one.command)].name);
    }
    axle_steers_ = size();
    for (const AxleSteerDescription& one : description.axle_steers) {
        add(StateKind::axle_steer, one.axle + ".steer"), add(StateKind::axle_steer_rate, one.axle + ".steer_rate");
    }
}

void StateLayout::add_steering(const SteeringDescription& steering) {
    steering_ = size();
    if (!steering.moves_on_its_own()) return;
    add(StateKind::rack_displacement, "rack.displacement"), add(StateKind::rack_momentum, "rack.momentum");
    add(StateKind::steering_wheel_angle, "steering_wheel.angle");
    add(StateKind::steering_wheel_momentum, "steering_wheel.momentum");
    add(StateKind::steering_windup, "rack.windup"), add(StateKind::steering_windup, "steering_wheel.windup");
    add(StateKind::assist_force, "assist.force");
}

void StateLayout::add_brakes(const VehicleDescription& description) {
    brakes_ = size();
    if (!description.brakes.exists) return;
    add(StateKind::control_pressure, "control_pressure");
    for (const TrailerDescription& trailer : description.trailers) {
        add(StateKind::control_pressure, trailer.name + ".control_pressure");
    }
    for_each_wheel(description, [&](const SuspensionWheelDescription& wheel, std::size_t) {
        if (wheel.brake.max_torque <= 0) return;
        add(StateKind::brake_pressure, wheel.name + ".brake.pressure");
        add(StateKind::brake_temperature, wheel.name + ".brake.temperature");
    });
}

}  // namespace hamilcar
