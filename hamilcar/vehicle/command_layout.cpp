#include "hamilcar/vehicle/command_layout.hpp"

#include <algorithm>

namespace hamilcar {

CommandLayout::CommandLayout(const VehicleDescription& vehicle) {
    const bool controlled = !vehicle.controllers.empty();
    for_each_wheel(vehicle, [&](const SuspensionWheelDescription& wheel, std::size_t) {
        const bool modulated = controlled && vehicle.brakes.modulated && wheel.brake.max_torque > 0;
        brakes_.push_back(modulated ? size() : -1);
        if (!modulated) return;
        const std::string name = wheel.name + ".brake.";
        commands_.push_back({name + "inlet", "1", "opening of the valve from the pedal's pressure", 1, 0, 1});
        commands_.push_back({name + "outlet", "1", "opening of the valve that lets pressure out", 0, 0, 1});
        commands_.push_back({name + "pump", "1", "share of the pump's flow to this wheel", 0, 0, 1});
    });
    add_units(vehicle);
    add_dampers(vehicle), add_bars(vehicle);
    for (const AxleSteerDescription& one : vehicle.axle_steers) {
        axle_steers_.push_back(controlled ? size() : -1);
        if (!controlled) continue;
        commands_.push_back({one.axle + ".steer", "1", "share of the travel of the axle's own rack", 0, -1, 1});
    }
}

void CommandLayout::add_units(const VehicleDescription& vehicle) {
    const bool controlled = !vehicle.controllers.empty();
    const int first = size();
    for (const PowerUnitDescription& unit : vehicle.power_units) {
        units_.push_back(controlled ? size() : -1);
        if (!controlled) continue;
        commands_.push_back({unit.name + ".max_throttle", "1", "the most that the throttle opens", 1, 0, 1});
        commands_.push_back({unit.name + ".min_throttle", "1", "the least that it opens", 0, 0, 1});
        if (!std::holds_alternative<MotorDescription>(unit.source)) continue;
        commands_.push_back(
            {unit.name + ".added_torque", "1", "besides what the pedal asks for, of the largest torque", 0, -1, 1});
        commands_.push_back(
            {unit.name + ".max_regeneration", "1", "of what the brake pedal may ask of the motor", 1, 0, 1});
    }
    of_all_units_ = size() - first;
}

void CommandLayout::add_dampers(const VehicleDescription& vehicle) {
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        std::vector<int>& of_suspension = dampers_.emplace_back();
        for (const SuspensionDamperDescription& one : suspension.dampers) {
            const DamperDescription& damper = one.damper;
            const bool takes = !vehicle.controllers.empty() && damper.is_adjustable();
            of_suspension.push_back(takes ? size() : -1);
            if (!takes) continue;
            // At rest it has the force that the file states.
            const double rest = (1 - damper.soft) / (damper.firm - damper.soft);
            actuators_.push_back({size(), damper.response_time});
            commands_.push_back({one.name + ".damper.setting", "1", "of the damper, 0 soft to 1 firm", rest, 0, 1});
        }
        for (const SuspensionWheelDescription& wheel : suspension.wheels) {
            int first = -1;
            for (std::size_t i = suspension.dampers.size(); i-- > 0;) {
                const std::string& name = suspension.dampers[i].name;  // "front_left", further ones "front_left_2"
                const bool own = name == wheel.name || name.starts_with(wheel.name + "_");
                if (own && of_suspension[i] >= 0) first = of_suspension[i];
            }
            wheel_dampers_.push_back(first);
        }
    }
}

void CommandLayout::add_bars(const VehicleDescription& vehicle) {
    std::vector<std::string> wheels;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { wheels.push_back(wheel.name); });
    for (const AntiRollBarDescription& bar : vehicle.anti_roll_bars) {
        const bool takes = !vehicle.controllers.empty() && bar.max_force > 0;
        bars_.push_back(takes ? size() : -1);
        if (!takes) continue;
        actuators_.push_back({size(), bar.response_time});
        commands_.push_back({wheels[bar.left] + ".anti_roll_bar.force", "1",
                             "share of the largest, that pushes this wheel down and the right one up", 0, -1, 1});
    }
}

int CommandLayout::actuator(int command) const {
    const auto found = std::ranges::find(actuators_, command, &Actuator::command);
    return command < 0 || found == actuators_.end() ? -1 : static_cast<int>(found - actuators_.begin());
}

std::vector<double> CommandLayout::rest() const {
    std::vector<double> out;
    for (const Command& command : commands_) out.push_back(command.rest);
    return out;
}

int CommandLayout::find(std::string_view name) const {
    const auto found = std::ranges::find(commands_, name, &Command::name);
    return found == commands_.end() ? -1 : static_cast<int>(found - commands_.begin());
}

}  // namespace hamilcar
