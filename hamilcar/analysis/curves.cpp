#include "hamilcar/analysis/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/math/dense.hpp"

namespace hamilcar {

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::array<double, 2> fit_from_zero(std::span<const double> base, std::span<const double> x, std::span<const double> y,
                                    double limit) {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (std::abs(x[i]) <= limit && std::isfinite(y[i])) used.push_back(i);
    }
    constexpr Eigen::Index many = 20;
    const auto rows = static_cast<Eigen::Index>(used.size()), terms = rows >= many ? Eigen::Index{5} : Eigen::Index{4};
    if (rows <= terms) return {not_there, not_there};
    Eigen::MatrixXd regressors(rows, terms);
    Eigen::VectorXd right(rows);
    for (Eigen::Index row = 0; row < rows; ++row) {
        const std::size_t i = used[static_cast<std::size_t>(row)];
        regressors(row, 0) = base[i];
        for (Eigen::Index k = 1; k < terms; ++k) {
            regressors(row, k) = (k == 1 ? 1 : regressors(row, k - 1)) * x[i] / limit;  // of order one
        }
        right[row] = y[i];
    }
    const Eigen::VectorXd fit = least_squares(regressors, right);
    return {fit[0], fit[1] / limit};
}

std::vector<double> local_slopes(std::span<const double> x, std::span<const double> y, double half_width) {
    std::vector<double> out;
    for (const double at : x) {
        std::vector<double> near_x, near_y;
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (std::abs(x[i] - at) <= half_width) near_x.push_back(x[i]), near_y.push_back(y[i]);
        }
        constexpr std::size_t min_points = 3;
        const bool alike = near_x.empty() || std::ranges::max(near_x) - std::ranges::min(near_x) < 0.5 * half_width;
        out.push_back(near_x.size() < min_points || alike ? not_there : fitted_line(near_x, near_y).slope);
    }
    return out;
}

double slope_at(std::span<const double> x, std::span<const double> y, double at, double reach) {
    constexpr Eigen::Index min_points = 4, terms = 3;
    constexpr double aside = 0.2;  // of the reach
    std::vector<std::size_t> used;
    bool below = false, above = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (std::abs(x[i] - at) > reach * (1 + 1e-9) || !std::isfinite(y[i])) continue;
        used.push_back(i);
        below = below || x[i] <= at - aside * reach, above = above || x[i] >= at + aside * reach;
    }
    const auto rows = static_cast<Eigen::Index>(used.size());
    if (rows < min_points || !below || !above) return not_there;
    Eigen::MatrixXd powers(rows, terms);
    Eigen::VectorXd right(rows);
    for (Eigen::Index row = 0; row < rows; ++row) {
        const std::size_t i = used[static_cast<std::size_t>(row)];
        const double share = (x[i] - at) / reach;
        powers.row(row) << 1, share, share * share;
        right[row] = y[i];
    }
    return least_squares(powers, right)[1] / reach;
}

double value_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const bool inside = !x.empty() && at >= x.front() - 1e-9 && at <= x.back() + 1e-9;
    return inside ? interpolated(x, y, at) : not_there;
}

std::vector<double> phases(const std::vector<std::complex<double>>& response) {
    std::vector<double> out;
    for (const auto& one : response) {
        const double now = std::arg(one) / units::degree, before = out.empty() ? 0 : out.back();
        out.push_back(now - 360 * std::round((now - before) / 360));
    }
    return out;
}

double falls_through(const std::vector<double>& x, const std::vector<double>& y, double level) {
    for (std::size_t i = 1; i < x.size(); ++i) {
        if (y[i - 1] > level && y[i] <= level) return std::lerp(x[i - 1], x[i], (level - y[i - 1]) / (y[i] - y[i - 1]));
    }
    return not_there;
}

double Loop::at(double level, bool rising) const {
    double sum = 0, count = 0;
    for (std::size_t i = 1; i < x_.size(); ++i) {
        const double before = x_[i - 1] - level, now = x_[i] - level;
        if (!(rising ? before < 0 && now >= 0 : before > 0 && now <= 0)) continue;
        sum += y_[i - 1] + (y_[i] - y_[i - 1]) * before / (before - now), ++count;
    }
    return count > 0 ? sum / count : not_there;
}

double Loop::width(double level) const {
    return std::abs(at(level, true) - at(level, false));
}

double Loop::slope(double level, double reach) const {
    double sum = 0;
    for (const bool rising : {true, false}) {
        std::vector<double> x, y;
        for (std::size_t i = 1; i < x_.size(); ++i) {
            if (std::abs(x_[i] - level) > reach || (x_[i] > x_[i - 1]) != rising) continue;
            x.push_back(x_[i]), y.push_back(y_[i]);
        }
        if (x.size() < 3) return not_there;
        sum += fitted_line(x, y).slope;
    }
    return sum / 2;
}

}  // namespace hamilcar
