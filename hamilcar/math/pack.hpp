// Lets packs of lanes into Eigen's matrices.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/pack.hpp"

template <class T, int N>
struct Eigen::NumTraits<hamilcar::Pack<T, N>> : Eigen::NumTraits<T> {
    using Real = hamilcar::Pack<T, N>;
    using NonInteger = hamilcar::Pack<T, N>;
    using Nested = hamilcar::Pack<T, N>;
    using Literal = hamilcar::Pack<T, N>;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 0,
        ReadCost = 1,
        AddCost = 1,
        MulCost = 1
    };
};
