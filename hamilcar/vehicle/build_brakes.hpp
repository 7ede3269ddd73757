// The brake system from its description.
#pragma once

#include <algorithm>
#include <cmath>

#include "hamilcar/driveline/brake_system.hpp"
#include "hamilcar/vehicle/command_layout.hpp"

namespace hamilcar {

namespace detail {

// The circuit of a wheel, 1 or 2: of its axle, or of its diagonal. Trailers hang on the first.
inline int brake_circuit(const BrakeSystemDescription& system, const Point& center, double middle) {
    const bool front = center[0] > middle, left = center[1] > 0;
    if (system.circuits == BrakeCircuits::front_rear) return front ? 1 : 2;
    return front == left ? 1 : 2;
}

// Between the foremost and the rearmost wheel centers of the motor vehicle [m].
inline double middle_of_wheels(const VehicleDescription& d) {
    double front = -1e9, rear = 1e9;
    for_each_wheel(d, [&](const SuspensionWheelDescription& wheel, std::size_t unit) {
        if (unit != 0) return;
        front = std::max(front, wheel.wheel.center[0]), rear = std::min(rear, wheel.wheel.center[0]);
    });
    return (front + rear) / 2;
}

template <class T>
BrakeLine<T> make_brake_line(const BrakeSystemDescription& system, const SuspensionWheelDescription& wheel) {
    const BrakeDescription& d = wheel.brake;
    BrakeLine<T> out;
    if (system.medium == BrakeMedium::air) {
        out.fill = T(1 / d.fill_time), out.release = T(1 / d.release_time);
        out.softness = T(0);
        out.pump_rate = T(system.full_pressure / d.fill_time);
    } else {
        const double k = d.line_flow / d.volume * std::sqrt(brake_reference_pressure);
        out.fill = out.release = T(k);
        constexpr double least_softness = 1e4;  // [Pa]
        out.softness = T(std::max(least_softness, (k / fastest_pressure_rate) * (k / fastest_pressure_rate)));
        out.pump_rate = T(system.pump_flow / d.volume * brake_reference_pressure);
    }
    out.valve_pressure = T(d.valve_command * system.full_pressure), out.valve_reduction = T(1 - d.valve_slope);
    out.torque_per_pressure = T(d.max_torque / system.full_pressure);
    out.friction = d.friction.empty() ? Curve<T>({0}, {1}) : Curve<T>(d.temperature, d.friction);
    out.friction_loss = T(d.friction_loss_per_speed * d.friction_radius);
    out.self_energizing = T(d.self_energizing);
    out.inverse_capacity = T(d.heat.capacity > 0 ? 1 / d.heat.capacity : 0);
    out.cooling = T(d.heat.cooling);
    out.cooling_per_spin = T(d.heat.cooling_per_speed * casing_of(wheel.tire).rolling_radius);
    return out;
}

}  // namespace detail

template <class T>
BrakeSystem<T> make_brakes(const VehicleDescription& d, const CommandLayout& commands) {
    const BrakeSystemDescription& system = d.brakes;
    BrakeSystem<T> out;
    out.is_air = system.medium == BrakeMedium::air ? 1 : 0;
    out.response_rate.push_back(T(1 / system.response_time)), out.source.push_back(-1);
    for (const TrailerDescription& trailer : d.trailers) {
        out.response_rate.push_back(T(1 / system.trailer_response_time));
        out.source.push_back(static_cast<int>(trailer.tow));
    }
    const bool has_knee = system.knee_command < 1;
    out.pedal_pressure = has_knee
                             ? Curve<T>({0, system.knee_command, 1}, {0, system.knee_pressure, system.full_pressure})
                             : Curve<T>({0, 1}, {0, system.full_pressure});
    const double highest = out.is_air ? system.full_pressure : system.pump_pressure;
    out.inverse_pump_pressure = T(highest > 0 ? 1 / highest : 0);
    const double middle = detail::middle_of_wheels(d);
    int number = 0;
    for_each_wheel(d, [&](const SuspensionWheelDescription& wheel, std::size_t unit) {
        const int own = number++;
        if (wheel.brake.max_torque <= 0) return;
        BrakeLine<T> line = detail::make_brake_line<T>(system, wheel);
        line.wheel = own, line.unit = static_cast<int>(unit);
        line.command = commands.brake(static_cast<std::size_t>(own));
        const int circuit = unit == 0 ? detail::brake_circuit(system, wheel.wheel.center, middle) : 1;
        line.supplied = T(circuit == system.failed_circuit ? 0 : 1);
        out.lines.push_back(line);
    });
    return out;
}

}  // namespace hamilcar
