// Uneven ground in a recorded step: a call of the program, which looks a wheel's ground up in each lane.
#pragma once

#include "hamilcar/math/traced.hpp"
#include "hamilcar/road/ground.hpp"

namespace hamilcar {

// What a run gives the calls: the surface of each lane, null where it is none, and the time [s].
struct GroundBelowLanes {
    const Surface* const* surfaces;
    double time;
};

// The function of such a call, for E double or float; `wheel` is the wheel's number, `context` a GroundBelowLanes.
template <class E>
void look_ground_up(const void* context, int wheel, int lanes, const void* arguments, void* results) {
    const auto& below = *static_cast<const GroundBelowLanes*>(context);
    for (int lane = 0; lane < lanes; ++lane) {
        const E* argument = static_cast<const E*>(arguments) + lane;
        PatchPlace<double> place;
        PatchPlace<double>::for_each(place, [&](double& number) { number = *argument, argument += lanes; });
        PatchPlane<double> plane;
        if (below.surfaces[lane]) plane = below.surfaces[lane]->under(place, wheel, below.time);
        E* result = static_cast<E*>(results) + lane;
        PatchPlane<double>::for_each(plane, [&](double number) { *result = static_cast<E>(number), result += lanes; });
    }
}

// A call for each of the wheels side by side.
template <class E, int width>
PatchPlane<Traced<E, width>> ask_surface(const Surface*, double, const PatchPlace<Traced<E, width>>& place,
                                         const std::array<int, 2>& numbers) {
    using T = Traced<E, width>;
    PatchPlane<T> plane;
    for (int l = 0; l < width; ++l) {
        std::vector<program::Id> arguments;
        PatchPlace<T>::for_each(place, [&](const T& number) { arguments.push_back(lane(number, l).id()); });
        program::Id result =
            Tracing::graph().call(0, numbers[static_cast<std::size_t>(l)], arguments, PatchPlane<T>::count);
        PatchPlane<T>::for_each(plane, [&](T& number) { set_lane(number, l, Traced<E>::of(result++)); });
    }
    return plane;
}

}  // namespace hamilcar
