#include <algorithm>
#include <cmath>

#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

const std::vector<const Recipe*>& recipes() {
    static const std::vector<const Recipe*> all{
        &macpherson_recipe,   &double_wishbone_recipe, &five_link_recipe,    &semi_trailing_arm_recipe,
        &trailing_arm_recipe, &swing_axle_recipe,      &h_arm_recipe,        &integral_link_recipe,
        &twist_beam_recipe,   &four_link_axle_recipe,  &panhard_axle_recipe, &watt_axle_recipe,
        &leaf_axle_recipe};
    return all;
}

const Recipe* find_recipe(std::string_view keyword) {
    const auto found = std::ranges::find(recipes(), keyword, &Recipe::keyword);
    return found == recipes().end() ? nullptr : *found;
}

double distance(const Point& a, const Point& b) {
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point direction_between(const Point& a, const Point& b) {
    const double length = distance(a, b);
    return {(b[0] - a[0]) / length, (b[1] - a[1]) / length, (b[2] - a[2]) / length};
}

std::array<Point, 2> link_axes(const Point& inner, const Point& outer) {
    const Point along = direction_between(inner, outer);
    const bool upright = std::abs(along[2]) > 0.9;
    const Point level =
        upright ? Point{0, along[2], -along[1]} : Point{along[1], -along[0], 0};  // along x x, or along x z
    const Point lifting = direction_between({0, 0, 0}, level);
    return {lifting, cross(along, lifting)};
}

}  // namespace hamilcar
