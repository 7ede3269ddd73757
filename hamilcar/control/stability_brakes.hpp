// How stability control brakes: from a turn that it wants to the pressure of each wheel, and to the valves that bring it there. A wheel
// of which it wants nothing is left to the driver and to controllers that decided before.
#pragma once

#include <span>

#include "hamilcar/control/reference_speed.hpp"

namespace hamilcar {

// What the car shall do.
struct StabilityRequest {
    double turn = 0;     // yaw acceleration by wheels in front, positive to the left [rad/s^2]
    double turn_in = 0;  // by those in the rear, likewise
    double slow = 0;     // share, 0 to 1, against rolling over
};

// What it does, for the slip of its wheels.
struct StabilityMotion {
    ReferenceSpeed reference;
    double sideslip = 0;  // of the motor vehicle's center of mass [rad]
};

class StabilityBrakes {
public:
    // Largest slip of a braked wheel that rolls straight.
    StabilityBrakes(const ControlledCar& car, double slip);

    static constexpr double full_turn = 4;  // wanted yaw acceleration that counts as a full intervention [rad/s^2]

    // Yaw moment of the brakes by the driver's pressure, positive to the left: on split friction [N m].
    double drivers_moment(const Measured& measured, std::span<const double> left) const;

    // `left`, a number for each wheel: 0, or how this controller left its valves: 2 + pump - outlet, the inlet closed. Valves that are
    // closed in another way are those of a controller that decided before.
    void act(const StabilityRequest& request, const StabilityMotion& motion, const Measured& measured,
             std::span<double> left, const Commands& commands) const;

private:
    double pressure(const ControlledWheel& wheel, double force) const;
    double target(const ControlledWheel& wheel, const StabilityRequest& request, double control_pressure) const;
    double slip_share(const StabilityMotion& motion, const Measured& measured, std::size_t wheel) const;
    void approach(double target, double slip_share, const Measured& measured, std::size_t wheel,
                  const BrakeValves& valves) const;

    ControlledCar car_;
    double slip_;
    double front_moments_ = 0, rear_moments_ = 0;  // of the loads of one side about the middle [N m]
};

}  // namespace hamilcar
