// Where in the ranges of its parameters a study looks: points of a grid, or of the unit cube.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hamilcar {

// Every combination of `counts[0]`, `counts[1]`, ... levels as numbers from 0 on; the last parameter changes fastest.
std::vector<std::vector<std::size_t>> full_factorial(const std::vector<std::size_t>& counts);

// Points in [0, 1)^dimensions. In each dimension exactly one of them lies in each of `points` equal intervals (McKay, Beckman
// and Conover, Technometrics 21, 1979); which, and where in it, is drawn: the same for the same seed on every machine.
std::vector<std::vector<double>> latin_hypercube(std::size_t points, std::size_t dimensions, std::uint64_t seed);

inline constexpr std::size_t max_sobol_dimensions = 16;

// Sobol's sequence without its first point, the origin: 2^k points fill the cube evenly, and more points keep those before.
// Direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2008; new-joe-kuo-6.21201); points in Gray code's order (Antonov
// and Saleev, 1979).
std::vector<std::vector<double>> sobol(std::size_t points, std::size_t dimensions);

}  // namespace hamilcar
