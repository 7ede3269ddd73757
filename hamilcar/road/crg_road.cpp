// Preparation of a road: integrates the reference line and its elevation, fills in missing heights, and builds the search.
#include "hamilcar/road/crg_road.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace hamilcar {

namespace {

void require(bool condition, const char* what) {
    if (!condition) throw std::invalid_argument(std::string("an OpenCRG road needs ") + what);
}

bool all_finite(const std::vector<double>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

void check(const CrgDescription& d) {
    const std::size_t rows = d.rows(), columns = d.columns();
    require(columns >= 2 && rows >= 2 && rows * columns == d.heights.size(),
            "at least two rows and two columns of heights");
    require(d.u_increment > 0 && std::isfinite(d.u_start) && std::isfinite(d.u_end()), "rows in increasing u");
    require(d.headings.empty() || d.headings.size() == rows - 1, "a heading per segment, or one for all");
    require(d.slopes.empty() || d.slopes.size() == rows - 1, "a slope per segment, or one for all");
    require(d.bankings.empty() || d.bankings.size() == rows, "a banking per row, or one for all");
    require(d.end_x.has_value() == d.end_y.has_value(), "both coordinates of the line's end, or neither");
    require(all_finite(d.headings) && all_finite(d.slopes) && all_finite(d.bankings) && all_finite(d.v) &&
                all_finite({d.x, d.y, d.z, d.phi, d.slope, d.banking, d.end_x.value_or(0), d.end_y.value_or(0),
                            d.end_z.value_or(0), d.border_offset_u, d.border_offset_v, d.smooth_start, d.smooth_end,
                            d.missing_offset}),
            "finite numbers");
    require(std::none_of(d.heights.begin(), d.heights.end(), [](double z) { return std::isinf(z); }), "finite heights");
    for (std::size_t j = 1; j < columns; ++j) require(d.v[j] > d.v[j - 1], "columns in increasing v");
}

// Cumulative sum of the steps from the start. A known end is met by also summing backward from it and blending the two sums with
// OpenCRG's weights: a sample's index, less `lag`, over the last index.
std::vector<double> cumulative(const std::vector<double>& steps, double start, const std::optional<double>& end,
                               std::size_t lag = 0) {
    const std::size_t last = steps.size();
    std::vector<double> sum(last + 1, start);
    if (end) sum[last] = *end;
    for (std::size_t i = last; end && i > 1; --i) sum[i - 1] = sum[i] - steps[i - 1];
    for (std::size_t i = 0; i < last; ++i) {
        const double share = i + 1 == last ? 1 : static_cast<double>(i + 1 - lag) / static_cast<double>(last);
        const double weight = end ? share : 0;
        sum[i + 1] = (1 - weight) * (sum[i] + steps[i]) + (weight > 0 ? weight * sum[i + 1] : 0);
    }
    return sum;
}

// Replaces the missing heights of one cross section.
void fill_row(double* row, std::size_t columns, CrgMissing missing, double offset) {
    double last = std::numeric_limits<double>::quiet_NaN();
    if (missing == CrgMissing::keep)
        for (std::size_t j = columns; j-- > 0;)  // ends at the rightmost valid height
            if (!std::isnan(row[j])) last = row[j];
    for (std::size_t j = 0; j < columns; ++j) {
        if (!std::isnan(row[j]))
            last = missing == CrgMissing::keep ? row[j] : last;
        else
            row[j] = (std::isnan(last) ? 0 : last) + (missing == CrgMissing::none ? 0 : offset);
    }
}

}  // namespace

std::vector<CrgPoint> reference_line(const CrgDescription& d) {
    const std::size_t segments = d.rows() - 1;
    std::vector<double> dx(segments, d.u_increment * std::cos(d.phi)), dy(segments, d.u_increment * std::sin(d.phi));
    for (std::size_t i = 0; i < d.headings.size(); ++i) {
        dx[i] = d.u_increment * std::cos(d.headings[i]);
        dy[i] = d.u_increment * std::sin(d.headings[i]);
    }
    const bool curved = !d.headings.empty();
    const std::vector<double> x = cumulative(dx, d.x, curved ? d.end_x : std::nullopt);
    const std::vector<double> y = cumulative(dy, d.y, curved ? d.end_y : std::nullopt);
    std::vector<CrgPoint> line(segments + 1);
    for (std::size_t i = 0; i < line.size(); ++i) line[i] = {x[i], y[i]};
    return line;
}

std::size_t first_fold(std::span<const CrgPoint> line) {
    double ex = 0, ey = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const double fx = line[i].x - line[i - 1].x, fy = line[i].y - line[i - 1].y;
        if (!(fx * fx + fy * fy > 0 && (i == 1 || ex * fx + ey * fy > 0))) return i;
        ex = fx, ey = fy;
    }
    return 0;
}

CrgRoad::CrgRoad(const CrgDescription& d) : v_(d.v), heights_(d.heights) {
    check(d);
    const std::size_t rows = d.rows(), columns = d.columns(), segments = rows - 1;
    u_start_ = d.u_start, u_end_ = d.u_end(), u_increment_ = d.u_increment, per_increment_ = 1 / d.u_increment;
    border_u_ = d.border_u, border_v_ = d.border_v;
    offset_u_ = d.border_offset_u, offset_v_ = d.border_offset_v;
    smooth_start_ = d.smooth_start, smooth_end_ = d.smooth_end;

    line_ = reference_line(d);
    require(first_fold(line_) == 0, "a line that turns by less than a right angle between segments");
    std::vector<double> rises(segments, d.u_increment * d.slope);
    for (std::size_t i = 0; i < d.slopes.size(); ++i) rises[i] = d.u_increment * d.slopes[i];
    elevation_ = cumulative(rises, d.z, d.slopes.empty() && d.slope == 0 ? std::nullopt : d.end_z, 1);
    banking_ = d.bankings.empty() ? std::vector<double>(rows, d.banking) : d.bankings;

    if (std::any_of(heights_.begin(), heights_.end(), [](double z) { return std::isnan(z); })) {
        missing_.resize(heights_.size());
        for (std::size_t k = 0; k < heights_.size(); ++k) missing_[k] = std::isnan(heights_[k]);
        for (std::size_t i = 0; i < rows; ++i) fill_row(&heights_[i * columns], columns, d.missing, d.missing_offset);
    }

    for (std::size_t j = 0; j + 1 < columns; ++j) per_gap_.push_back(1 / (v_[j + 1] - v_[j]));
    column_guess_.resize(2 * columns);  // exact or one too low for uniform columns
    per_guess_ = static_cast<double>(column_guess_.size()) / (v_.back() - v_.front());
    for (std::size_t k = 0, j = 0; k < column_guess_.size(); ++k) {
        while (j + 2 < columns && v_.front() + static_cast<double>(k) / per_guess_ >= v_[j + 1]) ++j;
        column_guess_[k] = static_cast<std::uint32_t>(j);
    }

    constexpr double stretch_length = 4;  // [m]
    constexpr std::size_t max_stretches = 1 << 16;
    const double wanted = std::floor(std::min(stretch_length * per_increment_, 1e9));
    samples_ =
        std::max({std::size_t{1}, static_cast<std::size_t>(wanted), (segments + max_stretches - 1) / max_stretches});
    constexpr double margin = 8;  // beyond the grid [m], so that a wheel just off the road is still found by its cell
    search_ = CrgSearch(line_, samples_, std::max({0.0, -v_.front(), v_.back()}) + margin);
}

bool CrgRoad::covers(double x, double y) const {
    if (line_.empty()) return false;
    const Position<double> position = uv_of(x, y);
    const auto inside = [](double t, double low, double high) {
        return t >= low - border_tolerance && t <= high + border_tolerance;
    };
    if (!inside(position.u, u_start_, u_end_) || !inside(position.v, v_.front(), v_.back())) return false;
    if (missing_.empty()) return true;
    const double rows = (position.u - u_start_) * per_increment_;
    const std::size_t i = index_of(rows, line_.size() - 2), j = column_of(position.v), k = i * v_.size() + j;
    const double a = rows - static_cast<double>(i), b = (position.v - v_[j]) * per_gap_[j];
    const auto counts = [](double weight) { return weight > 1e-9; };  // contributes to the interpolation
    const bool here = counts(1 - a), next = counts(a), right = counts(1 - b), left = counts(b);
    return !((here && right && missing_[k]) || (here && left && missing_[k + 1]) ||
             (next && right && missing_[k + v_.size()]) || (next && left && missing_[k + v_.size() + 1]));
}

CrgPoint CrgRoad::xy_of(double u, double v) const {
    const double rows = (u - u_start_) * per_increment_;
    const std::size_t i = index_of(rows, line_.size() - 2);
    const CrgPoint &from = line_[i], &to = line_[i + 1];
    const double ex = to.x - from.x, ey = to.y - from.y, length = std::sqrt(ex * ex + ey * ey);
    const double part = rows - static_cast<double>(i);
    if (part < 0 || part > 1) {
        const CrgPoint& end = part < 0 ? from : to;
        const double beyond = part < 0 ? u - u_start_ : u - u_end_;
        return {end.x + (beyond * ex - v * ey) / length, end.y + (beyond * ey + v * ex) / length};
    }
    // A point of a cross section at the distance v from the line of the segment.
    const auto on_section = [&](const CrgPoint& at, const CrgPoint& n) {
        const double scale = v * length / (n.x * ex + n.y * ey);
        return CrgPoint{at.x - scale * n.y, at.y + scale * n.x};
    };
    const CrgPoint a = on_section(from, across(i)), b = on_section(to, across(i + 1));
    return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

}  // namespace hamilcar
