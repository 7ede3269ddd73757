// Fourier transforms of sampled numbers, with bits that do not depend on the machine.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace hamilcar {

// The discrete Fourier transform, in place: sums of values[j] exp(+2 pi i j k / size). Throws std::length_error if the size
// is not a power of two.
void fourier_transform(std::vector<std::complex<double>>& values);

// sin^2(pi i / size): Hann's window, periodic.
std::vector<double> hann_window(std::size_t size);

// The transform of a segment, minus its least-squares line, times a window of the same size.
std::vector<std::complex<double>> transformed(std::span<const double> segment, const std::vector<double>& window);

}  // namespace hamilcar
