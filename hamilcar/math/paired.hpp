// Two suspensions of one type side by side in one number: the left and the right wheel of an axle cost little more than one, and
// each lane computes what the suspension alone would, bit for bit.
#pragma once

#include <array>

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/math/traced.hpp"

namespace hamilcar {

// The number that holds two, which exists only for the recording number.
template <class T>
struct PairedNumber {
    using type = T;
};
template <>
struct PairedNumber<Traced<1>> {
    using type = Traced<2>;
};
template <class T>
using Paired = typename PairedNumber<T>::type;
template <class T>
inline constexpr bool has_pairs = !std::is_same_v<Paired<T>, T>;

// The same value in both lanes.
template <class S, class T, int rows, int columns>
Matrix<S, rows, columns> in_both(const Matrix<T, rows, columns>& same) {
    Matrix<S, rows, columns> out;
    for (int i = 0; i < rows * columns; ++i) out.data()[i] = S(same.data()[i]);
    return out;
}

// Two numbers, or matrices, in one.
template <class S, class T>
S side_by_side(const T& left, const T& right) {
    return S(std::array{left, right});
}
template <class S, class T, int rows, int columns>
Matrix<S, rows, columns> side_by_side(const Matrix<T, rows, columns>& left, const Matrix<T, rows, columns>& right) {
    Matrix<S, rows, columns> out;
    for (int i = 0; i < rows * columns; ++i) out.data()[i] = side_by_side<S>(left.data()[i], right.data()[i]);
    return out;
}

// Extracts one of the two lanes.
template <class T, class S>
void unpack(const S& from, int index, T& to) {
    if constexpr (requires { from.size(); }) {
        for (int i = 0; i < static_cast<int>(from.size()); ++i) unpack(from.data()[i], index, to.data()[i]);
    } else {
        to = lane(from, index);
    }
}

}  // namespace hamilcar
