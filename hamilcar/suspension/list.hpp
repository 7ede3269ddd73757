// Every suspension the program knows. A new one is one line here; the largest sizes follow.
#pragma once

#include <algorithm>
#include <variant>

#include "hamilcar/suspension/macpherson.hpp"
#include "hamilcar/suspension/semi_trailing_arm.hpp"

namespace hamilcar {

template <class T>
using Suspension = std::variant<MacPherson<T>, SemiTrailingArm<T>>;

template <class T>
Suspension<T> make_suspension(const SuspensionDescription& description) {
    struct {
        Suspension<T> operator()(const MacPhersonDescription& d) const { return MacPherson<T>(d); }
        Suspension<T> operator()(const SemiTrailingArmDescription& d) const { return SemiTrailingArm<T>(d); }
    } make;
    return std::visit(make, description);
}

namespace detail {
template <class List>
struct LargestSizes;
template <class... S>
struct LargestSizes<std::variant<S...>> {
    static constexpr int independent = std::max({S::Linkage::nV...});
    static constexpr int dependent = std::max({S::Linkage::nW...});
};
}  // namespace detail

inline constexpr int max_independent = detail::LargestSizes<Suspension<double>>::independent;
inline constexpr int max_dependent = detail::LargestSizes<Suspension<double>>::dependent;

}  // namespace hamilcar
