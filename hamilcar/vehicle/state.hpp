// Everything that is integrated, and nothing else: one flat row of numbers with names, trivially copyable.
//
//   hub    position r (3), orientation (4), momentum (6), work (1)
//   spoke  independent V, dependent W, momentum P_V, spin momentum p_s, tire deflections u and v, brake wind-up
//   then suspensions composed of parts, and trailers (composed.hpp)
// The meaning of orientation and momentum is the chart's (chart.hpp); `work` is what left and entered as non-conservative
// power, integrated along so that the energy balance can be checked at any time.
#pragma once

#include <algorithm>
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

template <class Number>
SpokeState<Number> spoke_view(Number* at) {
    constexpr int V = max_independent, W = max_dependent;
    Number* wheel = at + 2 * V + W;
    return {at, at + V, at + V + W, wheel[0], wheel[1], wheel[2], wheel[3]};
}

template <class T>
struct State {
    static constexpr int hub_size = hamilcar::hub_size;
    std::array<T, state_capacity> values{};  // a vehicle uses the first `state_size` of them

    auto position() { return Eigen::Map<Vec3<T>>(values.data()); }
    auto position() const { return Eigen::Map<const Vec3<T>>(values.data()); }
    auto orientation() { return Eigen::Map<Vector<T, 4>>(values.data() + 3); }
    auto orientation() const { return Eigen::Map<const Vector<T, 4>>(values.data() + 3); }
    auto momentum() { return Eigen::Map<Spatial<T>>(values.data() + 7); }
    auto momentum() const { return Eigen::Map<const Spatial<T>>(values.data() + 7); }
    T& work() { return values[13]; }
    const T& work() const { return values[13]; }
    SpokeState<T> spoke(int i) { return spoke_view(values.data() + hub_size + i * spoke_size); }
    SpokeState<const T> spoke(int i) const { return spoke_view(values.data() + hub_size + i * spoke_size); }
};

// The numbers of a vehicle, from one state to another.
template <class T>
void copy_state(const State<T>& from, int size, State<T>& to) {
    std::copy_n(from.values.begin(), size, to.values.begin());
}

// The shares of spokes abreast, number by number.
template <class S>
using RowState = std::array<S, spoke_size>;

template <class S>
SpokeState<const S> spoke_view(const RowState<S>& row) {
    return spoke_view(row.data());
}

// The numbers of a row, side by side.
template <class S, class T>
RowState<S> gather_row(const State<T>& state, const RowIndex& index) {
    constexpr std::size_t width = row_width<S, T>;
    const T* from[width];
    for (std::size_t i = 0; i < width; ++i) from[i] = state.values.data() + State<T>::hub_size + index[i] * spoke_size;
    RowState<S> out;
    for (std::size_t k = 0; k < out.size(); ++k) {
        if constexpr (width == 1) {
            out[k] = from[0][k];
        } else {
            std::array<T, width> numbers;
            for (std::size_t i = 0; i < width; ++i) numbers[i] = from[i][k];
            out[k] = S(numbers);
        }
    }
    return out;
}

template <class S, class T>
void scatter_row(const RowState<S>& numbers, const RowIndex& index, int count, State<T>& state) {
    for (int i = 0; i < count; ++i) {
        T* to = state.values.data() + State<T>::hub_size + index[static_cast<std::size_t>(i)] * spoke_size;
        for (std::size_t k = 0; k < numbers.size(); ++k) to[k] = at_place<T>(numbers[k], i);
    }
}

}  // namespace hamilcar
