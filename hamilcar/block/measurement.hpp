// What sensors of a car read at an instant, from what its right-hand side has computed anyway: reported with the rates, where the
// car has controllers.
#pragma once

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// Places of what is measured: of the car, then of each wheel, of each power unit.
struct MeasurementPlaces {
    enum : int {
        angular_rate,          // of the chassis, its axes, three numbers [rad/s]
        acceleration = 3,      // three numbers, see measure() [m/s^2]
        control_pressure = 6,  // of the motor vehicle's brakes [Pa]
        wheel_speed = 7        // of each against its carrier [rad/s]
    };
    int brake_pressure;  // at each wheel; 0 without a brake system [Pa]
    int travel;          // of each wheel's center against design, up positive [m]
    int travel_speed;    // likewise against the chassis of its unit [m/s]
    int rotor_speed;     // of each power unit [rad/s]
    int size;

    MeasurementPlaces(int wheels, int units)
        : brake_pressure(wheel_speed + wheels),
          travel(brake_pressure + wheels),
          travel_speed(travel + wheels),
          rotor_speed(travel_speed + wheels),
          size(rotor_speed + units) {}
    template <class T>
    explicit MeasurementPlaces(const Vehicle<T>& vehicle)
        : MeasurementPlaces(wheels_of(vehicle), static_cast<int>(vehicle.powertrain.units.size())) {}

private:
    template <class T>
    static int wheels_of(const Vehicle<T>& vehicle) {
        int wheels = 0;
        for (const Suspension<T>& suspension : vehicle.suspensions) {
            wheels += static_cast<int>(suspension.wheels.size());
        }
        return wheels;
    }
};
inline constexpr std::size_t max_measurements =
    std::size_t{MeasurementPlaces::wheel_speed} + 4 * max_vehicle_wheels + std::size_t{max_power_units};

// `to`: as many numbers as MeasurementPlaces says. The accelerometer stands at the center of mass of all that moves and shows the
// forces of ground and air over its mass, (F - m g) / m, in the chassis's axes: at rest on level ground g upward.
template <class T, class S>
void measure(const Vehicle<T>& vehicle, const State<T>& state, const Velocity<T, S>& velocity,
             const Momenta<T>& momenta, T* to) {
    const MeasurementPlaces places(vehicle);
    const Vec3<T> turning = angular(velocity.chassis);
    const Vec3<T> felt =
        linear(momenta.external) * (T(1) / vehicle.total_mass) + velocity.R_GC.row(2).transpose() * vehicle.gravity;
    for (int i = 0; i < 3; ++i) {
        to[MeasurementPlaces::angular_rate + i] = turning[i];
        to[MeasurementPlaces::acceleration + i] = felt[i];
    }
    const T* values = state.values.data();
    const BrakeSystem<T>& brakes = vehicle.brakes;
    to[MeasurementPlaces::control_pressure] = brakes.exists() ? T(brakes.control(0, values)) : T(0);
    for (const Suspension<T>& suspension : vehicle.suspensions) {
        const auto s = static_cast<std::size_t>(&suspension - vehicle.suspensions.data());
        const SuspensionVelocity<T>& at = velocity.suspensions[s];
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            const int number = suspension.first_wheel + static_cast<int>(w);
            to[MeasurementPlaces::wheel_speed + number] = momenta.suspensions[s].wheels[w].spin;
            const Spatial<T> relative = at.motion[suspension.wheels[w].frame] - unit_motion(suspension.unit, velocity);
            to[places.travel + number] = at.center[w][2] - suspension.wheels[w].wheel.center[2];
            to[places.travel_speed + number] = velocity_at<T>(relative, at.center[w])[2];
        }
    }
    for (int i = places.brake_pressure; i < places.travel; ++i) to[i] = T(0);
    for (std::size_t i = 0; i < brakes.lines.size(); ++i) {
        to[places.brake_pressure + brakes.lines[i].wheel] = brakes.pressure(i, values);
    }
    for (std::size_t i = 0; i < vehicle.powertrain.units.size(); ++i) {
        to[places.rotor_speed + static_cast<int>(i)] = momenta.powertrain.units[i].spin;
    }
}

}  // namespace hamilcar
