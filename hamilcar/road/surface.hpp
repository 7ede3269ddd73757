// Everything that stands on the plane of a road, as heights above it and factors of friction over ground x and y. A sum of
// elements, each in a file of its own; all in plain numbers, whatever the car is computed in.
#pragma once

#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "hamilcar/description/road.hpp"
#include "hamilcar/math/signal.hpp"
#include "hamilcar/road/crg_road.hpp"
#include "hamilcar/road/friction_patch.hpp"
#include "hamilcar/road/height_grid.hpp"
#include "hamilcar/road/obstacle.hpp"
#include "hamilcar/road/random_road.hpp"
#include "hamilcar/road/wave.hpp"
#include "hamilcar/scalar/dispatch.hpp"

namespace hamilcar {

// A large table that many surfaces have in common, with the description that it was made of.
template <class Road, class Description>
struct Shared {
    std::shared_ptr<const Road> road;
    std::shared_ptr<const Description> description;

    template <class N>
    N height(const N& x, const N& y) const {
        return road->height(x, y);
    }
    double highest() const { return road->highest(); }
};

using SurfaceElement = std::variant<Obstacle, Wave, RandomRoad, Shared<HeightGrid, HeightGridDescription>,
                                    Shared<CrgRoad, CrgDescription>>;

class Surface {
public:
    Surface() = default;
    explicit Surface(const RoadDescription& description);

    // Above the plane, upward along ground z, at several points [m].
    template <class N, std::size_t count>
    std::array<N, count> heights(const std::array<N, count>& x, const std::array<N, count>& y) const {
        std::array<N, count> sum;
        sum.fill(N(0));
        for (const SurfaceElement& element : elements_) {
            dispatch(element, [&](const auto& one) {
                for (std::size_t i = 0; i < count; ++i) sum[i] += one.height(x[i], y[i]);
            });
        }
        return sum;
    }
    template <class N>
    N height(const N& x, const N& y) const {
        return heights<N, 1>({x}, {y})[0];
    }
    // No height is above it; of measured roads nobody knows [m].
    double highest() const { return highest_; }
    bool has_patches() const { return !patches_.empty(); }
    // Factor on the tire's friction, without the plane's own [1].
    double friction(double x, double y) const {
        double factor = 1;
        for (const FrictionPatch& patch : patches_) factor *= 1 + (patch.friction - 1) * patch.weight(x, y);
        return factor;
    }
    // Height and rate of the post under a wheel, by its number [m, m/s].
    SignalValue<double> post(int wheel, double time) const {
        if (wheel >= static_cast<int>(posts_.size())) return {};
        return posts_[static_cast<std::size_t>(wheel)].at(time);
    }

private:
    std::vector<SurfaceElement> elements_;
    std::vector<FrictionPatch> patches_;
    std::vector<Signal> posts_;
    double highest_ = 0;
};

// Null for a road that is nothing but a plane.
std::shared_ptr<const Surface> make_surface(const RoadDescription& description);

}  // namespace hamilcar
