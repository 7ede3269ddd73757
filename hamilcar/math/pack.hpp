// Lets packs of lanes into Eigen's matrices.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/pack.hpp"

template <class T, int N>
struct Eigen::NumTraits<hamilcar::Pack<T, N>> : hamilcar::NumberTraits<hamilcar::Pack<T, N>, T> {};
