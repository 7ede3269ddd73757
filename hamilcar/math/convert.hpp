// From a description's plain numbers to vectors of any scalar.
#pragma once

#include <array>

#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

inline Vec3<double> vec3(const std::array<double, 3>& a) {
    return {a[0], a[1], a[2]};
}

template <class T>
Vec3<T> as(const Vec3<double>& v) {
    return {T(v[0]), T(v[1]), T(v[2])};
}

}  // namespace hamilcar
