#include "hamilcar/io/tir_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hamilcar/tire/magic_formula.hpp"

namespace hamilcar::io {

std::optional<std::string> complaint_about_coefficients(const MagicFormulaDescription& tire) {
    constexpr double max = 1e6, min = 1e-6, max_exponent = 250;
    const MagicCoefficients c = scaled(tire);
    const auto complaint = [&](std::size_t i, const std::string& expected) {
        return fmt::format("{} with its scaling factors and the inflation pressure is {:g}: expected {}",
                           magic_coefficients[i].name, c[i], expected);
    };
    for (std::size_t i = 0; i < magic_count; ++i)
        if (!(std::abs(c[i]) <= max)) return complaint(i, fmt::format("{:g} at most", max));
    for (const MagicName divisor : {PCX1, PDX1, PKX1, PCY1, PDY1, PKY1, PKY2, PKY4})
        if (!(std::abs(c[divisor]) >= min)) return complaint(divisor, fmt::format("{:g} at least", min));
    for (const MagicName factor : {LFZO, LMUX, LMUY})
        if (!(c[factor] >= min)) return complaint(factor, fmt::format("a positive number, {:g} at least", min));

    const double ratio = tire.load[1] / (tire.nominal_load * c[LFZO]);
    const std::pair<MagicName, double> powers[]{
        {PKX3, std::max(ratio, 1.0)}, {PTX3, std::max(ratio, 1.0)}, {QSY7, std::max(std::abs(std::log(ratio)), 5.0)}};
    for (const auto& [exponent, reach] : powers)
        if (!(std::abs(c[exponent]) * reach <= max_exponent))
            return complaint(exponent, fmt::format("an exponent that leaves a number at {:g} N", tire.load[1]));
    return std::nullopt;
}

std::vector<std::string> narrow_ranges(MagicFormulaDescription& tire) {
    constexpr double max_lost = 0.9;
    const MagicCoefficients c = scaled(tire);
    const double unit = tire.nominal_load * c[LFZO];
    std::vector<std::string> notes;
    const auto name = [](MagicName i) { return magic_coefficients[i].name; };
    const auto loads_up_to = [&](double max, MagicName by) {
        if (!(max < tire.load[1])) return;
        tire.load[1] = max;
        notes.push_back(fmt::format("{} reduces the force to zero at high loads: loads are clamped to at most {:g} N",
                                    name(by), max));
    };
    for (const auto& [nominal, change] : {std::pair{PDX1, PDX2}, std::pair{PDY1, PDY2}}) {
        const double slope = c[change] / c[nominal];  // friction is 1 + slope dfz times that at the nominal load
        if (slope < 0) loads_up_to(unit * (1 - max_lost / slope), change);
        const double min = slope > 0 ? unit * (1 - max_lost / slope) : 0;
        if (!(min > tire.load[0])) continue;
        tire.load[0] = min;
        notes.push_back(fmt::format("{} reduces the force to zero at low loads: loads are clamped to at least {:g} N",
                                    name(change), min));
    }
    const double half_turn = std::acos(-1.0);
    if (std::abs(c[PKY4]) > 2)  // sin(PKY4 atan(load / PKY2))
        loads_up_to(unit * std::abs(c[PKY2]) * std::tan((1 - (1 - max_lost) / 2) * half_turn / std::abs(c[PKY4])),
                    PKY4);

    const std::pair<MagicName, double> lean[]{{PDX3, std::sqrt(max_lost / c[PDX3])},
                                              {PDY3, std::sqrt(max_lost / c[PDY3])},
                                              {PKY3, max_lost / c[PKY3]},
                                              {PKY5, std::sqrt(-max_lost * c[PKY2] / c[PKY5])}};
    for (const auto& [by, max] : lean) {
        // What camber adds to, and never takes away from, gives no number here, or one below zero.
        if (!(max > 0 && (max < tire.camber[1] || max < -tire.camber[0]))) continue;
        tire.camber = {std::max(tire.camber[0], -max), std::min(tire.camber[1], max)};
        notes.push_back(
            fmt::format("{} reduces the force to zero with camber: it is clamped to at most {:g} rad", name(by), max));
    }
    return notes;
}

std::array<double, 2> mended_range(std::array<double, 2> limits, const std::array<double, 2>& own, bool about_zero) {
    const auto holds = [&](double low, double high) {
        return low < high && (about_zero ? low < 0 && high > 0 : low >= 0);
    };
    const auto [low, high] = limits;
    if (holds(low, high)) return limits;
    if (holds(high, low)) return {high, low};
    if (about_zero && low < 0) return {low, -low};
    if (about_zero && high > 0) return {-high, high};
    if (!about_zero && low < 0 && high > 0) return {0, high};
    return own;
}

std::optional<std::array<double, 2>> spring_through(const PropertySection* curve, double length, double force) {
    if (!curve || curve->rows.empty() || curve->rows.front().size() < 2) return std::nullopt;
    double d2 = 0, d3 = 0, d4 = 0, fd = 0, fd2 = 0, furthest = 0;
    for (const std::vector<double>& row : curve->rows) {
        const double d = row[0] * length, load = row[1] * force;
        d2 += d * d, d3 += d * d * d, d4 += d * d * d * d, fd += load * d, fd2 += load * d * d;
        furthest = std::max(furthest, d);
    }
    const double determinant = d2 * d4 - d3 * d3;
    std::array<double, 2> spring{fd / d2, 0};  // of a single point, or of loads that fall with the deflection
    if (determinant > 1e-9 * d2 * d4) spring = {(fd * d4 - fd2 * d3) / determinant, (fd2 * d2 - fd * d3) / determinant};
    if (!(spring[0] > 0 && spring[0] + 2 * spring[1] * furthest > 0)) spring = {fd / d2, 0};
    const bool possible = spring[0] >= min_in_tir && spring[0] <= max_in_tir && std::abs(spring[1]) <= max_in_tir;
    return possible ? std::optional(spring) : std::nullopt;
}

}  // namespace hamilcar::io
