// The one door to Eigen: fixed-size matrices without its own vectorizer, so that a plain number and one that
// records do the same operations in the same order.
#pragma once

#ifndef EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_VECTORIZE
#endif
// Nor its alignment: no type's layout depends on what the compiler may use.
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

// What Eigen wants to know of a number of ours that computes as an Element does.
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
