// Inputs over time with their rates, smooth enough for the rack's velocity to be continuous: from a scenario's tables, or from a
// closed-loop driver, which overrides them interval by interval.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "hamilcar/block/model.hpp"
#include "hamilcar/description/scenario.hpp"
#include "hamilcar/math/signal.hpp"
#include "hamilcar/steering/column.hpp"
#include "hamilcar/vehicle/command_layout.hpp"

namespace hamilcar {

// The prescribed inputs, each with its own signal.
enum class Control {
    rack,
    drive_torque,
    brake,
    throttle,
    clutch,
    gear,
    wind_x,
    wind_y,
    hands_hold,
    hands_torque,
    parking_brake
};
inline constexpr std::size_t control_count = 11;

class Schedule {
public:
    // Steering wheel angles are converted to rack displacements by the vehicle's steering column.
    Schedule(const ScenarioDescription& scenario, const SteeringDescription& steering);

    // All inputs at a time [s]. Those that a run lacks are not looked up.
    Input<double> operator()(double time) const {
        const auto at = [&](Control control) { return signal(control).at(time); };
        const SignalValue<double> rack = at(Control::rack);
        Input<double> input{.rack = {rack.value, rack.rate, rack.acceleration},
                            .drive_torque = at(Control::drive_torque).value,
                            .brake = at(Control::brake).value,
                            .time = time};
        if (powered_) {
            input.throttle = at(Control::throttle).value;
            input.clutch = at(Control::clutch).value;
            input.gear = at(Control::gear).value;
        }
        if (free_rack_) {
            input.hands_hold = at(Control::hands_hold).value, input.hands_torque = at(Control::hands_torque).value;
        }
        if (windy_) input.wind_x = at(Control::wind_x).value, input.wind_y = at(Control::wind_y).value;
        if (parks_) input.parking_brake = at(Control::parking_brake).value;
        input.commands = commands_.empty() ? nullptr : commands_.data();
        return input;
    }

    // From `time` on a control follows value, rate and acceleration, until the next call. Without allocation; `step` is the time
    // scale of the polynomial [s].
    void follow(Control control, double time, const SignalValue<double>& now, double step) {
        signals_[static_cast<std::size_t>(control)].follow(time, now, step);
        parks_ = parks_ || control == Control::parking_brake;
    }
    // The same by a piece that begins then.
    void follow(Control control, double time, const SignalPiece<double>& piece) {
        signals_[static_cast<std::size_t>(control)].follow(time, piece);
        parks_ = parks_ || control == Control::parking_brake;
    }

    // What controllers tell actuators from now on (vehicle/command_layout.hpp); an input refers to them as they are then. Without
    // allocation but for the first time.
    void set_commands(std::span<const double> commands) { commands_.assign(commands.begin(), commands.end()); }
    std::span<const double> commands() const { return commands_; }

    // What later inputs depend on besides the scenario's tables: the controls that a driver has overridden, and the commands.
    struct Memory {
        std::array<bool, control_count> follows{};
        std::array<Signal::Span, control_count> spans;
        std::size_t command_count = 0;
        std::array<double, max_commands> commands;
    };
    void save(Memory& to) const;
    void restore(const Memory& from);

    const Signal& signal(Control control) const { return signals_[static_cast<std::size_t>(control)]; }
    // Whether throttle, clutch and gear are inputs, and whether there is wind.
    bool powered() const { return powered_; }
    bool windy() const { return windy_; }
    // Whether the rack moves on its own, and the hands do what they do to the steering wheel.
    bool has_free_rack() const { return free_rack_; }

private:
    std::array<Signal, control_count> signals_;
    bool powered_ = false, windy_ = false, free_rack_ = false, parks_ = false;
    std::vector<double> commands_;
};

}  // namespace hamilcar
