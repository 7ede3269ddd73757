// Uneven ground in a recorded step: a call of the program, which looks up the ground under a wheel in each lane.
#pragma once

#include "hamilcar/math/traced.hpp"
#include "hamilcar/road/ground.hpp"

namespace hamilcar {

// Context of the calls: the surface of each lane, null for a plane road, and its time, `ahead` of which the step now is [s].
struct LaneSurfaces {
    const Surface* const* surfaces;
    const double* times;
    double ahead;
};

// The function of such a call, for E double or float; `wheel` is the wheel's index, `context` a LaneSurfaces.
template <class E>
void look_up_ground(const void* context, int wheel, int lanes, const void* arguments, void* results) {
    const auto& below = *static_cast<const LaneSurfaces*>(context);
    for (int lane = 0; lane < lanes; ++lane) {
        const E* argument = static_cast<const E*>(arguments) + lane;
        PatchPose<double> place;
        PatchPose<double>::for_each(place, [&](double& number) { number = *argument, argument += lanes; });
        PatchPlane<double> plane;
        if (below.surfaces[lane]) plane = below.surfaces[lane]->under(place, wheel, below.times[lane] + below.ahead);
        E* result = static_cast<E*>(results) + lane;
        PatchPlane<double>::for_each(plane, [&](double number) { *result = static_cast<E>(number), result += lanes; });
    }
}

// Derivatives of the same: with tangents of the arguments behind them those of the results; with adjoints of the results behind the arguments
// those of the arguments. A surface is a table: by differences.
void ground_tangents(const void* context, int wheel, int lanes, const void* arguments, void* results);
void ground_adjoints(const void* context, int wheel, int lanes, const void* arguments, void* results);

// One call for each of the wheels side by side.
template <int width>
PatchPlane<Traced<width>> query_surface(const Surface*, double, const PatchPose<Traced<width>>& place,
                                        const std::array<int, 2>& numbers) {
    using T = Traced<width>;
    PatchPlane<T> plane;
    for (int l = 0; l < width; ++l) {
        std::vector<program::Id> arguments;
        PatchPose<T>::for_each(place, [&](const T& number) { arguments.push_back(lane(number, l).id()); });
        program::Id result =
            Tracing::graph().call(0, numbers[static_cast<std::size_t>(l)], arguments, PatchPlane<T>::count);
        PatchPlane<T>::for_each(plane, [&](T& number) { set_lane(number, l, Traced<1>::of(result++)); });
    }
    return plane;
}

}  // namespace hamilcar
