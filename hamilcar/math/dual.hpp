// Lets Eigen use dual numbers as scalars.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/dual.hpp"

template <class T, int N>
struct Eigen::NumTraits<hamilcar::Dual<T, N>> : hamilcar::NumberTraits<hamilcar::Dual<T, N>, T> {};
