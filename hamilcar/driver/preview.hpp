// Steering by optimal preview, after MacAdam (1981, "Application of an optimal preview control for simulation of closed-loop
// automobile driving", IEEE Trans. SMC 11): the constant steering wheel angle that minimizes the mean squared
// distance from the path over the preview time.
//
// The driver's internal model is a single-track model with axles of typical cornering stiffness C = c N and a yaw inertia m a b,
// with a and b the distances of the center of mass from the axles. This decouples the axles' lateral velocities, and mass
// cancels:
//     v_f' = c_f g (delta - v_f / U) - U r,   v_r' = -c_r g v_r / U - U r,   r = (v_f - v_r) / L
// Along the path, heading against it psi and distance e to its left, kappa(t) its curvature where the car will be:
//     psi' = r - U kappa,   e' = U psi + (b v_f + a v_r) / L
// The steering actuator's lag precedes delta. Everything is linear: e(t) = free(t) + angle effect(t), so that
//     angle = -sum(free effect) / sum(effect^2).
#pragma once

#include <array>

#include "hamilcar/driver/observation.hpp"

namespace hamilcar {

// State of car and steering wheel relative to the path.
struct LateralState {
    double angle = 0, rate = 0;  // of the steering wheel [rad], [rad/s]
    double front = 0, rear = 0;  // velocity of the axles to the left [m/s]
    double heading = 0;          // relative to the path, as a sine [1]
    double offset = 0;           // of the center of mass to the left [m]
};

class Preview {
public:
    static constexpr std::size_t steps = 20;

    Preview() = default;
    // `time`: preview time [s].
    Preview(const DrivenCar& car, double time);

    // Preview time at a speed, at least one wheelbase ahead [s].
    double horizon(double speed) const;
    // Target angle of the steering wheel [rad]; `curvature`: of the path at the middle of each step of the horizon [1/m].
    double wanted_angle(const LateralState& now, double speed, const std::array<double, steps>& curvature) const;
    // Offset at which the demanded lateral acceleration and approach angle reach their bounds [m].
    double max_offset(double speed) const;
    double center_behind() const { return front_; }  // the front axle [m]
    double center_before() const { return rear_; }   // the rear axle [m]

private:
    struct Step;
    double time_ = 0.5, wheelbase_ = 1, front_ = 0.5, rear_ = 0.5, wheels_per_angle_ = 0;
};

}  // namespace hamilcar
