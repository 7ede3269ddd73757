// The one map of commands: what actuators are told beside the driver's inputs, held between two decisions. A vehicle takes its
// indices from here, and everything that speaks of a command takes its name. Without controllers there are none: then all actuators
// are at rest, and cost nothing.
//
//   wheel   of each with a modulated brake: inlet, outlet, pump
//   unit    of each power unit: the most and the least that its throttle may be
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/driveline/commands.hpp"

namespace hamilcar {

inline constexpr int max_commands = 256;

struct Command {
    std::string name;  // "front_left.brake.inlet"
    const char* unit;
    const char* meaning;
    double rest, min, max;  // rest: as without a controller
};

class CommandLayout {
public:
    explicit CommandLayout(const VehicleDescription& vehicle);

    int size() const { return static_cast<int>(commands_.size()); }
    const std::vector<Command>& commands() const { return commands_; }
    // Index of the first command of a wheel's brake or of a power unit; -1: it takes none.
    int brake(std::size_t wheel) const { return brakes_[wheel]; }
    int unit(std::size_t unit) const { return units_[unit]; }
    std::vector<double> rest() const;
    // Index of the command of a name; -1: there is none.
    int find(std::string_view name) const;

private:
    std::vector<Command> commands_;
    std::vector<int> brakes_, units_;
};

}  // namespace hamilcar
