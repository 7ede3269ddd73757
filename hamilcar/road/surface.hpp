// The uneven surface on the plane of a road: heights above it and friction factors over ground x and y. A sum of elements, each in
// its own file; stored as doubles, whatever scalar the car is computed in.
#pragma once

#include <concepts>
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

// A large table shared by many surfaces, with its description.
template <class Road, class Description>
struct SharedRoad {
    std::shared_ptr<const Road> road;
    std::shared_ptr<const Description> description;

    template <class N>
    N height(const N& x, const N& y) const {
        return road->height(x, y);
    }
    double max_height() const { return road->max_height(); }
};

using SurfaceElement = std::variant<Obstacle, Wave, RandomRoad, SharedRoad<HeightGrid, HeightGridDescription>,
                                    SharedRoad<CrgRoad, CrgDescription>>;

// Heights of an element above the plane over ground x and y, for numbers with and without derivatives and for several at once, and
// a bound on them [m].
template <class Element>
concept RoadElement = requires(const Element element, const double& x, const Dual<double, 2>& dual) {
    { element.height(x, x) } -> std::same_as<double>;
    { element.height(dual, dual) } -> std::same_as<Dual<double, 2>>;
    { element.max_height() } -> std::same_as<double>;
};
static_assert(every_alternative(std::type_identity<SurfaceElement>(),
                                []<class Element>() { return RoadElement<Element>; }));

class Surface {
public:
    Surface() = default;
    explicit Surface(const RoadDescription& description);

    // Above the plane, upward along ground z [m].
    template <class N>
    N height(const N& x, const N& y) const {
        N sum(0);
        for (const SurfaceElement& element : elements_) {
            dispatch(element, [&](const auto& one) { sum += one.height(x, y); });
        }
        return sum;
    }
    // The plane that best fits it under a patch, including the lift of the post under that wheel.
    template <class T>
    PatchPlane<T> under(const PatchPose<T>& place, int wheel, double time) const {
        if (value_of(place.clearance) > max_height_) return {};
        const PatchLines<T> lines(place);
        PatchSums<T> sums;
        for (const SurfaceElement& element : elements_) {
            dispatch(element, [&](const auto& one) {
                if constexpr (requires { one.add_to(sums, lines); }) {
                    one.add_to(sums, lines);
                } else {
                    for (std::size_t i = 0; i < Patch::count; ++i) sums.add(i, one, lines.at(i));
                }
            });
        }
        PatchPlane<T> plane = sums.plane(place.radius);
        const SignalValue<double> lift = post(wheel, time);
        plane.height += T(lift.value), plane.height_rate += T(lift.rate);
        if (has_patches()) plane.friction = T(friction(lines));
        return plane;
    }
    // Upper bound on all heights; infinite for OpenCRG roads [m].
    double max_height() const { return max_height_; }
    bool has_patches() const { return !patches_.empty(); }
    // Factor on the tire's friction, excluding that of the plane [1].
    double friction(double x, double y) const {
        double factor = 1;
        for (const FrictionPatch& patch : patches_) factor *= 1 + (patch.friction - 1) * patch.weight(x, y);
        return factor;
    }
    template <class T>
    double friction(const PatchLines<T>& lines) const {
        double sum = 0;
        for (std::size_t i = 0; i < Patch::count; ++i) {
            const PatchPoints<T> points = lines.at(i);
            for (const int k : {0, 1}) {
                sum += 0.5 * Patch::weights[i] * friction(value_of(points.x[k]), value_of(points.y[k]));
            }
        }
        return sum;
    }
    // Height and rate of the post under a wheel [m, m/s].
    SignalValue<double> post(int wheel, double time) const {
        if (wheel >= static_cast<int>(posts_.size())) return {};
        return posts_[static_cast<std::size_t>(wheel)].at(time);
    }

private:
    std::vector<SurfaceElement> elements_;
    std::vector<FrictionPatch> patches_;
    std::vector<Signal> posts_;
    double max_height_ = 0;
};

// Null for a plane road.
std::shared_ptr<const Surface> make_surface(const RoadDescription& description);

}  // namespace hamilcar
