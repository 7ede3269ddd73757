// Finds the stretch of the reference line that is nearest to a point. The plane around the road is divided into square cells,
// each with a list of the few stretches that may be nearest to one of its points. Without a cell, far from the road or where
// many stretches crowd, a tree of boxes is searched, so that no query visits the whole road.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

struct CrgPoint {
    double x, y;  // ground axes [m]
};

class CrgSearch {
public:
    CrgSearch() = default;
    // Stretches of `samples` segments each; cells within `margin` of the line [m].
    CrgSearch(const std::vector<CrgPoint>& line, std::size_t samples, double margin);

    std::size_t nearest(double x, double y) const {
        const Cell* cell = find(x * per_edge_, y * per_edge_);
        if (cell == nullptr) return nearest_of_all(x, y);
        std::size_t best = near_[cell->first];
        double min_square = squared_distance(stretches_[best], x, y);
        for (std::uint32_t k = 1; k < cell->count; ++k) {
            const std::uint32_t i = near_[cell->first + k];
            const double d = squared_distance(stretches_[i], x, y);
            if (d < min_square) min_square = d, best = i;
        }
        return best;
    }

private:
    struct Stretch {
        double x, y, dx, dy, scale;  // chord from (x, y), and one over its squared length, or zero
    };
    struct Box {
        double x_low, y_low, x_high, y_high;
    };
    struct Cell {
        std::int32_t x, y;
        std::uint32_t first, count;  // in `near_`; count 0: a free slot
    };

    static double outside(double x, double low, double high) { return x < low ? low - x : x > high ? x - high : 0; }
    static double squared_distance(const Box& b, double x, double y) {
        const double dx = outside(x, b.x_low, b.x_high), dy = outside(y, b.y_low, b.y_high);
        return dx * dx + dy * dy;
    }
    static double squared_distance(const Stretch& s, double x, double y) {
        const double t = min(max(((x - s.x) * s.dx + (y - s.y) * s.dy) * s.scale, 0.0), 1.0);
        const double rx = x - s.x - t * s.dx, ry = y - s.y - t * s.dy;
        return rx * rx + ry * ry;
    }
    static std::int32_t floor_of(double x) {
        const auto whole = static_cast<std::int32_t>(x);
        return whole - (x < whole ? 1 : 0);
    }
    std::size_t slot_of(std::int32_t x, std::int32_t y) const {
        const std::uint64_t key = std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y);
        return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15U) >> 32) & (cells_.size() - 1);
    }

    // The cell that contains a point in units of edges; null out of the range of cell indices, and for NaN.
    const Cell* find(double x, double y) const {
        constexpr double limit = 1e9;
        if (cells_.empty() || !(x > -limit && x < limit && y > -limit && y < limit)) return nullptr;
        const std::int32_t i = floor_of(x), j = floor_of(y);
        for (std::size_t slot = slot_of(i, j); cells_[slot].count != 0; slot = (slot + 1) & (cells_.size() - 1))
            if (cells_[slot].x == i && cells_[slot].y == j) return &cells_[slot];
        return nullptr;
    }

    std::size_t nearest_of_all(double x, double y) const {
        std::array<std::size_t, 64> open;  // at most one node per level, plus one
        std::size_t count = 0, best = 0;
        double min_square = std::numeric_limits<double>::infinity();
        const std::size_t leaves = boxes_.size() / 2;
        open[count++] = 1;
        while (count > 0) {
            const std::size_t node = open[--count];
            if (!(squared_distance(boxes_[node], x, y) < min_square)) continue;
            if (node >= leaves) {
                const double d = squared_distance(stretches_[node - leaves], x, y);
                if (d < min_square) min_square = d, best = node - leaves;
                continue;
            }
            const std::size_t left = 2 * node, right = left + 1;
            const bool left_first = squared_distance(boxes_[left], x, y) <= squared_distance(boxes_[right], x, y);
            open[count++] = left_first ? right : left;
            open[count++] = left_first ? left : right;
        }
        return best;
    }

    void build_tree(const std::vector<CrgPoint>& line, std::size_t samples);
    using CellNumbers = std::vector<std::array<std::int32_t, 2>>;
    CellNumbers cells_within(double margin);
    std::uint32_t list_nearest(double x, double y, double diagonal);

    std::vector<Stretch> stretches_;
    std::vector<Box> boxes_;           // a heap with root 1; the second half are the stretches' boxes
    std::vector<Cell> cells_;          // open addressing, a power of two with free slots
    std::vector<std::uint32_t> near_;  // stretches, cell by cell
    double per_edge_ = 0;              // [1/m]
};

}  // namespace hamilcar
