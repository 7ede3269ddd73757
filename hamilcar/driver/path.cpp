#include "hamilcar/driver/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "hamilcar/driver/short_number.hpp"
#include "hamilcar/driver/spline.hpp"
#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

constexpr double min_distance = 1e-6;       // between neighboring points [m]
constexpr double max_coordinate = 1e6;      // from the origin, along either axis [m]
constexpr double max_length = 1e7;          // [m]
constexpr double max_samples = 1e6;         // along a whole path
constexpr double reversal_cosine = -0.996;  // cosine between neighboring chords: within 5 degrees of a reversal [1]
constexpr double min_square = 1e-12;        // lower bound on the squared spline speed, which is a divisor [1]
constexpr double search_distance = 10, search_spacing = 1;  // for a stretch nearer than the remembered one [m]
constexpr double max_step = 2;                              // of Newton's method for the nearest point [m]
constexpr double min_curvature = 0.25;  // lower bound on the second derivative, as a share of a straight line's [1]
constexpr int max_iterations = 30;

// Five-point Gauss-Legendre quadrature on [0, 1].
constexpr std::array<double, 5> node{0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                     0.95308992296933200};
constexpr std::array<double, 5> weight{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                       0.23931433524968324, 0.11846344252809454};

using Points = std::vector<std::array<double, 2>>;

// From a point to the next one; cyclic for closed paths [m].
std::array<double, 2> chord(const Points& points, std::size_t i) {
    const auto [x, y] = points[i % points.size()];
    const auto [next_x, next_y] = points[(i + 1) % points.size()];
    return {next_x - x, next_y - y};
}

void check_point(const std::array<double, 2>& point, std::size_t number) {
    for (const double coordinate : point) {
        if (std::abs(coordinate) <= max_coordinate) continue;
        const std::string start = "point " + std::to_string(number) + " of the path ";
        if (std::isnan(coordinate)) throw std::invalid_argument(start + "is not a number");
        throw std::invalid_argument(start + "lies at " + short_number(coordinate) + " m; expected within " +
                                    short_number(max_coordinate) + " m of the origin");
    }
}

void check(const PathDescription& description) {
    const auto& points = description.points;
    const std::size_t min_count = description.closed ? 3 : 2;
    if (points.size() < min_count) {
        throw std::invalid_argument("a path needs at least " + std::to_string(min_count) + " points" +
                                    (description.closed ? " to be closed" : "") + ", found " +
                                    std::to_string(points.size()));
    }
    for (std::size_t i = 0; i < points.size(); ++i) check_point(points[i], i + 1);
    const std::size_t n = points.size();
    for (std::size_t i = 0; i + (description.closed ? 0 : 1) < n; ++i) {
        const auto [x, y] = chord(points, i);
        if (std::abs(x) + std::abs(y) >= min_distance) continue;
        throw std::invalid_argument("points " + std::to_string(i + 1) + " and " + std::to_string((i + 1) % n + 1) +
                                    " of the path coincide" +
                                    (i + 1 == n ? "; do not repeat the first point of a closed path" : ""));
    }
    // Where the path reversed, the speed of the spline would be zero and its direction undefined.
    for (std::size_t i = 0; i + (description.closed ? 0 : 2) < n; ++i) {
        const auto [x, y] = chord(points, i);
        const auto [next_x, next_y] = chord(points, i + 1);
        const double lengths = std::sqrt((x * x + y * y) * (next_x * next_x + next_y * next_y));
        if (x * next_x + y * next_y > reversal_cosine * lengths) continue;
        throw std::invalid_argument("the path turns back on itself at point " + std::to_string((i + 1) % n + 1));
    }
}

}  // namespace

double PathPoint::heading() const {
    if (tangent_x >= 0) return arctangent(tangent_y, tangent_x);
    return (tangent_y < 0 ? -std::numbers::pi : std::numbers::pi) - arctangent(tangent_y, -tangent_x);
}

Path::Path(const PathDescription& description) : closed_(description.closed) {
    check(description);
    const auto& points = description.points;
    const std::size_t n = points.size(), count = closed_ ? n : n - 1;
    std::vector<double> x(n), y(n), chord(count);
    for (std::size_t i = 0; i < n; ++i) x[i] = points[i][0], y[i] = points[i][1];
    for (std::size_t i = 0; i < count; ++i) {
        const double dx = x[(i + 1) % n] - x[i], dy = y[(i + 1) % n] - y[i];
        chord[i] = std::sqrt(dx * dx + dy * dy);
    }
    const auto second_derivatives = closed_ ? spline::periodic_second_derivatives : spline::natural_second_derivatives;
    const std::vector<double> ddx = second_derivatives(x, chord), ddy = second_derivatives(y, chord);
    station_.push_back(0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % n;
        stretches_.push_back({spline::cubic(x[i], x[next], ddx[i], ddx[next], chord[i]),
                              spline::cubic(y[i], y[next], ddy[i], ddy[next], chord[i]), chord[i]});
        station_.push_back(station_.back() + arc(stretches_.back(), chord[i]));
    }
    if (length() <= max_length) return;
    throw std::invalid_argument("the path is " + short_number(length()) + " m long; expected at most " +
                                short_number(max_length) + " m");
}

Path::Local Path::local(const Stretch& stretch, double u) {
    const auto& [x, y, chord] = stretch;
    return {.x = x[0] + u * (x[1] + u * (x[2] + u * x[3])),
            .y = y[0] + u * (y[1] + u * (y[2] + u * y[3])),
            .dx = x[1] + u * (2 * x[2] + u * (3 * x[3])),
            .dy = y[1] + u * (2 * y[2] + u * (3 * y[3])),
            .ddx = 2 * x[2] + 6 * u * x[3],
            .ddy = 2 * y[2] + 6 * u * y[3]};
}

// Length of the stretch from its start to u.
double Path::arc(const Stretch& stretch, double u) {
    double sum = 0;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Local here = local(stretch, u * node[i]);
        sum += weight[i] * std::sqrt(here.dx * here.dx + here.dy * here.dy);
    }
    return u * sum;
}

bool Path::is_beyond(const Parameter& at) const {
    if (closed_) return false;
    return at.u < 0 || (at.stretch + 1 == stretches_.size() && at.u > stretches_.back().chord);
}

Path::Local Path::local(const Parameter& at) const {
    const Stretch& stretch = stretches_[at.stretch];
    if (!is_beyond(at)) return local(stretch, at.u);
    const double end = at.u < 0 ? 0 : stretch.chord;
    Local here = local(stretch, end);
    here.x += (at.u - end) * here.dx, here.y += (at.u - end) * here.dy;
    here.ddx = here.ddy = 0;
    return here;
}

double Path::station(const Parameter& at) const {
    const Stretch& stretch = stretches_[at.stretch];
    const double before = station_[at.stretch] + at.lap * length();
    if (!is_beyond(at)) return before + arc(stretch, at.u);
    const double end = at.u < 0 ? 0 : stretch.chord;
    const Local here = local(stretch, end);
    return before + arc(stretch, end) + (at.u - end) * std::sqrt(here.dx * here.dx + here.dy * here.dy);
}

// Newton's method for the arc length within the stretch.
Path::Parameter Path::parameter(double station) const {
    Parameter at{0, 0, 0};
    if (closed_) at.lap = static_cast<int>(std::floor(station / length()));
    const double rest = station - at.lap * length();
    const auto after = std::upper_bound(station_.begin() + 1, station_.end() - 1, rest);
    at.stretch = static_cast<std::size_t>(after - station_.begin()) - 1;
    const Stretch& stretch = stretches_[at.stretch];
    const double wanted = rest - station_[at.stretch], whole = station_[at.stretch + 1] - station_[at.stretch];
    at.u = wanted / whole * stretch.chord;
    for (int i = 0; i < 8; ++i) {
        const Local here = local(at);
        const double speed = std::sqrt(here.dx * here.dx + here.dy * here.dy);
        const double change = (station - this->station(at)) / std::max(speed, 0.01);
        at.u += change;
        if (std::abs(change) < 1e-12 * (1 + stretch.chord)) break;
    }
    return at;
}

PathPoint Path::at(double station) const {
    const Local here = local(parameter(station));
    const double square = std::max(here.dx * here.dx + here.dy * here.dy, min_square), speed = std::sqrt(square);
    return {here.x, here.y, here.dx / speed, here.dy / speed,
            (here.dx * here.ddy - here.dy * here.ddx) / (square * speed)};
}

// Continues onto the neighboring stretches.
Path::Parameter Path::moved(Parameter at, double by) const {
    at.u += by;
    const std::size_t last = stretches_.size() - 1;
    while (at.u < 0 && (closed_ || at.stretch > 0)) {
        if (at.stretch == 0) --at.lap;
        at.stretch = at.stretch == 0 ? last : at.stretch - 1;
        at.u += stretches_[at.stretch].chord;
    }
    while (at.u >= stretches_[at.stretch].chord && (closed_ || at.stretch < last)) {
        at.u -= stretches_[at.stretch].chord;
        if (at.stretch == last) ++at.lap;
        at.stretch = at.stretch == last ? 0 : at.stretch + 1;
    }
    return at;
}

// Newton's method for half the squared distance; where that is not convex, a step down its gradient.
PathPlace Path::descend(double x, double y, Parameter at) const {
    Local here = local(at);
    for (int i = 0; i < max_iterations; ++i) {
        const double to_x = here.x - x, to_y = here.y - y;
        const double square = std::max(here.dx * here.dx + here.dy * here.dy, min_square);
        const double slope = to_x * here.dx + to_y * here.dy;
        const double bend = std::max(square + to_x * here.ddx + to_y * here.ddy, min_curvature * square);
        const double change = std::clamp(-slope / bend, -max_step, max_step);
        at = moved(at, change);
        here = local(at);
        if (std::abs(change) < 1e-11) break;
    }
    const double speed = std::sqrt(std::max(here.dx * here.dx + here.dy * here.dy, min_square));
    return {station(at), (here.dx * (y - here.y) - here.dy * (x - here.x)) / speed};
}

PathPlace Path::nearest(double x, double y, double remembered) const {
    Parameter best = parameter(remembered), at = best;
    double nearest_square = std::numeric_limits<double>::infinity();
    for (double ahead = 0; ahead <= search_distance; ahead += search_spacing, at = moved(at, search_spacing)) {
        const Local here = local(at);
        const double square = (here.x - x) * (here.x - x) + (here.y - y) * (here.y - y);
        if (square < nearest_square) nearest_square = square, best = at;
    }
    return descend(x, y, best);
}

PathPlace Path::nearest_of_all(double x, double y, double yaw) const {
    const auto [sine, cosine] = sincos(yaw);
    Parameter best{0, 0, 0};
    double nearest_square = std::numeric_limits<double>::infinity();
    const double stride = std::max(search_spacing, length() / max_samples);
    for (const bool any_direction : {false, true}) {
        for (Parameter at{0, 0, 0}; at.lap == 0 && !is_beyond(at); at = moved(at, stride)) {
            const Local here = local(at);
            const double square = (here.x - x) * (here.x - x) + (here.y - y) * (here.y - y);
            const bool along = here.dx * cosine + here.dy * sine > 0;
            if ((along || any_direction) && square < nearest_square) nearest_square = square, best = at;
        }
        if (nearest_square < std::numeric_limits<double>::infinity()) break;
    }
    return descend(x, y, best);
}

}  // namespace hamilcar
