// The patch under a wheel, and the plane that best fits a surface there. Heights are taken at five stations along the
// wheel's heading, on two lines side by side, weighted like a raised cosine:
//
//     mean = sum w h,   slope ahead = sum w a h / sum w a^2,   slope to the left = (left - right) / (2 b)
//
// with each line's stations at a and the lines b beside the middle (docs/models/roads.md).
#pragma once

#include <array>
#include <cstddef>

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/double_pair.hpp"
#include "hamilcar/scalar/dual.hpp"

namespace hamilcar {

// Shape of the patch, in wheel radii.
struct Patch {
    static constexpr double half_length = 1.0 / 3, half_width = 0.25;
    static constexpr std::size_t count = 5;
    static constexpr std::array<double, count> stations{-1, -0.5, 0, 0.5, 1};
    static constexpr std::array<double, count> weights{1.0 / 12, 3.0 / 12, 4.0 / 12, 3.0 / 12, 1.0 / 12};
    static constexpr double second_moment = 2.0 / 12 * 1 + 6.0 / 12 * 0.25;  // sum of w a^2
};

// Position and heading of a patch: the input of a surface query.
template <class T>
struct PatchPose {
    T unit_x, unit_y;                                // of the origin of the wheel's unit [m]
    T x, y, x_rate, y_rate;                          // of its center, relative to that; absolute rates [m, m/s]
    T ahead_x, ahead_y, ahead_x_rate, ahead_y_rate;  // heading, a unit vector [1, 1/s]
    T radius;                                        // of the wheel [m]
    T clearance;  // minimum height above the plane at which the surface can matter [m]

    static constexpr int count = 12;
    // Calls f with each number, in a fixed order.
    template <class Self, class F>
    static void for_each(Self&& self, F&& f) {
        f(self.unit_x), f(self.unit_y), f(self.x), f(self.y), f(self.x_rate), f(self.y_rate);
        f(self.ahead_x), f(self.ahead_y), f(self.ahead_x_rate), f(self.ahead_y_rate);
        f(self.radius), f(self.clearance);
    }
};

// The fitted plane relative to the road's plane at the patch center, with its rates along the wheel's path. Above the maximum
// height of the surface `found` is 0, and the other fields have no meaning.
template <class T>
struct PatchPlane {
    T height{0}, height_rate{0};  // [m, m/s]
    T ahead{0}, ahead_rate{0};    // slope along the heading [1, 1/s]
    T left{0}, left_rate{0};      // slope to the left of it [1, 1/s]
    T friction{1};                // factor [1]
    T found{0};

    static constexpr int count = 8;
    template <class Self, class F>
    static void for_each(Self&& self, F&& f) {
        f(self.height), f(self.height_rate), f(self.ahead), f(self.ahead_rate), f(self.left), f(self.left_rate);
        f(self.friction), f(self.found);
    }
};

// A pair of values, for the right and the left line.
template <class T>
struct RightAndLeft {
    using type = Eigen::Array<T, 2, 1>;
};
template <>
struct RightAndLeft<double> {
    using type = DoublePair;
};

// The two points of a station [m, m/s].
template <class T>
struct PatchPoints {
    using Both = typename RightAndLeft<T>::type;
    Both x, y, x_rate, y_rate;
};

// Both lines on the ground.
template <class T>
class PatchLines {
public:
    explicit PatchLines(const PatchPose<T>& at)
        : ahead_x_(length(at) * at.ahead_x),
          ahead_y_(length(at) * at.ahead_y),
          ahead_x_rate_(length(at) * at.ahead_x_rate),
          ahead_y_rate_(length(at) * at.ahead_y_rate) {
        const T b = at.radius * T(Patch::half_width);
        const T x = at.unit_x + at.x, y = at.unit_y + at.y;
        const T aside_x = b * at.ahead_y, aside_y = b * at.ahead_x;
        const T aside_x_rate = b * at.ahead_y_rate, aside_y_rate = b * at.ahead_x_rate;
        middle_ = {Both{x + aside_x, x - aside_x}, Both{y - aside_y, y + aside_y},
                   Both{at.x_rate + aside_x_rate, at.x_rate - aside_x_rate},
                   Both{at.y_rate - aside_y_rate, at.y_rate + aside_y_rate}};
    }
    PatchPoints<T> at(std::size_t station) const {
        const T a(Patch::stations[station]);
        return {middle_.x + a * ahead_x_, middle_.y + a * ahead_y_, middle_.x_rate + a * ahead_x_rate_,
                middle_.y_rate + a * ahead_y_rate_};
    }

    // In other units: x relative to an origin and times `per_x`, y times `per_y`.
    PatchLines scaled(const T& origin, const T& per_x, const T& per_y) const {
        PatchLines out = *this;
        out.middle_ = {(middle_.x - origin) * per_x, middle_.y * per_y, middle_.x_rate * per_x, middle_.y_rate * per_y};
        out.ahead_x_ *= per_x, out.ahead_x_rate_ *= per_x;
        out.ahead_y_ *= per_y, out.ahead_y_rate_ *= per_y;
        return out;
    }
    // The lowest and the highest x of all points.
    std::array<T, 2> along_x() const {
        const T length = abs(ahead_x_);
        return {min(middle_.x[0], middle_.x[1]) - length, max(middle_.x[0], middle_.x[1]) + length};
    }

private:
    using Both = typename RightAndLeft<T>::type;
    static T length(const PatchPose<T>& at) { return at.radius * T(Patch::half_length); }

    PatchPoints<T> middle_;
    T ahead_x_, ahead_y_, ahead_x_rate_, ahead_y_rate_;  // from the center to the last station
};

// Weighted sums of heights above the plane and of their rates, per line [m, m/s].
template <class T>
struct PatchSums {
    using Both = typename RightAndLeft<T>::type;
    Both mean = Both{T(0), T(0)}, ahead = mean, mean_rate = mean, ahead_rate = mean;

    void add(std::size_t station, const Both& height, const Both& rate) {
        const T weight(Patch::weights[station]), arm(Patch::weights[station] * Patch::stations[station]);
        mean += weight * height, mean_rate += weight * rate;
        ahead += arm * height, ahead_rate += arm * rate;
    }
    // Adds any element of the surface.
    template <class Element>
    void add(std::size_t station, const Element& element, const PatchPoints<T>& points) {
        using N = Dual<T, 1>;  // value and rate
        Both height, rate;
        for (int i = 0; i < 2; ++i) {
            const N z = element.height(N(points.x[i], {points.x_rate[i]}), N(points.y[i], {points.y_rate[i]}));
            height[i] = z.value(), rate[i] = z.partial(0);
        }
        add(station, height, rate);
    }
    PatchPlane<T> plane(const T& radius) const {
        const T half(0.5), per_radius = T(1) / radius;
        const T lengthwise = per_radius * T(0.5 / (Patch::half_length * Patch::second_moment));
        const T sideways = per_radius * T(0.5 / Patch::half_width);
        return {half * (mean[0] + mean[1]),
                half * (mean_rate[0] + mean_rate[1]),
                lengthwise * (ahead[0] + ahead[1]),
                lengthwise * (ahead_rate[0] + ahead_rate[1]),
                sideways * (mean[1] - mean[0]),
                sideways * (mean_rate[1] - mean_rate[0]),
                T(1),
                T(1)};
    }
};

}  // namespace hamilcar
