#include "hamilcar/driver/steering_actuator.hpp"

#include <algorithm>

namespace hamilcar {

// a = w^2 (wanted - angle) - 2 w rate with angle and rate taken at the end of the interval (implicit), which is stable for an
// interval of any length. The rate at its end is at most w (lock - angle), so that the wheel stops before the lock.
double SteeringActuator::acceleration(double angle, double rate, double wanted, double interval) const {
    const double w = natural_frequency, h = interval;
    const double free = (w * w * (wanted - angle - h * rate) - 2 * w * rate) / ((1 + w * h) * (1 + w * h));
    const double half_way = angle + 0.5 * h * rate, braking = w / (1 + 0.5 * w * h);
    const double lowest = std::max(-max_rate, -braking * (lock + half_way));
    const double highest = std::min(max_rate, braking * (lock - half_way));
    const double next = std::max(std::min(rate + h * free, highest), std::min(lowest, highest));
    return std::clamp((next - rate) / h, -max_acceleration, max_acceleration);
}

}  // namespace hamilcar
