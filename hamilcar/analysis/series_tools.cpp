#include "hamilcar/analysis/series_tools.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hamilcar {

namespace {

void need_values(std::span<const double> values) {
    if (values.empty()) throw std::length_error("a series without values has none between them");
}

// Samples at a rate within a duration, both ends included; a sample that is meant to fall on the end does.
std::size_t samples_within(double duration, double rate) {
    if (!(rate > 0)) throw std::invalid_argument("a sampling rate is positive");
    return static_cast<std::size_t>(std::floor(duration * rate + 1e-9)) + 1;
}

}  // namespace

std::size_t sample_at(const Series& series, double time) {
    if (series.values.empty()) return 0;
    const double place = std::ceil((time - 1e-9 - series.start) * series.rate),
                 last = static_cast<double>(series.values.size() - 1);
    return static_cast<std::size_t>(std::clamp(place, 0.0, last));
}

Series between(const Series& series, double from, double to) {
    const std::size_t count = series.values.size();
    const auto place = [&](double time) {
        return std::clamp(std::ceil((time - series.start) * series.rate), 0.0, static_cast<double>(count));
    };
    const auto first = static_cast<std::size_t>(place(from - 1e-9)), end = static_cast<std::size_t>(place(to + 1e-9));
    return {series.values.subspan(first, std::max(end, first) - first), series.rate, series.time(first)};
}

double mean(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double largest_magnitude(std::span<const double> values) {
    double out = 0;
    for (const double value : values) out = std::max(out, std::abs(value));
    return out;
}

std::vector<double> scaled(std::span<const double> values, double factor) {
    std::vector<double> out(values.begin(), values.end());
    for (double& value : out) value *= factor;
    return out;
}

std::vector<double> shifted(std::span<const double> values, double by) {
    std::vector<double> out(values.begin(), values.end());
    for (double& value : out) value += by;
    return out;
}

std::vector<double> continued(std::span<const double> angle) {
    constexpr double turn = 360;  // [deg]
    std::vector<double> out;
    for (const double now : angle) {
        const double before = out.empty() ? now : out.back();
        out.push_back(now + turn * std::round((before - now) / turn));
    }
    return out;
}

std::vector<double> thinned(std::span<const double> values, std::size_t max_count) {
    const std::size_t every = std::max<std::size_t>(1, values.size() / max_count);
    std::vector<double> out;
    for (std::size_t i = 0; i < values.size(); i += every) out.push_back(values[i]);
    return out;
}

double interpolated(std::span<const double> x, std::span<const double> y, double at) {
    need_values(y);
    const auto next = std::ranges::lower_bound(x, at);
    if (next == x.begin()) return y.front();
    if (next == x.end()) return y.back();
    const auto i = static_cast<std::size_t>(next - x.begin());
    return std::lerp(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

double interpolated(const Series& series, double time) {
    need_values(series.values);
    const std::size_t last = series.values.size() - 1;
    const double place = (time - series.start) * series.rate;
    if (!(place > 0)) return series.values.front();
    if (place >= static_cast<double>(last)) return series.values.back();
    const auto i = static_cast<std::size_t>(place);
    return std::lerp(series.values[i], series.values[i + 1], place - static_cast<double>(i));
}

std::optional<double> first_crossing(const Series& series, double level, Crossing direction, double from) {
    for (std::size_t i = 0; i + 1 < series.values.size(); ++i) {
        const double a = series.values[i] - level, b = series.values[i + 1] - level;
        const bool rises = a < 0 && b >= 0 && direction != Crossing::falling;
        const bool falls = a > 0 && b <= 0 && direction != Crossing::rising;
        if (!rises && !falls) continue;
        const double time = series.time(i) + a / (a - b) / series.rate;
        if (time >= from) return time;
    }
    return std::nullopt;
}

std::optional<Peak> peak(const Series& series, Extreme kind, double from, double to) {
    const auto rank = [&](std::size_t i) {
        const double value = series.values[i];
        return kind == Extreme::largest ? std::abs(value) : kind == Extreme::highest ? value : -value;
    };
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < series.values.size(); ++i) {
        const double time = series.time(i);
        if (time >= from && time <= to && (!best || rank(i) > rank(*best))) best = i;
    }
    if (!best) return std::nullopt;
    const std::size_t i = *best;
    const Peak sample{series.time(i), series.values[i]};
    const bool inside = i > 0 && i + 1 < series.values.size();
    if (!inside || rank(i - 1) > rank(i) || rank(i + 1) > rank(i)) return sample;
    const double before = series.values[i - 1], after = series.values[i + 1];
    const double bend = before - 2 * sample.value + after;
    if (bend == 0) return sample;
    const double shift = (before - after) / (2 * bend);  // within half a sample
    return Peak{sample.time + shift / series.rate, sample.value - (before - after) * shift / 4};
}

FittedLine fitted_line(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size()) throw std::invalid_argument("a line is fitted to as many y as x");
    const auto count = static_cast<double>(x.size());
    // From the first point on: of what is constant the squares are zero, without rounding.
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) mean_x += (x[i] - x[0]) / count, mean_y += (y[i] - y[0]) / count;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = x[i] - x[0] - mean_x, v = y[i] - y[0] - mean_y;
        xx += u * u, xy += u * v, yy += v * v;
    }
    if (!(xx > 0)) throw std::invalid_argument("a line is fitted to at least two different x");
    const double slope = xy / xx;
    return {slope, y[0] + mean_y - slope * (x[0] + mean_x), yy > 0 ? xy * xy / (xx * yy) : 1};
}

std::vector<double> running_integral(const Series& series, double initial) {
    std::vector<double> out;
    out.reserve(series.values.size());
    for (std::size_t i = 0; i < series.values.size(); ++i)
        out.push_back(i == 0 ? initial : out.back() + (series.values[i - 1] + series.values[i]) / (2 * series.rate));
    return out;
}

std::vector<double> resampled(const Series& series, double rate) {
    need_values(series.values);
    std::vector<double> out(samples_within(static_cast<double>(series.values.size() - 1) / series.rate, rate));
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = interpolated(series, series.start + static_cast<double>(i) / rate);
    return out;
}

std::vector<double> resampled(std::span<const double> times, std::span<const double> values, double rate) {
    need_values(values);
    if (times.size() != values.size()) throw std::invalid_argument("every value has one instant");
    if (!std::ranges::is_sorted(times)) throw std::invalid_argument("instants do not go back");
    std::vector<double> out(samples_within(times.back() - times.front(), rate));
    std::size_t next = 0;  // the first instant after the sample's
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double time = times.front() + static_cast<double>(i) / rate;
        while (next < times.size() && times[next] <= time) ++next;
        if (next == times.size()) {
            out[i] = values.back();
        } else {
            const double share = (time - times[next - 1]) / (times[next] - times[next - 1]);
            out[i] = std::lerp(values[next - 1], values[next], share);
        }
    }
    return out;
}

}  // namespace hamilcar
