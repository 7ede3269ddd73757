// Lets Eigen use the recording number as a scalar.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/traced.hpp"

template <class E, int width>
struct Eigen::NumTraits<hamilcar::Traced<E, width>> : hamilcar::NumberTraits<hamilcar::Traced<E, width>, E> {};
