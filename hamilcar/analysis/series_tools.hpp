// What evaluations read off a series: values and instants between samples, peaks, straight lines, integrals. Between
// samples a series is a straight line, at a peak a parabola.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hamilcar {

// Samples at a constant rate; a view, so the values must outlive it.
struct Series {
    std::span<const double> values;  // [unit]
    double rate;                     // [Hz]
    double start = 0;                // instant of the first value [s]

    double time(std::size_t i) const { return start + static_cast<double>(i) / rate; }
};

inline constexpr double endless = std::numeric_limits<double>::infinity();  // [s]

// The first sample at or after an instant, at most the last one; instants within a nanosecond are the same.
std::size_t sample_at(const Series& series, double time);
// The samples within [from, to].
Series between(const Series& series, double from, double to = endless);

// Of values at any rate; NaN of none.
double mean(std::span<const double> values);
double largest_magnitude(std::span<const double> values);  // 0 of none
std::vector<double> scaled(std::span<const double> values, double factor);
std::vector<double> shifted(std::span<const double> values, double by);
// An angle within half a turn [deg], continued beyond it.
std::vector<double> continued(std::span<const double> angle);
// At most about so many, evenly, for a diagram.
std::vector<double> thinned(std::span<const double> values, std::size_t max_count = 1500);
// y at a place between ascending x, a straight line between two of them; the first and the last y beyond.
double interpolated(std::span<const double> x, std::span<const double> y, double at);

// At an instant [s]; before the first and after the last value these. std::length_error for a series without values.
double interpolated(const Series& series, double time);

enum class Crossing { rising, falling, either };

// The first instant from `from` on at which the series reaches a level, coming from below or from above [s]. A series
// that starts at the level does not come from anywhere.
std::optional<double> first_crossing(const Series& series, double level, Crossing direction, double from = -endless);

enum class Extreme { highest, lowest, largest };  // largest: in magnitude

struct Peak {
    double time;   // [s]
    double value;  // [unit], with its sign
};

// The most extreme sample within [from, to], refined by the parabola through it and its neighbors where they are
// less extreme; of equals the first. None where no sample is within.
std::optional<Peak> peak(const Series& series, Extreme kind, double from = -endless, double to = endless);

// y = intercept + slope x
struct FittedLine {
    double slope, intercept;
    double r_squared;  // 1 - squares of what is left over squares about the mean; 1 where y is constant
};

// Least squares. std::invalid_argument unless there are as many y as x and at least two different x.
FittedLine fitted_line(std::span<const double> x, std::span<const double> y);

// The integral up to each sample by trapezoids [unit s], `initial` at the first.
std::vector<double> running_integral(const Series& series, double initial = 0);

// The series at another rate [Hz], from its start to its last value at most. To a lower rate, filter before: nothing is
// done here against aliases. std::length_error for a series without values, std::invalid_argument for a rate that is
// not positive.
std::vector<double> resampled(const Series& series, double rate);

// Values at instants that need not be equally spaced but never go back [s], at a constant rate from the first instant
// on. Errors as above, std::invalid_argument also for instants that go back or are not as many as the values.
std::vector<double> resampled(std::span<const double> times, std::span<const double> values, double rate);

}  // namespace hamilcar
