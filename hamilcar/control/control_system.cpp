#include "hamilcar/control/control_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace hamilcar {

namespace {

constexpr double period_tolerance = 1e-6;  // of a period that is a multiple of the step [1]

// Steps between two decisions.
long period_of(double rate, double step, const std::string& what) {
    const double steps = 1 / (rate * step), whole = std::round(steps);
    if (whole >= 1 && std::abs(steps - whole) <= period_tolerance * whole) return static_cast<long>(whole);
    const double slower = 1 / (std::ceil(steps) * step), faster = 1 / (std::max(1.0, std::floor(steps)) * step);
    const std::string nearest =
        slower == faster ? fmt::format("{:g}", slower) : fmt::format("{:g} or {:g}", slower, faster);
    throw std::invalid_argument(
        fmt::format("{} = {:g}: expected a rate whose period is a multiple of the step of {:g} s, as {} [Hz]", what,
                    rate, step, nearest));
}

// A speed of travel is as late as the travel; its noise and its resolution would be those of a difference over an interval.
SensorDescription of_speed(SensorDescription travel, double step) {
    const double interval = travel.interval > 0 ? travel.interval : step;
    travel.noise *= std::numbers::sqrt2 / interval, travel.resolution /= interval;
    return travel;
}

}  // namespace

ControlSystem::ControlSystem(const VehicleDescription& vehicle, const ControlledCar& car, double step)
    : step_(step),
      layout_(vehicle),
      places_(static_cast<int>(wheel_count(vehicle)), static_cast<int>(vehicle.power_units.size())),
      sensors_(sensor_groups(vehicle.sensors), vehicle.sensors.seed, step),
      memory_size_(2 * sensors_.size() + sensors_.memory_size()) {
    const SensorsDescription& s = vehicle.sensors;
    const std::pair<const SensorDescription*, const char*> sorts[] = {
        {&s.wheel_speed, "wheel_speed"}, {&s.angular_rate, "angular_rate"},     {&s.acceleration, "acceleration"},
        {&s.pressure, "pressure"},       {&s.steering_wheel, "steering_wheel"}, {&s.travel, "travel"}};
    for (const auto& [sensor, name] : sorts) {
        if (sensor->interval > 0) period_of(1 / sensor->interval, step, fmt::format("sensors.{}.rate_hz", name));
    }
    for (const ControllerDescription& one : vehicle.controllers) add_controller(one, car);
    if (!sensors_.looks_always()) {
        look_every_ = 0;
        for (const Entry& entry : controllers_) look_every_ = std::gcd(look_every_, entry.period);
        look_every_ = std::max(look_every_, 1L);
    }
    if (memory_size_ > max_control_memory) {
        throw std::invalid_argument(fmt::format("sensors and controllers remember {} numbers: expected {} at most",
                                                memory_size_, max_control_memory));
    }
    if (layout_.size() > max_commands) {
        throw std::invalid_argument(
            fmt::format("actuators take {} commands: expected {} at most", layout_.size(), max_commands));
    }
}

void ControlSystem::add_controller(const ControllerDescription& description, const ControlledCar& car) {
    const ControllerKind* kind = find_controller_kind(description.kind);
    if (!kind) throw std::invalid_argument("there is no kind of controller with the keyword " + description.kind);
    const long period = period_of(description.rate, step_, fmt::format("controller[{}].rate_hz", description.number));
    controllers_.push_back(
        {description.kind, kind->make(ControllerSettings(*kind, description), car), period, memory_size_});
    memory_size_ += 1 + controllers_.back().controller->memory_size();
}

// The steering wheel is behind what is measured.
std::vector<Sensors::Group> ControlSystem::sensor_groups(const SensorsDescription& sensors) const {
    using At = MeasurementPlaces;
    const auto group = [](const SensorDescription& sensor, int first, int end) {
        return Sensors::Group{sensor, static_cast<std::size_t>(first), static_cast<std::size_t>(end - first)};
    };
    return {group(sensors.angular_rate, At::angular_rate, At::acceleration),
            group(sensors.acceleration, At::acceleration, At::control_pressure),
            group(sensors.pressure, At::control_pressure, At::wheel_speed),
            group(sensors.wheel_speed, At::wheel_speed, places_.brake_pressure),
            group(sensors.pressure, places_.brake_pressure, places_.travel),
            group(sensors.travel, places_.travel, places_.travel_speed),
            group(of_speed(sensors.travel, step_), places_.travel_speed, places_.rotor_speed),
            group(sensors.wheel_speed, places_.rotor_speed, places_.size),
            group(sensors.steering_wheel, places_.size, places_.size + 1)};
}

Measured ControlSystem::shown(long step, const Entry& entry, const DriverActions& driver, const double* numbers) const {
    using At = MeasurementPlaces;
    const double* at = numbers + sensors_.size();
    const auto between = [at](int first, int end) { return std::span<const double>(at + first, at + end); };
    Measured out;
    out.time = static_cast<double>(step) * step_, out.interval = static_cast<double>(entry.period) * step_;
    out.steering_wheel = at[places_.size];
    out.brake = driver.brake, out.throttle = driver.throttle, out.gear = driver.gear;
    std::copy_n(at + At::angular_rate, 3, out.angular_rate.begin());
    std::copy_n(at + At::acceleration, 3, out.acceleration.begin());
    out.control_pressure = at[At::control_pressure];
    out.wheel_speed = between(At::wheel_speed, places_.brake_pressure);
    out.brake_pressure = between(places_.brake_pressure, places_.travel);
    out.travel = between(places_.travel, places_.travel_speed);
    out.travel_speed = between(places_.travel_speed, places_.rotor_speed);
    out.rotor_speed = between(places_.rotor_speed, places_.size);
    return out;
}

void ControlSystem::act(long step, const DriverActions& driver, std::span<double> memory,
                        std::span<double> commands) const {
    double* numbers = memory.data();
    const std::size_t size = sensors_.size();
    numbers[size - 1] = driver.steering_wheel;
    sensors_.look(step, {numbers, size}, {numbers + 2 * size, sensors_.memory_size()}, {numbers + size, size});
    for (const Entry& entry : controllers_) {
        if (step % entry.period != 0 || numbers[entry.memory] != 0) continue;
        entry.controller->decide(shown(step, entry, driver, numbers),
                                 {numbers + entry.memory + 1, entry.controller->memory_size()},
                                 Commands(layout_, commands));
    }
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const Command& limits = layout_.commands()[i];
        commands[i] = std::clamp(commands[i], limits.min, limits.max);
    }
}

// The others ask again for what they need at their next decisions.
void ControlSystem::switch_on(std::size_t controller, bool on, std::span<double> memory,
                              std::span<double> commands) const {
    const Entry& entry = controllers_[controller];
    if (is_on(controller, memory) == on) return;
    std::ranges::fill(memory.subspan(entry.memory, 1 + entry.controller->memory_size()), 0.0);
    memory[entry.memory] = on ? 0 : 1;
    for (std::size_t i = 0; i < commands.size(); ++i) commands[i] = layout_.commands()[i].rest;
}

bool ControlSystem::is_on(std::size_t controller, std::span<const double> memory) const {
    return memory[controllers_[controller].memory] == 0;
}

double ControlSystem::activity(std::size_t controller, std::span<const double> memory) const {
    const Entry& entry = controllers_[controller];
    if (memory[entry.memory] != 0) return 0;
    return entry.controller->activity(memory.subspan(entry.memory + 1, entry.controller->memory_size()));
}

}  // namespace hamilcar
