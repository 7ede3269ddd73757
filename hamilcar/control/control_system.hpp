// The controllers of one car with their sensors: what they are shown, when each decides, and what they remember.
//
//     right-hand side ─► measured, at the beginning of a step ─► Sensors ─► Measured ─► Controller ─► commands, one step later
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "hamilcar/block/measurement.hpp"
#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/sensors.hpp"

namespace hamilcar {

// Numbers that one car's sensors and controllers may remember.
inline constexpr std::size_t max_control_memory = 2048;

// What the driver does, as controllers see it.
struct DriverActions {
    double steering_wheel = 0;       // [rad]
    double brake = 0, throttle = 0;  // 0 to 1
    double gear = 0;
};

class ControlSystem {
public:
    // `step` in seconds. Throws std::invalid_argument, in words for a person, for a rate whose period is no multiple of the step, and
    // for more than can be remembered.
    ControlSystem(const VehicleDescription& vehicle, const ControlledCar& car, double step);

    const CommandLayout& layout() const { return layout_; }
    std::size_t memory_size() const { return memory_size_; }
    std::size_t controller_count() const { return controllers_.size(); }
    const std::string& keyword(std::size_t controller) const { return controllers_[controller].keyword; }

    // The memory, `memory_size` numbers that begin as zeros, is all that decisions depend on besides the commands. Its first numbers are
    // what is measured, as many as MeasurementPlaces says: to be written before the first step, and with each step.

    // Whether anything is to be done at a step, and how many steps later is the next.
    bool is_due(long step) const { return step % look_every_ == 0; }
    long steps_to_next(long step) const { return look_every_ - step % look_every_; }
    // Looks, and lets those decide whose time it is. Without allocation.
    void act(long step, const DriverActions& driver, std::span<double> memory, std::span<double> commands) const;

    // Switches a controller off or on again while the car runs: one that is off is not asked, and what it asked for is at rest.
    void switch_on(std::size_t controller, bool on, std::span<double> memory, std::span<double> commands) const;
    bool is_on(std::size_t controller, std::span<const double> memory) const;
    // Of a controller, 0 to 1.
    double activity(std::size_t controller, std::span<const double> memory) const;

private:
    struct Entry {
        std::string keyword;
        std::unique_ptr<const Controller> controller;
        long period;         // [steps]
        std::size_t memory;  // where its numbers begin, that of being off first
    };
    void add_controller(const ControllerDescription& description, const ControlledCar& car);
    std::vector<Sensors::Group> sensor_groups(const SensorsDescription& sensors) const;
    Measured shown(long step, const Entry& entry, const DriverActions& driver, const double* numbers) const;

    double step_;
    CommandLayout layout_;
    MeasurementPlaces places_;
    Sensors sensors_;
    // In the memory: measured, the steering wheel behind it; shown, likewise; what sensors remember; then of each controller whether it
    // is off, and its own numbers.
    std::size_t memory_size_;
    std::vector<Entry> controllers_;
    long look_every_ = 1;  // [steps]
};

}  // namespace hamilcar
