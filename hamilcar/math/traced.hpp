// Lets Eigen use the recording number as a scalar.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/traced.hpp"

template <int width>
struct Eigen::NumTraits<hamilcar::Traced<width>> : hamilcar::NumberTraits<hamilcar::Traced<width>, double> {};
