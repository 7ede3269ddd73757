// A chain of tree joints from the chassis to the carrier: where it puts the carrier, its columns of B, and their rates.
// Every column has the type of motion that it is, so a chain is a tuple of columns and not a matrix (paper, section 2).
#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "hamilcar/linkage/tree_joints.hpp"

namespace hamilcar {

// The carrier and the columns of a chain of joints, from `parent` on; q in the order of the joints.
template <std::size_t I = 0, int first = 0, class T, class Parent, class... Joints>
HAMILCAR_CORE auto place_tree(const std::tuple<Joints...>& joints, const Parent& parent, const T* q,
                              const Vec3<T>& anchor) {
    const auto placed = std::get<I>(joints).place(parent, q + first, anchor);
    if constexpr (I + 1 == sizeof...(Joints)) {
        return std::pair(placed.child, placed.columns);
    } else {
        constexpr int next = first + std::tuple_element_t<I, std::tuple<Joints...>>::coordinates;
        const auto further = place_tree<I + 1, next>(joints, placed.child, q, anchor);
        return std::pair(further.first, std::tuple_cat(placed.columns, further.second));
    }
}

// All coordinates of a chain from the chassis outward, and where in that order each one stands.
template <class... Joints>
struct OutwardOrder {
    static constexpr int count = (Joints::coordinates + ... + 0);
    static constexpr std::array<int, count> order = [] {
        std::array<int, count> all{};
        int next = 0, first = 0;
        const auto append = [&](const auto& own) {
            for (const int i : own) all[static_cast<std::size_t>(next++)] = first + i;
            first += static_cast<int>(own.size());
        };
        (append(Joints::outward), ...);
        return all;
    }();
    static constexpr std::array<int, count> place = [] {
        std::array<int, count> inverse{};
        for (int k = 0; k < count; ++k) inverse[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])] = k;
        return inverse;
    }();
};

// The carrier's motion and the rates of the columns in the order outward. A column moves with what carries it.  // (18)
template <class Outward, int k = 0, class T, class Carrying, class Columns, class... Rates>
HAMILCAR_CORE auto carry_tree(const Carrying& v, const Columns& B, const T* q_rate, const Rates&... rates) {
    if constexpr (k == Outward::count) {
        return std::pair(v, std::tuple(rates...));
    } else {
        constexpr int i = Outward::order[k];
        const auto& column = std::get<i>(B);
        return carry_tree<Outward, k + 1>(sum(v, scaled(column, q_rate[i])), B, q_rate, rates..., carried(v, column));
    }
}

// sum of the picked motions times f(0), f(1), ...; `index` tells where in the tuple a picked one stands.
template <class Picked, int k = 0, class Motions, class F>
HAMILCAR_CORE auto combined(const Motions& motions, const F& f) {
    if constexpr (k == Picked::count) {
        return Rest{};
    } else {
        const auto term = scaled(std::get<Picked::index[k]>(motions), f(k));
        return sum(term, combined<Picked, k + 1>(motions, f));
    }
}

}  // namespace hamilcar
