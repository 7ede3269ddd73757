// Converts structs of parameters between scalars: several structs of one type into lanes, or one struct to another scalar. Every
// struct of parameters lists its members, and the lists of both structs are traversed together.
#pragma once

#include <array>
#include <cassert>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class Wide, class Narrow, std::size_t N>
void gather(Wide& to, const std::array<const Narrow*, N>& from);

namespace detail {

template <class Struct, class Member>
constexpr std::size_t end_behind(std::size_t end, Member Struct::*) {
    return (end + alignof(Member) - 1) / alignof(Member) * alignof(Member) + sizeof(Member);
}

// Whether members() lists everything that a struct holds, in order: laid out one behind the other they fill it. What is forgotten
// would stay the same for all lanes, and no test that compares programs could see it. What is made anew from the others stands in
// derived_members().
template <class Struct>
constexpr bool lists_all_members() {
    std::size_t end = 0;
    const auto add = [&end](auto... member) { ((end = end_behind(end, member)), ...); };
    std::apply(add, Struct::members());
    if constexpr (requires { Struct::derived_members(); }) std::apply(add, Struct::derived_members());
    return (end + alignof(Struct) - 1) / alignof(Struct) * alignof(Struct) == sizeof(Struct);
}

template <class Narrow, std::size_t N, class Part>
auto parts(const std::array<const Narrow*, N>& from, Part&& part) {
    std::array<std::add_pointer_t<std::remove_reference_t<decltype(part(*from[0]))>>, N> out;
    for (std::size_t i = 0; i < N; ++i) out[i] = &part(*from[i]);
    return out;
}

template <class Wide, class Narrow, std::size_t N>
void gather_members(Wide& to, const std::array<const Narrow*, N>& from) {
    static_assert(lists_all_members<Narrow>(), "members() lists every member in order");
    constexpr auto wide = Wide::members();
    constexpr auto narrow = Narrow::members();
    [&]<std::size_t... m>(std::index_sequence<m...>) {
        (gather(to.*std::get<m>(wide),
                parts(
                    from, [&](const Narrow& one) -> const auto& { return one.*std::get<m>(narrow); })),
         ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(wide)>>());
}

template <class... Wide, class Narrow, std::size_t N>
void gather_parts(std::tuple<Wide...>& to, const std::array<const Narrow*, N>& from) {
    [&]<std::size_t... m>(std::index_sequence<m...>) {
        (gather(std::get<m>(to), parts(
                                     from, [](const Narrow& one) -> const auto& { return std::get<m>(one); })),
         ...);
    }
    (std::make_index_sequence<sizeof...(Wide)>());
}

// All hold the same alternative.
template <class... Wide, class Narrow, std::size_t N>
void gather_parts(std::variant<Wide...>& to, const std::array<const Narrow*, N>& from) {
    [&]<std::size_t... m>(std::index_sequence<m...>) {
        const auto take = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) {
            if (from[0]->index() != k) return;
            gather(to.template emplace<k>(),
                   parts(
                       from, [](const Narrow& one) -> const auto& { return *std::get_if<k>(&one); }));
        };
        (take(std::integral_constant<std::size_t, m>()), ...);
    }
    (std::make_index_sequence<sizeof...(Wide)>());
}

// All are of one length.
template <class Wide, class Narrow, std::size_t N>
void gather_parts(std::vector<Wide>& to, const std::array<const Narrow*, N>& from) {
    to.resize(from[0]->size());
    for (std::size_t i = 0; i < to.size(); ++i) {
        gather(to[i], parts(
                          from, [i](const Narrow& one) -> const auto& { return one[i]; }));
    }
}
template <class Wide, std::size_t size, class Narrow, std::size_t N>
void gather_parts(std::array<Wide, size>& to, const std::array<const Narrow*, N>& from) {
    for (std::size_t i = 0; i < size; ++i) {
        gather(to[i], parts(
                          from, [i](const Narrow& one) -> const auto& { return one[i]; }));
    }
}
template <class Wide, int rows, int columns, class Narrow, std::size_t N>
void gather_parts(Eigen::Matrix<Wide, rows, columns>& to, const std::array<const Narrow*, N>& from) {
    for (int i = 0; i < rows * columns; ++i) {
        gather(to.data()[i], parts(
                                 from, [i](const Narrow& one) -> const auto& { return one.data()[i]; }));
    }
}

}  // namespace detail

template <class To, class From, class Convert>
void transcribe(To& to, const From& from, Convert&& convert);

namespace detail {

template <class... To, class From, class Convert>
void transcribe_alternative(std::variant<To...>& to, const From& from, Convert&& convert) {
    convert.whole(static_cast<int>(from.index()));
    [&]<std::size_t... k>(std::index_sequence<k...>) {
        const auto take = [&]<std::size_t one>(std::integral_constant<std::size_t, one>) {
            if (from.index() == one) transcribe(to.template emplace<one>(), *std::get_if<one>(&from), convert);
        };
        (take(std::integral_constant<std::size_t, k>()), ...);
    }
    (std::make_index_sequence<sizeof...(To)>());
}

}  // namespace detail

// Lane i of `to` becomes `from[i]`. A member without lanes takes the first value, a count the largest.
template <class Wide, class Narrow, std::size_t N>
void gather(Wide& to, const std::array<const Narrow*, N>& from) {
    if constexpr (requires { Wide::members(); }) {
        detail::gather_members(to, from);
    } else if constexpr (std::is_integral_v<Narrow>) {
        to = *from[0];
        for (const Narrow* one : from) to = std::max(to, *one);
    } else if constexpr (std::is_floating_point_v<Narrow>) {
        for (int i = 0; i < lane_count<Wide>; ++i) {
            set_lane(to, i, static_cast<Element<Wide>>(*from[static_cast<std::size_t>(i)]));
        }
    } else if constexpr (lane_count<Wide> == static_cast<int>(N) && std::is_same_v<Element<Wide>, Narrow>) {
        std::array<Narrow, N> numbers;
        for (std::size_t i = 0; i < N; ++i) numbers[i] = *from[i];
        to = Wide(numbers);
    } else {
        detail::gather_parts(to, from);
    }
}

// The same struct for another scalar: `convert.number(double)` converts each number, in the order of the lists, and
// `convert.whole(n)` each count and variant index in between; its result is stored if the member is a count. A member that is a
// double in both structs is passed to `convert` but copied unchanged.
template <class To, class From, class Convert>
void transcribe(To& to, const From& from, Convert&& convert) {
    if constexpr (requires { To::members(); }) {
        static_assert(detail::lists_all_members<From>(), "members() lists every member in order");
        std::apply(
            [&](auto... to_member) {
                std::apply([&](auto... from_member) { (transcribe(to.*to_member, from.*from_member, convert), ...); },
                           From::members());
            },
            To::members());
    } else if constexpr (std::is_integral_v<From>) {
        to = static_cast<To>(convert.whole(static_cast<int>(from)));
    } else if constexpr (std::is_floating_point_v<From>) {
        [[maybe_unused]] const auto number = convert.number(from);
        if constexpr (std::is_floating_point_v<To>) {
            to = from;
        } else {
            to = number;
        }
    } else if constexpr (requires { from.index(); }) {
        detail::transcribe_alternative(to, from, convert);
    } else if constexpr (requires {
                             to.resize(from.size());
                             from.begin();
                         }) {
        convert.whole(static_cast<int>(from.size()));
        to.resize(from.size());
        for (std::size_t i = 0; i < static_cast<std::size_t>(from.size()); ++i) transcribe(to[i], from[i], convert);
    } else if constexpr (requires { from.data(); }) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(from.size()); ++i) {
            transcribe(to.data()[i], from.data()[i], convert);
        }
    } else {
        std::apply(
            [&](auto&... part) {
                std::apply([&](const auto&... from_part) { (transcribe(part, from_part, convert), ...); }, from);
            },
            to);
    }
}

}  // namespace hamilcar
