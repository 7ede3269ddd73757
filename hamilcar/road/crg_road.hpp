// The height of a road given as an OpenCRG grid. A point of the ground is converted to u, v by OpenCRG's bisectors: the
// cross section at a sample of the reference line bisects the angle of its two segments, and between two cross sections u
// is proportional to the distance along the parallel to the segment. Heights are bilinear in u and v. Sources: the ASAM OpenCRG 1.2
// specification and its reference implementation (crgEvalxy2uv.c, crgEvaluv2xy.c, crgEvalz.c).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hamilcar/description/crg.hpp"
#include "hamilcar/road/crg_search.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// The points of the reference line, one a row [m]. A known end bends it.
std::vector<CrgPoint> reference_line(const CrgDescription& d);
// The first point after which the line has turned by a right angle or more, or not gone on: cross sections are no longer in order
// there. 0 if there is none.
std::size_t first_fold(std::span<const CrgPoint> line);

// Every point has a height: beyond the grid it follows the border modes, zero for `none`. A missing height inside the grid is
// replaced as the description specifies, by zero for `none`; the reference line's elevation and banking are added to it.
// `covers` tells whether a height comes from the file. A default-constructed road is flat.
struct CrgRoad {
    template <class N>
    struct Position {
        N u, v;  // [m]
    };

    CrgRoad() = default;
    // Throws std::invalid_argument if the parts of the description do not fit together.
    explicit CrgRoad(const CrgDescription& d);

    // The height [m] over a point of the ground [m].
    template <class N>
    N height(const N& x, const N& y) const {
        if (line_.empty()) return N(0);
        const Position<N> position = uv_of(x, y);
        return height_uv(position.u, position.v);
    }
    // Slope, banking and border offsets have no bound [m].
    static double max_height() { return std::numeric_limits<double>::infinity(); }

    // Whether the height there comes from the grid alone, neither from a border mode nor from a replaced missing height.
    bool covers(double x, double y) const;

    // Ground point to u, v and back; straight extensions beyond the ends. Not for a default-constructed road.
    template <class N>
    Position<N> uv_of(const N& x, const N& y) const;
    CrgPoint xy_of(double u, double v) const;

    template <class N>
    N height_uv(N u, N v) const;

private:
    // Tolerance of the grid's edges [m]: round-off does not move a point off the grid.
    static constexpr double border_tolerance = 1e-8;

    // The segment between two samples, and whether a point lies before the road (-1), after it (1) or on it (0).
    struct Segment {
        std::size_t first;
        int side;
    };
    Segment segment_of(double x, double y) const;

    // The direction that the cross section at a sample is normal to, not of unit length.
    CrgPoint across(std::size_t i) const {
        const CrgPoint &back = line_[i > 0 ? i - 1 : 0], &front = line_[i + 1 < line_.size() ? i + 1 : i];
        return {front.x - back.x, front.y - back.y};
    }
    // Positive if the point is ahead of the cross section at a sample.
    double ahead(double x, double y, std::size_t i) const {
        const CrgPoint n = across(i);
        return (x - line_[i].x) * n.x + (y - line_[i].y) * n.y;
    }

    static double floor_of(double x) {
        constexpr double exact = 4e15;  // larger doubles are integers
        if (!(x > -exact && x < exact)) return x;
        const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
        return x < whole ? whole - 1 : whole;
    }
    static std::size_t index_of(double x, std::size_t last) {
        return !(x > 0) ? 0 : x < static_cast<double>(last) ? static_cast<std::size_t>(x) : last;
    }
    std::size_t column_of(double v) const {
        std::size_t j = column_guess_[index_of((v - v_.front()) * per_guess_, column_guess_.size() - 1)];
        while (j + 2 < v_.size() && v >= v_[j + 1]) ++j;
        return j;
    }

    static bool is_within(double value, double low, double high) {
        return value >= low - border_tolerance && value <= high + border_tolerance;
    }
    template <class N>
    static bool bring_inside(N& t, double low, double high, CrgBorder border);
    // What the grid has, and what elevation and banking of the line add to it.
    template <class N>
    struct Parts {
        N grid, line;
    };
    template <class N>
    Parts<N> parts_at(const N& u, const N& v) const;

    std::vector<CrgPoint> line_;
    std::vector<double> elevation_, banking_;  // of the reference line, per row [m], [1]
    std::vector<double> v_, per_gap_;          // [m], [1/m]
    std::vector<double> heights_;
    std::vector<std::uint8_t> missing_;  // per height; empty if none is missing
    std::vector<std::uint32_t> column_guess_;
    double per_guess_ = 0;  // [1/m]
    double u_start_ = 0, u_end_ = 0, u_increment_ = 1, per_increment_ = 1;
    CrgBorder border_u_ = CrgBorder::keep, border_v_ = CrgBorder::keep;
    double offset_u_ = 0, offset_v_ = 0, smooth_start_ = 0, smooth_end_ = 0;
    std::size_t samples_ = 1;  // segments of a stretch
    CrgSearch search_;
};

// Expands from the nearest stretch until the point lies between two cross sections, then bisects.
inline CrgRoad::Segment CrgRoad::segment_of(double x, double y) const {
    const std::size_t last = line_.size() - 1;
    std::size_t low = search_.nearest(x, y) * samples_, high = low + samples_ < last ? low + samples_ : last;
    double at_low = ahead(x, y, low), at_high = ahead(x, y, high);
    for (std::size_t step = samples_; at_low < 0; step *= 2) {
        if (low == 0) return {0, -1};
        high = low, at_high = at_low;
        low -= low < step ? low : step;
        at_low = ahead(x, y, low);
    }
    for (std::size_t step = samples_; at_high >= 0; step *= 2) {
        if (high == last) return {last - 1, 1};
        low = high, at_low = at_high;
        high += last - high < step ? last - high : step;
        at_high = ahead(x, y, high);
    }
    // Alternates regula falsi, which is nearly exact, with bisection, which guarantees convergence.
    for (bool guess = true; high - low > 1; guess = !guess) {
        const double part = guess ? at_low / (at_low - at_high) : 0.5;
        const std::size_t inner = index_of(static_cast<double>(high - low - 1) * part, high - low - 2);
        const std::size_t middle = low + 1 + inner;
        const double at_middle = ahead(x, y, middle);
        if (at_middle >= 0)
            low = middle, at_low = at_middle;
        else
            high = middle, at_high = at_middle;
    }
    return {low, 0};
}

template <class N>
CrgRoad::Position<N> CrgRoad::uv_of(const N& x, const N& y) const {
    const Segment segment = segment_of(value_of(x), value_of(y));
    const std::size_t i = segment.first;
    const CrgPoint &from = line_[i], &to = line_[i + 1];
    const double ex = to.x - from.x, ey = to.y - from.y, length = sqrt(ex * ex + ey * ey);
    const N px = x - N(from.x), py = y - N(from.y), qx = N(to.x) - x, qy = N(to.y) - y;
    const N v = (py * N(ex) - px * N(ey)) * N(1 / length);
    if (segment.side < 0) return {N(u_start_) + (px * N(ex) + py * N(ey)) * N(1 / length), v};
    if (segment.side > 0) return {N(u_end_) - (qx * N(ex) + qy * N(ey)) * N(1 / length), v};

    const CrgPoint n = across(i), m = across(i + 1);
    const N behind = (px * N(n.x) + py * N(n.y)) * N(1 / (n.x * ex + n.y * ey));
    const N before = (qx * N(m.x) + qy * N(m.y)) * N(1 / (m.x * ex + m.y * ey));
    const N sum = behind + before;
    // Beyond the center of a bend the cross sections intersect, and u is not unique.
    N part = value_of(sum) > 1e-9 ? behind / sum : N(0.5);
    if (value_of(part) < -1e-9) part = N(0);
    if (value_of(part) > 1 + 1e-9) part = N(1);
    return {N(u_start_) + (N(static_cast<double>(i)) + part) * N(u_increment_), v};
}

// Whether t was beyond the grid and has been moved to its edge; never for repeating and reflecting borders.
template <class N>
bool CrgRoad::bring_inside(N& t, double low, double high, CrgBorder border) {
    const double value = value_of(t);
    if (is_within(value, low, high)) return false;
    if (border == CrgBorder::repeat || border == CrgBorder::reflect) {
        const double width = high - low, times = floor_of((value - low) / width);
        t = t - N(times * width);
        const bool mirrored = border == CrgBorder::reflect && times - 2 * floor_of(times / 2) > 0.5;
        if (mirrored) t = N(low + high) - t;
        return false;
    }
    t = N(value < low ? low : high);
    return true;
}

template <class N>
CrgRoad::Parts<N> CrgRoad::parts_at(const N& u, const N& v) const {
    const N rows = (u - N(u_start_)) * N(per_increment_);
    const std::size_t i = index_of(value_of(rows), line_.size() - 2), j = column_of(value_of(v));
    const N a = rows - N(static_cast<double>(i)), b = (v - N(v_[j])) * N(per_gap_[j]);
    const double *here = &heights_[i * v_.size() + j], *next = here + v_.size();
    const N right = N(here[0]) + a * N(next[0] - here[0]), left = N(here[1]) + a * N(next[1] - here[1]);
    const N raised = N(elevation_[i]) + a * N(elevation_[i + 1] - elevation_[i]);
    const N banking = N(banking_[i]) + a * N(banking_[i + 1] - banking_[i]);
    return {right + b * (left - right), raised + v * banking};
}

// Beyond both borders as OpenCRG's library has it: a `zero` of u is zero, one of v leaves the line's elevation where u is
// beyond its border too; both offsets count, also that of a border that repeats or reflects.
template <class N>
N CrgRoad::height_uv(N u, N v) const {
    if (line_.empty()) return N(0);
    const bool out_u = !is_within(value_of(u), u_start_, u_end_),
               out_v = !is_within(value_of(v), v_.front(), v_.back());
    const bool off_u = bring_inside(u, u_start_, u_end_, border_u_);
    const bool off_v = bring_inside(v, v_.front(), v_.back(), border_v_);
    if ((off_u && border_u_ == CrgBorder::none) || (off_v && border_v_ == CrgBorder::none)) return N(0);
    const Parts<N> parts = parts_at(u, v);
    const bool zero_u = off_u && border_u_ == CrgBorder::zero, zero_v = off_v && border_v_ == CrgBorder::zero;
    N z = zero_u || zero_v ? N(0) : parts.grid;
    if (!zero_u && (off_u || !zero_v)) z = z + parts.line;
    if (off_u || off_v) z = z + N((out_u ? offset_u_ : 0) + (out_v ? offset_v_ : 0));
    const N begun = u - N(u_start_), left = N(u_end_) - u;
    const double start = elevation_.front(), end = elevation_.back();
    if (smooth_end_ > 0 && value_of(left) < smooth_end_) return N(end) + left * N(1 / smooth_end_) * (z - N(end));
    if (smooth_start_ > 0 && value_of(begun) < smooth_start_)
        return N(start) + begun * N(1 / smooth_start_) * (z - N(start));
    return z;
}

}  // namespace hamilcar
