#include "hamilcar/io/tir_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hamilcar/tire/magic_formula.hpp"

namespace hamilcar::io {

std::optional<std::string> complaint_about_coefficients(const MagicFormulaDescription& tire) {
    constexpr double most = 1e6, least = 1e-6, largest_exponent = 250;
    const MagicCoefficients c = scaled(tire);
    const auto complaint = [&](std::size_t i, const std::string& expected) {
        return fmt::format("{} with its scaling factors and the inflation pressure is {:g}: expected {}",
                           magic_coefficients[i].name, c[i], expected);
    };
    for (std::size_t i = 0; i < magic_count; ++i)
        if (!(std::abs(c[i]) <= most)) return complaint(i, fmt::format("{:g} at most", most));
    for (const MagicName divisor : {PCX1, PDX1, PKX1, PCY1, PDY1, PKY1, PKY2, PKY4})
        if (!(std::abs(c[divisor]) >= least)) return complaint(divisor, fmt::format("{:g} at least", least));
    for (const MagicName factor : {LFZO, LMUX, LMUY})
        if (!(c[factor] >= least)) return complaint(factor, fmt::format("a positive number, {:g} at least", least));

    const double ratio = tire.load[1] / (tire.nominal_load * c[LFZO]);
    const std::pair<MagicName, double> powers[]{
        {PKX3, std::max(ratio, 1.0)}, {PTX3, std::max(ratio, 1.0)}, {QSY7, std::max(std::abs(std::log(ratio)), 5.0)}};
    for (const auto& [exponent, reach] : powers)
        if (!(std::abs(c[exponent]) * reach <= largest_exponent))
            return complaint(exponent, fmt::format("an exponent that leaves a number at {:g} N", tire.load[1]));
    return std::nullopt;
}

std::vector<std::string> narrow_ranges(MagicFormulaDescription& tire) {
    constexpr double most_lost = 0.9;
    const MagicCoefficients c = scaled(tire);
    const double unit = tire.nominal_load * c[LFZO];
    std::vector<std::string> notes;
    const auto name = [](MagicName i) { return magic_coefficients[i].name; };
    const auto loads_up_to = [&](double most, MagicName by) {
        if (!(most < tire.load[1])) return;
        tire.load[1] = most;
        notes.push_back(fmt::format("{} leaves nothing of the tire beyond: loads count up to {:g} N", name(by), most));
    };
    for (const auto& [nominal, change] : {std::pair{PDX1, PDX2}, std::pair{PDY1, PDY2}}) {
        const double slope = c[change] / c[nominal];  // friction is 1 + slope dfz times that at the nominal load
        if (slope < 0) loads_up_to(unit * (1 - most_lost / slope), change);
        const double least = slope > 0 ? unit * (1 - most_lost / slope) : 0;
        if (!(least > tire.load[0])) continue;
        tire.load[0] = least;
        notes.push_back(
            fmt::format("{} leaves nothing of the tire below: loads count from {:g} N", name(change), least));
    }
    const double half_turn = std::acos(-1.0);
    if (std::abs(c[PKY4]) > 2)  // sin(PKY4 atan(load / PKY2))
        loads_up_to(unit * std::abs(c[PKY2]) * std::tan((1 - (1 - most_lost) / 2) * half_turn / std::abs(c[PKY4])),
                    PKY4);

    const std::pair<MagicName, double> lean[]{{PDX3, std::sqrt(most_lost / c[PDX3])},
                                              {PDY3, std::sqrt(most_lost / c[PDY3])},
                                              {PKY3, most_lost / c[PKY3]},
                                              {PKY5, std::sqrt(-most_lost * c[PKY2] / c[PKY5])}};
    for (const auto& [by, most] : lean) {
        // What camber adds to, and never takes away from, gives no number here, or one below zero.
        if (!(most > 0 && (most < tire.camber[1] || most < -tire.camber[0]))) continue;
        tire.camber = {std::max(tire.camber[0], -most), std::min(tire.camber[1], most)};
        notes.push_back(
            fmt::format("{} leaves nothing of the tire beyond: camber counts up to {:g} rad", name(by), most));
    }
    return notes;
}

}  // namespace hamilcar::io
