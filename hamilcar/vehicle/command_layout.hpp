// The one map of commands: what actuators are told beside the driver's inputs, held between two decisions. A vehicle takes its
// indices from here, and everything that speaks of a command takes its name. Without controllers there are none: then all actuators
// are at rest, and cost nothing.
//
//   wheel   of each with a modulated brake: inlet, outlet, pump
//   unit    of each power unit: the most and the least that its throttle may be; of a motor besides: torque that is added, and the most
//           of its regeneration
//   damper  of each that is adjustable: its setting
//   bar     of each active anti-roll bar: the share of its force
//   steer   of each axle with an actuator for its rack: the share of its travel
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
    // How many power units take together.
    int of_all_units() const { return of_all_units_; }
    std::vector<double> rest() const;
    // Of a wheel's first adjustable damper, of a suspension's dampers one by one, of a bar; -1: it takes none.
    int damper(std::size_t wheel) const { return wheel_dampers_[wheel]; }
    int damper(std::size_t suspension, std::size_t number) const { return dampers_[suspension][number]; }
    int bar(std::size_t number) const { return bars_[number]; }
    // Of an axle's own rack; -1: it takes none.
    int axle_steer(std::size_t number) const { return axle_steers_[number]; }
    // Those that follow their commands with a lag, in the order of their numbers in a state.
    struct Actuator {
        int command;
        double response_time;  // [s]
    };
    const std::vector<Actuator>& actuators() const { return actuators_; }
    // Of the actuator that follows a command; -1: there is none.
    int actuator(int command) const;
    // Index of the command of a name; -1: there is none.
    int find(std::string_view name) const;

private:
    std::vector<Command> commands_;
    int of_all_units_ = 0;
    void add_units(const VehicleDescription& vehicle);
    void add_dampers(const VehicleDescription& vehicle);
    void add_bars(const VehicleDescription& vehicle);

    std::vector<int> brakes_, units_, wheel_dampers_, bars_, axle_steers_;
    std::vector<std::vector<int>> dampers_;  // of the suspensions
    std::vector<Actuator> actuators_;
};

}  // namespace hamilcar
