#include "hamilcar/driver/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hamilcar {

namespace {

// Fritsch-Carlson slopes: zero at local extremes, else the weighted harmonic mean of the neighboring secants.
std::vector<double> monotone_slopes(const std::vector<double>& t, const std::vector<double>& y) {
    const std::size_t n = t.size();
    std::vector<double> slope(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
        const double d0 = (y[i] - y[i - 1]) / h0, d1 = (y[i + 1] - y[i]) / h1;
        if (d0 * d1 > 0) {
            const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
            slope[i] = (w0 + w1) / (w0 / d0 + w1 / d1);
        }
    }
    return slope;  // zero at both ends: the input is constant outside the table
}

}  // namespace

Signal::Signal(const SignalDescription& d, double scale)
    : time_(d.time), value_(d.value), smooth_(d.interpolation == Interpolation::smooth) {
    for (double& value : value_) value *= scale;
    if (smooth_) slope_ = monotone_slopes(time_, value_);
}

Signal::Value Signal::at(double time) const {
    if (time_.empty()) return {};
    if (time < time_.front()) return {value_.front(), 0, 0};
    if (time >= time_.back()) return {value_.back(), 0, 0};
    const auto next = std::upper_bound(time_.begin(), time_.end(), time);
    const std::size_t i = static_cast<std::size_t>(next - time_.begin()) - 1;
    const double h = time_[i + 1] - time_[i], s = (time - time_[i]) / h, rise = value_[i + 1] - value_[i];
    if (!smooth_) return {value_[i] + s * rise, rise / h, 0};
    const double a = slope_[i] * h, b = slope_[i + 1] * h;  // Hermite: y = y0 + s (a + s (c2 + s c3))
    const double c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
    return {value_[i] + s * (a + s * (c2 + s * c3)), (a + s * (2 * c2 + s * 3 * c3)) / h,
            (2 * c2 + 6 * s * c3) / (h * h)};
}

Schedule::Schedule(const ScenarioDescription& scenario, const SteeringDescription& steering)
    : drive_(scenario.drive), brake_(scenario.brake) {
    if (scenario.steering_input == SteeringInput::none) return;
    const bool wheel = scenario.steering_input == SteeringInput::steering_wheel;
    rack_ = Signal(scenario.steering, wheel ? steering.rack_per_revolution / (2 * std::numbers::pi) : 1.0);
}

Input<double> Schedule::operator()(double time) const {
    const Signal::Value rack = rack_.at(time);
    return {.rack = {rack.value, rack.rate, rack.acceleration},
            .drive_torque = drive_.at(time).value,
            .brake = brake_.at(time).value};
}

}  // namespace hamilcar
