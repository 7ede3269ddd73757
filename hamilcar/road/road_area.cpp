#include "hamilcar/road/road_area.hpp"

#include <algorithm>

#include "hamilcar/road/shared_table.hpp"

namespace hamilcar {

RoadArea::RoadArea(const RoadDescription& d)
    : grid_(d.grid), crg_(d.crg), road_(d.crg ? shared_table<CrgRoad>(d.crg) : nullptr) {}

double RoadArea::outside(double x, double y) const {
    double farthest = 0;
    const auto include = [&](double at, double first, double last) {
        farthest = std::max({farthest, first - at, at - last});
    };
    if (grid_) {
        const auto length = [](std::size_t nodes, double spacing) { return static_cast<double>(nodes - 1) * spacing; };
        include(x, grid_->x, grid_->x + length(grid_->columns, grid_->spacing_x));
        include(y, grid_->y, grid_->y + length(grid_->rows, grid_->spacing_y));
    }
    if (crg_) {
        const auto ends = [](CrgBorder border) { return border != CrgBorder::repeat && border != CrgBorder::reflect; };
        const CrgRoad::Position<double> at = road_->uv_of(x, y);
        if (ends(crg_->border_u)) include(at.u, crg_->u_start, crg_->u_end());
        if (ends(crg_->border_v)) include(at.v, crg_->v.front(), crg_->v.back());
    }
    return farthest;
}

}  // namespace hamilcar
