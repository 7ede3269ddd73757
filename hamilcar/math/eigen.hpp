// The only include of Eigen: fixed-size matrices without its vectorizer, so that plain and recording numbers perform the same
// operations in the same order.
#pragma once

#ifndef EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_VECTORIZE
#endif
// Without its alignment, so that no type's layout depends on compiler flags.
#ifndef EIGEN_MAX_STATIC_ALIGN_BYTES
#define EIGEN_MAX_STATIC_ALIGN_BYTES 0
#endif
#ifndef EIGEN_MPL2_ONLY
#define EIGEN_MPL2_ONLY
#endif

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <type_traits>

namespace hamilcar {

template <class T, int Rows, int Columns>
using Matrix = Eigen::Matrix<T, Rows, Columns>;
template <class T, int Rows>
using Vector = Eigen::Matrix<T, Rows, 1>;
template <class T>
using Vec3 = Vector<T, 3>;
template <class T>
using Mat3 = Matrix<T, 3, 3>;

// Eigen's traits of a custom scalar that computes like an Element.
template <class Number, class Element>
struct NumberTraits : Eigen::NumTraits<Element> {
    using Real = Number;
    using NonInteger = Number;
    using Nested = Number;
    using Literal = Number;
    enum { RequireInitialization = !std::is_trivially_default_constructible_v<Number> };
    enum { ReadCost = 1, AddCost = 1, MulCost = 1 };
};

}  // namespace hamilcar
