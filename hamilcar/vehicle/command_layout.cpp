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
    for (const PowerUnitDescription& unit : vehicle.power_units) {
        units_.push_back(controlled ? size() : -1);
        if (!controlled) continue;
        commands_.push_back({unit.name + ".max_throttle", "1", "the most that the throttle opens", 1, 0, 1});
        commands_.push_back({unit.name + ".min_throttle", "1", "the least that it opens", 0, 0, 1});
    }
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
