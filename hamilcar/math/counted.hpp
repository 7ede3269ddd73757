// Lets the counting scalar into Eigen's matrices.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/counted.hpp"

template <>
struct Eigen::NumTraits<hamilcar::Counted> : Eigen::NumTraits<double> {
    using Real = hamilcar::Counted;
    using NonInteger = hamilcar::Counted;
    using Nested = hamilcar::Counted;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = 1,
        AddCost = 1,
        MulCost = 1
    };
};
