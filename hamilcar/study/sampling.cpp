#include "hamilcar/study/sampling.hpp"

#include <array>
#include <bit>
#include <numeric>
#include <utility>

namespace hamilcar {

namespace {

// SplitMix64 (Steele, Lea and Flood, 2014): the standard library's distributions differ from machine to machine.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    // In [0, 1).
    double operator()() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

// Of one dimension: a primitive polynomial's degree, its inner coefficients as bits, and the first direction numbers.
struct Direction {
    unsigned degree, inner;
    std::array<std::uint32_t, 6> first;
};
constexpr std::array<Direction, max_sobol_dimensions - 1> directions{{{1, 0, {1}},
                                                                      {2, 1, {1, 3}},
                                                                      {3, 1, {1, 3, 1}},
                                                                      {3, 2, {1, 1, 1}},
                                                                      {4, 1, {1, 1, 3, 3}},
                                                                      {4, 4, {1, 3, 5, 13}},
                                                                      {5, 2, {1, 1, 5, 5, 17}},
                                                                      {5, 4, {1, 1, 5, 5, 5}},
                                                                      {5, 7, {1, 1, 7, 11, 19}},
                                                                      {5, 11, {1, 1, 5, 1, 1}},
                                                                      {5, 13, {1, 1, 1, 3, 11}},
                                                                      {5, 14, {1, 3, 5, 5, 31}},
                                                                      {6, 1, {1, 3, 3, 9, 7, 49}},
                                                                      {6, 13, {1, 1, 1, 15, 21, 21}},
                                                                      {6, 16, {1, 3, 1, 13, 27, 49}}}};

using Directions = std::array<std::uint32_t, 32>;  // v_k = m_k / 2^k, as fractions of 2^32

Directions directions_of(std::size_t dimension) {
    Directions v{};
    if (dimension == 0) {
        for (unsigned k = 0; k < 32; ++k) v[k] = std::uint32_t{1} << (31 - k);
        return v;
    }
    const Direction& d = directions[dimension - 1];
    for (unsigned k = 0; k < 32; ++k) {
        if (k < d.degree) {
            v[k] = d.first[k] << (31 - k);
            continue;
        }
        v[k] = v[k - d.degree] ^ (v[k - d.degree] >> d.degree);
        for (unsigned i = 1; i < d.degree; ++i) {
            if ((d.inner >> (d.degree - 1 - i)) & 1) v[k] ^= v[k - i];
        }
    }
    return v;
}

}  // namespace

std::vector<std::vector<std::size_t>> full_factorial(const std::vector<std::size_t>& counts) {
    std::vector<std::vector<std::size_t>> points{{}};
    for (const std::size_t count : counts) {
        std::vector<std::vector<std::size_t>> longer;
        for (const std::vector<std::size_t>& point : points) {
            for (std::size_t level = 0; level < count; ++level) {
                longer.push_back(point);
                longer.back().push_back(level);
            }
        }
        points = std::move(longer);
    }
    return points;
}

std::vector<std::vector<double>> latin_hypercube(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
    Random random(seed);
    std::vector<std::vector<double>> out(points, std::vector<double>(dimensions));
    std::vector<std::size_t> interval(points);
    for (std::size_t k = 0; k < dimensions; ++k) {
        std::iota(interval.begin(), interval.end(), std::size_t{0});
        for (std::size_t i = points; i > 1; --i) {  // Fisher and Yates
            std::swap(interval[i - 1], interval[static_cast<std::size_t>(random() * static_cast<double>(i))]);
        }
        for (std::size_t i = 0; i < points; ++i) {
            out[i][k] = (static_cast<double>(interval[i]) + random()) / static_cast<double>(points);
        }
    }
    return out;
}

std::vector<std::vector<double>> sobol(std::size_t points, std::size_t dimensions) {
    std::vector<std::vector<double>> out(points, std::vector<double>(dimensions));
    for (std::size_t k = 0; k < dimensions; ++k) {
        const Directions v = directions_of(k);
        std::uint32_t x = 0;
        for (std::size_t i = 0; i < points; ++i) {
            x ^= v[static_cast<std::size_t>(std::countr_one(i))];
            out[i][k] = x * 0x1p-32;
        }
    }
    return out;
}

}  // namespace hamilcar
