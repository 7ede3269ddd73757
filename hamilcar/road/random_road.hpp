// A random road of an ISO 8608 class: two tracks side by side, generated once as a table of harmonics with random phases
// and interpolated by a cubic B-spline, so that even the curvature is continuous. Height = c(x) + d(x) s(y), where s is -1
// at the right track and 1 at the left one.
//
// An isotropic surface with the spectrum n^-2 along any line has tracks with the coherence gamma = k b K_1(k b), k =
// 2 pi n, with b between them. So c has the spectrum G (1 + gamma)/2 and d has G (1 - gamma)/2; each harmonic of d randomly
// leads or lags that of c by a quarter wave, so that both tracks have the spectrum G in every harmonic and not only on average.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hamilcar/road/obstacle.hpp"
#include "hamilcar/road/patch.hpp"

namespace hamilcar {

class RandomRoad {
public:
    RandomRoad() = default;
    explicit RandomRoad(const RandomRoadDescription& d);

    // Length after which the table repeats [m].
    double period() const { return static_cast<double>(pieces_.size()) / per_meter_; }

    // For any scalar.
    template <class N>
    N height(const N& x, const N& y) const {
        const N fade = along_.weight(x), position = (x - N(along_.from)) * N(per_meter_);
        const double at = value_of(position);
        if (!exists(at) || !(value_of(fade) > 0)) return N(0);
        const Piece& p = piece(static_cast<std::int64_t>(at));
        const N u = position - N(static_cast<double>(static_cast<std::int64_t>(at)));
        const auto spline = [&](int k) {
            return N(p.constant[k]) + u * (N(p.linear[k]) + u * (N(p.square[k]) + u * N(p.cube[k])));
        };
        return fade * (spline(0) + spline(1) * across(N(y * N(per_half_width_))));
    }

    // The same under a wheel, in less than half the time: both points of a station together, and slopes in place of duals.
    void add_to(PatchSums<double>& sums, const PatchLines<double>& lines) const {
        const auto [first, last] = lines.along_x();
        if (!is_whole(first) || !is_whole(last)) {
            for (std::size_t i = 0; i < Patch::count; ++i) sums.add(i, *this, lines.at(i));
            return;
        }
        const PatchLines<double> scaled = lines.scaled(along_.from, per_meter_, per_half_width_);
        for (std::size_t i = 0; i < Patch::count; ++i) {
            const PatchPoints<double> at = scaled.at(i);
            const auto [height, along, aside] = sloped(at.x, at.y);
            sums.add(i, height, along * at.x_rate + aside * at.y_rate);
        }
    }

    // Upper bound on all heights [m].
    double max_height() const { return max_height_; }

private:
    // c and d between two knots: constant + u (linear + u (square + u cube)), u from 0 to 1 [m].
    struct Piece {
        DoublePair constant, linear, square, cube;
    };
    struct Sloped {
        DoublePair height, along, aside;
    };
    struct CommonAndDifferent {
        DoublePair value, slope;
    };

    // Larger positions are not exact in a double.
    bool exists(double position) const { return position >= 0 && position < 1e15 && !pieces_.empty(); }
    bool is_whole(double x) const { return along_.is_whole(x) && exists((x - along_.from) * per_meter_); }
    const Piece& piece(std::int64_t number) const {
        return pieces_[static_cast<std::size_t>(number) & (pieces_.size() - 1)];
    }

    // Linear between the tracks, then leveling off: constant from one track width off the center.
    template <class N>
    static N across(const N& s) {
        const double beside = std::abs(value_of(s)), side = value_of(s) < 0 ? -1 : 1;
        if (beside <= 1) return s;
        if (!(beside < 2)) return N(1.5 * side);
        const N rest = N(2) - N(side) * s;
        return N(side) * (N(1.5) - N(0.5) * rest * rest);
    }

    // `position` in pieces, `s` in half widths; s(y) as in `across`, without branches.
    Sloped sloped(const DoublePair& position, const DoublePair& s) const {
        const CommonAndDifferent right = spline(position[0]), left = spline(position[1]);
        const DoublePair c{right.value[0], left.value[0]}, d{right.value[1], left.value[1]};
        const DoublePair c_slope{right.slope[0], left.slope[0]}, d_slope{right.slope[1], left.slope[1]};
        const DoublePair size = s < 0.0 ? -s : s, beside = size < 2.0 ? size : DoublePair{2, 2};
        const DoublePair over = beside > 1.0 ? beside - 1.0 : DoublePair{0, 0};
        const DoublePair rise = beside - 0.5 * over * over, side = s < 0.0 ? -rise : rise;
        return {c + d * side, c_slope + d_slope * side, d * (1.0 - over)};
    }
    CommonAndDifferent spline(double position) const {
        const auto number = static_cast<std::int64_t>(position);
        const Piece& p = piece(number);
        const double u = position - static_cast<double>(number);
        const DoublePair first = u * p.cube, second = first + p.square, third = u * second + p.linear;
        return {p.constant + u * third, third + u * (second + first)};
    }

    SmoothRange along_;          // where the road is
    double per_meter_ = 1;       // pieces per meter [1/m]
    double per_half_width_ = 1;  // 1 / half the track width [1/m]
    double max_height_ = 0;      // [m]
    std::vector<Piece> pieces_;  // of one period, a power of two
};

}  // namespace hamilcar
