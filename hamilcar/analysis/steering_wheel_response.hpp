// How a motor vehicle answers its steering wheel by linear theory, straight ahead, frequency by frequency.
#pragma once

#include <complex>
#include <vector>

#include "hamilcar/analysis/linear_model.hpp"

namespace hamilcar {

// Of `output_yaw_rate` [1/s] or `output_lateral_acceleration` [m/s^2/deg] of the motor vehicle, without its trailers, per angle of
// the steering wheel at a speed [m/s], by the exact linearization; empty where there is no steady driving to start from.
std::vector<std::complex<double>> steering_wheel_response(const VehicleDescription& vehicle, double speed,
                                                          LinearOutput output, const std::vector<double>& frequency);

}  // namespace hamilcar
