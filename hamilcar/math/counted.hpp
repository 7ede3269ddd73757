// Lets the counting scalar into Eigen's matrices.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/counted.hpp"

template <>
struct Eigen::NumTraits<hamilcar::Counted> : hamilcar::NumberTraits<hamilcar::Counted, double> {};
