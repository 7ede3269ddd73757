#include "hamilcar/math/fourier.hpp"

#include <bit>
#include <numbers>
#include <stdexcept>

#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

namespace {

using Complex = std::complex<double>;

// Written out, because the operator of std::complex checks for infinities.
Complex product(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

void fourier_transform(std::vector<Complex>& values) {
    const std::size_t size = values.size();
    if (!std::has_single_bit(size)) throw std::length_error("the size of a Fourier transform must be a power of two");
    for (std::size_t i = 1, mirrored = 0; i < size; ++i) {  // the index with its bits in reverse order
        std::size_t bit = size >> 1;
        for (; (mirrored & bit) != 0; bit >>= 1) mirrored ^= bit;
        mirrored ^= bit;
        if (i < mirrored) std::swap(values[i], values[mirrored]);
    }
    std::vector<Complex> turns(size / 2);
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const auto [s, c] = sincos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size));
        turns[i] = {c, s};
    }
    for (std::size_t half = 1; half < size; half *= 2)
        for (std::size_t from = 0; from < size; from += 2 * half)
            for (std::size_t i = 0; i < half; ++i) {
                Complex& a = values[from + i];
                Complex& b = values[from + i + half];
                const Complex turned = product(b, turns[i * (size / 2 / half)]);
                b = a - turned;
                a += turned;
            }
}

std::vector<double> hann_window(std::size_t size) {
    std::vector<double> window(size);
    for (std::size_t i = 0; i < size; ++i) {
        const double s = sincos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(size)).sine;
        window[i] = s * s;
    }
    return window;
}

std::vector<Complex> transformed(std::span<const double> segment, const std::vector<double>& window) {
    const auto size = static_cast<double>(segment.size());
    const auto from_middle = [&](std::size_t i) { return static_cast<double>(i) - (size - 1) / 2; };
    double mean = 0, slope = 0;
    for (std::size_t i = 0; i < segment.size(); ++i) {
        mean += segment[i] / size;
        slope += segment[i] * from_middle(i);
    }
    slope /= size * (size * size - 1) / 12;
    std::vector<Complex> values(segment.size());
    for (std::size_t i = 0; i < segment.size(); ++i) {
        values[i] = window[i] * (segment[i] - mean - slope * from_middle(i));
    }
    fourier_transform(values);
    return values;
}

}  // namespace hamilcar
