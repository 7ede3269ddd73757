// A chain of tree joints from the chassis to the carrier: where it puts the carrier, its columns of B, and their rates.
// Every column has the type of motion that it is, so a chain is a tuple of columns and not a matrix (paper, section 2).
#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "hamilcar/linkage/tree_joints.hpp"

namespace hamilcar {

// The columns of a chain whose first joint stands on the chassis, as a tuple of their types.
template <class T, class... Joints>
struct TreeColumns;
template <class T, class First, class... Further>
struct TreeColumns<T, First, Further...> {
    template <class Joint, class Parent>
    using Placed = decltype(std::declval<Joint>().place(Parent{}, std::declval<const T*>(), Vec3<T>{}).columns);
    using type = decltype(std::tuple_cat(std::declval<Placed<First, ChassisFrame<T>>>(),
                                         std::declval<Placed<Further, Pose<T>>>()...));
};

// The carrier's pose; the columns of the chain of joints from `parent` on are written where they are kept, as soon as they
// are known. q in the order of the joints.
template <std::size_t I = 0, int first = 0, class T, class Parent, class... Joints, class Columns>
Pose<T> place_tree(const std::tuple<Joints...>& joints, const Parent& parent, const T* q, const Vec3<T>& anchor,
                   Columns& columns) {
    constexpr int count = std::tuple_element_t<I, std::tuple<Joints...>>::coordinates;
    const auto placed = std::get<I>(joints).place(parent, q + first, anchor);
    [&]<std::size_t... k>(std::index_sequence<k...>) {
        ((std::get<static_cast<std::size_t>(first) + k>(columns) = std::get<k>(placed.columns)), ...);
    }
    (std::make_index_sequence<count>());
    if constexpr (I + 1 == sizeof...(Joints)) {
        return placed.child;
    } else {
        return place_tree<I + 1, first + count>(joints, placed.child, q, anchor, columns);
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
auto carry_tree(const Carrying& v, const Columns& B, const T* q_rate, const Rates&... rates) {
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
auto combined(const Motions& motions, const F& f) {
    if constexpr (k == Picked::count) {
        return Rest{};
    } else {
        const auto term = scaled(std::get<Picked::index[k]>(motions), f(k));
        return sum(term, combined<Picked, k + 1>(motions, f));
    }
}

}  // namespace hamilcar
