// What evaluations read off one quantity over another: beginnings, slopes, levels, loops. NaN where points are too few.
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

namespace hamilcar {

// f and s of y = f base + s x + q x^2 + k x^3 by least squares, for x up to `limit`; with x^4 where points are many. Curves are
// not odd: drag and drive grow with x, and there are vehicles with a kink at zero.
std::array<double, 2> fit_from_zero(std::span<const double> base, std::span<const double> x, std::span<const double> y,
                                    double limit);

// Slopes of lines through every point and its neighbors within `half_width` of x.
std::vector<double> local_slopes(std::span<const double> x, std::span<const double> y, double half_width);

// The slope there of a parabola by least squares through the points within `reach` of x; NaN unless there are four of
// them, on both sides by a fifth of it.
double slope_at(std::span<const double> x, std::span<const double> y, double at, double reach);

// A value at a place between ascending x, linear between neighbors; NaN outside.
double value_at(const std::vector<double>& x, const std::vector<double>& y, double at);
// Where a curve first falls through a level, linear between points; NaN where it does not.
double falls_through(const std::vector<double>& x, const std::vector<double>& y, double level);

// Phases without jumps of a turn, from the first one on, which lies within half a turn of zero [deg].
std::vector<double> phases(const std::vector<std::complex<double>>& response);

// One output over another, again and again; a view. It is read on two branches, on which the abscissa rises and falls.
class Loop {
public:
    Loop(std::span<const double> x, std::span<const double> y) : x_(x), y_(y) {}

    // y where x comes to a level, on the branch where x rises or on the other; mean of all passes.
    double at(double level, bool rising) const;
    double width(double level) const;  // between the branches
    // dy/dx about a level, by lines through what is within `reach` of it; mean of both branches.
    double slope(double level, double reach) const;
    // The mean of both sides, off center.
    double slope_aside(double level, double reach) const { return (slope(level, reach) + slope(-level, reach)) / 2; }

    std::span<const double> x() const { return x_; }
    std::span<const double> y() const { return y_; }

private:
    std::span<const double> x_, y_;
};

}  // namespace hamilcar
