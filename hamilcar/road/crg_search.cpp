// The tree is built first, since it determines which stretches each cell has to store.
#include "hamilcar/road/crg_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hamilcar {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

CrgSearch::CrgSearch(const std::vector<CrgPoint>& line, std::size_t samples, double margin) {
    build_tree(line, samples);
    const CellNumbers numbers = cells_within(margin);
    std::vector<Cell> found;
    for (const auto& [x, y] : numbers) {
        const auto first = static_cast<std::uint32_t>(near_.size());
        const std::uint32_t count =
            list_nearest((x + 0.5) / per_edge_, (y + 0.5) / per_edge_, std::sqrt(2.0) / per_edge_);
        if (count > 0) found.push_back({x, y, first, count});
    }
    cells_.assign(std::bit_ceil(2 * found.size() + 1), Cell{0, 0, 0, 0});
    for (const Cell& cell : found) {
        std::size_t slot = slot_of(cell.x, cell.y);
        while (cells_[slot].count != 0) slot = (slot + 1) & (cells_.size() - 1);
        cells_[slot] = cell;
    }
}

void CrgSearch::build_tree(const std::vector<CrgPoint>& line, std::size_t samples) {
    const std::size_t last = line.size() - 1;
    for (std::size_t i = 0; i < last; i += samples) {
        const CrgPoint &from = line[i], &to = line[std::min(i + samples, last)];
        const double dx = to.x - from.x, dy = to.y - from.y, square = dx * dx + dy * dy;
        stretches_.push_back({from.x, from.y, dx, dy, square > 0 ? 1 / square : 0});
    }
    const std::size_t leaves = std::bit_ceil(stretches_.size());
    boxes_.assign(2 * leaves, Box{infinity, infinity, -infinity, -infinity});
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
        const Stretch& s = stretches_[i];
        boxes_[leaves + i] = {std::min(s.x, s.x + s.dx), std::min(s.y, s.y + s.dy), std::max(s.x, s.x + s.dx),
                              std::max(s.y, s.y + s.dy)};
    }
    for (std::size_t node = leaves; node-- > 1;) {
        const Box &a = boxes_[2 * node], &b = boxes_[2 * node + 1];
        boxes_[node] = {std::min(a.x_low, b.x_low), std::min(a.y_low, b.y_low), std::max(a.x_high, b.x_high),
                        std::max(a.y_high, b.y_high)};
    }
}

// The indices of the cells within `margin` of any stretch. Edges of 8 m, doubled until the number of cells and their indices
// are within bounds.
CrgSearch::CellNumbers CrgSearch::cells_within(double margin) {
    constexpr double max_cells = 1 << 20, max_number = 5e8;
    const std::size_t leaves = boxes_.size() / 2;
    const auto numbers = [&](double edge) {
        double sum = 0;
        for (std::size_t i = 0; i < stretches_.size(); ++i) {
            const Box& b = boxes_[leaves + i];
            sum += ((b.x_high - b.x_low + 2 * margin) / edge + 2) * ((b.y_high - b.y_low + 2 * margin) / edge + 2);
        }
        return sum;
    };
    const Box& all = boxes_[1];
    const double extent = margin + std::max(std::max(-all.x_low, all.x_high), std::max(-all.y_low, all.y_high));
    double edge = 8;
    while (extent / edge > max_number || numbers(edge) > max_cells) edge *= 2;
    per_edge_ = 1 / edge;

    CellNumbers cells;
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
        const Box& b = boxes_[leaves + i];
        const auto number = [&](double x) { return static_cast<std::int32_t>(std::floor(x / edge)); };
        for (std::int32_t x = number(b.x_low - margin); x <= number(b.x_high + margin); ++x)
            for (std::int32_t y = number(b.y_low - margin); y <= number(b.y_high + margin); ++y)
                cells.push_back({x, y});
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

// Adds to `near_` the stretches that may be the nearest to a point of a cell: those whose distance from its center exceeds the
// smallest one by at most the diagonal. Returns their number, or 0 if they are too many for a list.
std::uint32_t CrgSearch::list_nearest(double x, double y, double diagonal) {
    constexpr std::size_t max_count = 32;
    const double nearest = std::sqrt(squared_distance(stretches_[nearest_of_all(x, y)], x, y));
    const double square = (nearest + diagonal) * (nearest + diagonal);
    const std::size_t leaves = boxes_.size() / 2, first = near_.size();
    std::vector<std::size_t> open{1};
    while (!open.empty() && near_.size() - first <= max_count) {
        const std::size_t node = open.back();
        open.pop_back();
        if (!(squared_distance(boxes_[node], x, y) <= square)) continue;
        if (node < leaves) {
            open.push_back(2 * node + 1);
            open.push_back(2 * node);
        } else if (squared_distance(stretches_[node - leaves], x, y) <= square) {
            near_.push_back(static_cast<std::uint32_t>(node - leaves));
        }
    }
    if (near_.size() - first > max_count) near_.resize(first);
    return static_cast<std::uint32_t>(near_.size() - first);
}

}  // namespace hamilcar
