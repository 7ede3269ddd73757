// Everything that is integrated, and nothing else: one flat row of numbers with names, trivially copyable.
//
//   hub    position r (3), orientation (4), momentum (6), work (1)
//   spoke  independent V, dependent W, momentum P_V, spin momentum p_s, tire deflections u and v, brake wind-up
// The meaning of orientation and momentum is the chart's (chart.hpp); `work` is what left and entered as non-conservative
// power, integrated along so that the energy balance can be checked at any time.
#pragma once

#include <array>

#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

// One spoke's share of a state; pointers into the row.
template <class Number>
struct SpokeState {
    Number *independent, *dependent, *momentum;  // V [m, rad], W [rad], P_V
    Number& spin_momentum;                       // p_s [kg m^2/s]
    Number &deflection_x, &deflection_y;         // u, v [m]
    Number& brake_windup;                        // b [rad]
};

template <class T>
struct State {
    static constexpr int hub_size = 14;
    static constexpr int spoke_size = 2 * max_independent + max_dependent + 4;
    std::array<T, hub_size + max_spokes * spoke_size> values{};

    // Numbers in use by a car with that many spokes: a prefix of `values`.
    static constexpr int size(int spokes) { return hub_size + spokes * spoke_size; }

    auto position() { return Eigen::Map<Vec3<T>>(values.data()); }
    auto position() const { return Eigen::Map<const Vec3<T>>(values.data()); }
    auto orientation() { return Eigen::Map<Vector<T, 4>>(values.data() + 3); }
    auto orientation() const { return Eigen::Map<const Vector<T, 4>>(values.data() + 3); }
    auto momentum() { return Eigen::Map<Spatial<T>>(values.data() + 7); }
    auto momentum() const { return Eigen::Map<const Spatial<T>>(values.data() + 7); }
    T& work() { return values[13]; }
    const T& work() const { return values[13]; }
    SpokeState<T> spoke(int i) { return view(values.data() + hub_size + i * spoke_size); }
    SpokeState<const T> spoke(int i) const { return view(values.data() + hub_size + i * spoke_size); }

private:
    template <class Number>
    static SpokeState<Number> view(Number* at) {
        constexpr int V = max_independent, W = max_dependent;
        Number* wheel = at + 2 * V + W;
        return {at, at + V, at + V + W, wheel[0], wheel[1], wheel[2], wheel[3]};
    }
};

}  // namespace hamilcar
