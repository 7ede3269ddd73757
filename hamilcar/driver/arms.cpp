#include "hamilcar/driver/arms.hpp"

#include <algorithm>

namespace hamilcar {

// The spring's a = w^2 (wanted - angle) - 2 w rate with both as they will be at the end, which is stable for an interval of
// any length. At its end the rate is at most w (lock - angle), so that the wheel stops before the lock.
double Arms::acceleration(double angle, double rate, double wanted, double interval) const {
    const double w = quickness, h = interval;
    const double free = (w * w * (wanted - angle - h * rate) - 2 * w * rate) / ((1 + w * h) * (1 + w * h));
    const double half_way = angle + 0.5 * h * rate, braking = w / (1 + 0.5 * w * h);
    const double least = std::max(-largest_rate, -braking * (lock + half_way));
    const double most = std::min(largest_rate, braking * (lock - half_way));
    const double next = std::max(std::min(rate + h * free, most), std::min(least, most));
    return std::clamp((next - rate) / h, -hardest, hardest);
}

}  // namespace hamilcar
