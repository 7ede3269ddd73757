// Loops over arrays for integrators and batches, with the same bits for any vector width.
#pragma once

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// to = from + sum_j weight[j] rate[j], for `size` numbers; the sum is formed first, in the order of j. `to` may be `from`.
template <class T>
void add_weighted(const T* from, const T* const* rate, const T* weight, int count, T* to, int size) {
    for (int i = 0; i < size; ++i) {
        T sum = weight[0] * rate[0][i];
        for (int j = 1; j < count; ++j) sum += weight[j] * rate[j][i];
        to[i] = from[i] + sum;
    }
}

// to += weight x
template <class T>
void add_scaled(const T& weight, const T* x, T* to, int size) {
    for (int i = 0; i < size; ++i) to[i] += weight * x[i];
}

// Compiled for several instruction sets, where the compiler supports it.
void add_weighted(const double* from, const double* const* rate, const double* weight, int count, double* to, int size);
void add_weighted(const float* from, const float* const* rate, const float* weight, int count, float* to, int size);
void add_scaled(const double& weight, const double* x, double* to, int size);
void add_scaled(const float& weight, const float* x, float* to, int size);

// Whether all are finite.
bool all_finite(const double* numbers, int size);
bool all_finite(const float* numbers, int size);

}  // namespace hamilcar
