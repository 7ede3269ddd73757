// Everything that is integrated, and nothing else: one flat vector, trivially copyable, whose numbers state_layout.hpp names.
// The chart (chart.hpp) defines orientation and momentum; `work` is the integral of the nonconservative power, so that the
// energy balance can be checked at any time.
#pragma once

#include <algorithm>
#include <array>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

template <class T>
struct State {
    static constexpr int chassis_size = hamilcar::chassis_size;
    std::array<T, state_capacity> values{};  // a vehicle uses the first `state_size` of them

    auto position() { return Eigen::Map<Vec3<T>>(values.data()); }
    auto position() const { return Eigen::Map<const Vec3<T>>(values.data()); }
    auto orientation() { return Eigen::Map<Vector<T, 4>>(values.data() + 3); }
    auto orientation() const { return Eigen::Map<const Vector<T, 4>>(values.data() + 3); }
    auto momentum() { return Eigen::Map<Spatial<T>>(values.data() + 7); }
    auto momentum() const { return Eigen::Map<const Spatial<T>>(values.data() + 7); }
    T& work() { return values[13]; }
    const T& work() const { return values[13]; }
};

// Copies the first `size` numbers.
template <class T>
void copy_state(const State<T>& from, int size, State<T>& to) {
    HAMILCAR_ASSERT(size <= state_capacity);
    std::copy_n(from.values.begin(), size, to.values.begin());
}

}  // namespace hamilcar
