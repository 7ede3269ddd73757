#include "hamilcar/steering/column.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hamilcar {

namespace {

// Weighted harmonic means of the neighboring secants, the secants themselves at both ends.
std::vector<double> slopes_of(const std::vector<double>& x, const std::vector<double>& y) {
    const std::size_t n = x.size();
    const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
    std::vector<double> slope{secant(0)};
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
        const double w0 = 2 * after + before, w1 = after + 2 * before;
        slope.push_back((w0 + w1) / (w0 / secant(i - 1) + w1 / secant(i)));
    }
    slope.push_back(secant(n - 2));
    return slope;
}

}  // namespace

Column::Column(const SteeringDescription& steering)
    : center_ratio_(steering.rack_per_revolution / (2 * std::numbers::pi)) {
    const std::size_t n = steering.angle.size();
    if (n < 2) return;
    for (std::size_t i = n; i-- > 1;) angle_.push_back(-steering.angle[i]), rack_.push_back(-steering.rack[i]);
    for (std::size_t i = 0; i < n; ++i) angle_.push_back(steering.angle[i]), rack_.push_back(steering.rack[i]);
    slope_ = slopes_of(angle_, rack_);
    center_ratio_ = slope_[n - 1];
}

Column::Rack Column::rack(double angle) const {
    if (angle_.empty()) return {center_ratio_ * angle, center_ratio_, 0};
    if (angle <= angle_.front()) return {rack_.front() + slope_.front() * (angle - angle_.front()), slope_.front(), 0};
    if (angle >= angle_.back()) return {rack_.back() + slope_.back() * (angle - angle_.back()), slope_.back(), 0};
    const auto above = std::upper_bound(angle_.begin(), angle_.end(), angle);
    const auto i = static_cast<std::size_t>(above - angle_.begin()) - 1;
    const double h = angle_[i + 1] - angle_[i], s = (angle - angle_[i]) / h, rise = rack_[i + 1] - rack_[i];
    const double a = slope_[i] * h, end = slope_[i + 1] * h;  // Hermite: y0 + s (a + s (b + s c))
    const double b = 3 * rise - 2 * a - end, c = a + end - 2 * rise;
    return {rack_[i] + s * (a + s * (b + s * c)), (a + s * (2 * b + s * 3 * c)) / h, (2 * b + 6 * s * c) / (h * h)};
}

double Column::angle(double displacement) const {
    if (angle_.empty()) return displacement / center_ratio_;
    if (displacement <= rack_.front()) return angle_.front() + (displacement - rack_.front()) / slope_.front();
    if (displacement >= rack_.back()) return angle_.back() + (displacement - rack_.back()) / slope_.back();
    double low = angle_.front(), high = angle_.back();
    constexpr int halvings = 60;  // to the last bit
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (rack(middle).displacement < displacement ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

SignalValue<double> Column::rack_motion(const SignalValue<double>& angle) const {
    const Rack at = rack(angle.value);
    return {at.displacement, at.slope * angle.rate,
            at.slope * angle.acceleration + at.curvature * angle.rate * angle.rate};
}

}  // namespace hamilcar
