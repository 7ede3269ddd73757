// A measured surface: heights at the nodes of a grid with Catmull-Rom cubics between them along x and y, which interpolate the
// nodes with continuous slopes. The slope normal to an edge is zero there, and the surface continues level outside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hamilcar/description/road.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

struct HeightGrid {
    double x = 0, y = 0;          // of the first node [m]
    double per_x = 1, per_y = 1;  // nodes per meter [1/m]
    std::size_t rows = 0, columns = 0;
    std::vector<double> heights;  // one row after the other [m]

    HeightGrid() = default;
    explicit HeightGrid(const HeightGridDescription& d)
        : x(d.x),
          y(d.y),
          per_x(1 / d.spacing_x),
          per_y(1 / d.spacing_y),
          rows(d.rows),
          columns(d.columns),
          heights(d.heights) {}

    template <class N>
    N height(const N& at_x, const N& at_y) const {
        if (heights.empty()) return N(0);
        const auto along = stencil(N((at_x - N(x)) * N(per_x)), columns);
        const auto across = stencil(N((at_y - N(y)) * N(per_y)), rows);
        N sum(0);
        for (std::size_t i = 0; i < 4; ++i) {
            const double* row = heights.data() + across.node[i] * columns;
            N in_row(0);
            for (std::size_t j = 0; j < 4; ++j) in_row += along.weight[j] * N(row[along.node[j]]);
            sum += across.weight[i] * in_row;
        }
        return sum;
    }
    // Upper bound on all heights [m]: between nodes a cubic overshoots by at most a quarter along x, and again along y.
    double max_height() const {
        double max_node = 0;
        for (const double node : heights) max_node = std::max(max_node, std::abs(node));
        return 1.25 * 1.25 * max_node;
    }

private:
    template <class N>
    struct Stencil {
        std::array<std::size_t, 4> node;
        std::array<N, 4> weight;
    };

    // The nodes around a position in node units, mirrored at the edges, which makes the surface level there.
    template <class N>
    static Stencil<N> stencil(const N& position, std::size_t count) {
        const double at = value_of(position), end = static_cast<double>(count - 1);
        std::size_t cell = 0;
        N u(0);
        if (at >= end) {
            cell = count - 1;
        } else if (at > 0) {
            cell = static_cast<std::size_t>(at);
            u = position - N(static_cast<double>(cell));
        }
        const auto mirrored = [&](std::size_t node) {
            return node < count ? node : count < 2 ? 0 : 2 * count - 2 - node;
        };
        const std::size_t before = cell > 0 ? cell - 1 : mirrored(1);
        const N v = N(1) - u;
        return {{before, cell, mirrored(cell + 1), cell + 1 < count ? mirrored(cell + 2) : cell},
                {N(-0.5) * u * v * v, v * (N(1) + u * (N(1) - N(1.5) * u)), u * (N(1) + v * (N(1) - N(1.5) * v)),
                 N(-0.5) * u * u * v}};
    }
};

}  // namespace hamilcar
