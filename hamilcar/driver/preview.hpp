// Steering by optimal preview, after MacAdam (1981, "Application of an optimal preview control for simulation of closed-loop
// automobile driving", IEEE Trans. SMC 11): the one steering wheel angle, held from now on, that leaves the least mean
// squared distance from the path over the time that the driver looks ahead.
//
// The driver's idea of the car is a single-track model with axles of typical cornering stiffness C = c N and a yaw inertia
// m a b, a and b the center's distances from the axles. With these the axles' lateral velocities part, and mass drops out:
//     v_f' = c_f g (delta - v_f / U) - U r,   v_r' = -c_r g v_r / U - U r,   r = (v_f - v_r) / L
// Along the path, heading against it psi and distance e to its left, kappa(t) its curvature where the car will be:
//     psi' = r - U kappa,   e' = U psi + (b v_f + a v_r) / L
// The arms' lag stands before delta. All is linear: e(t) = free(t) + angle effect(t), so that
//     angle = -sum(free effect) / sum(effect^2).
#pragma once

#include <array>

#include "hamilcar/driver/senses.hpp"

namespace hamilcar {

// Car and steering wheel beside the path.
struct LateralState {
    double angle = 0, rate = 0;  // of the steering wheel [rad], [rad/s]
    double front = 0, rear = 0;  // velocity of the axles to the left [m/s]
    double heading = 0;          // against the path, as a sine [1]
    double offset = 0;           // of the center of mass to the left [m]
};

class Preview {
public:
    static constexpr std::size_t steps = 20;

    Preview() = default;
    // `time`: how far ahead the driver looks [s].
    Preview(const DrivenCar& car, double time);

    // At a speed the driver looks as far as this [s]; when slow at least the wheelbase ahead.
    double horizon(double speed) const;
    // What to turn the steering wheel to [rad]; `curvature` of the path at the middle of each step of the horizon [1/m].
    double wanted_angle(const LateralState& now, double speed, const std::array<double, steps>& curvature) const;
    // How far off the path asks for no more than a bounded lateral acceleration and approach [m].
    double largest_offset(double speed) const;
    double center_behind() const { return front_; }  // the front axle [m]
    double center_before() const { return rear_; }   // the rear axle [m]

private:
    struct Step;
    double time_ = 0.5, wheelbase_ = 1, front_ = 0.5, rear_ = 0.5, wheels_per_angle_ = 0;
};

}  // namespace hamilcar
