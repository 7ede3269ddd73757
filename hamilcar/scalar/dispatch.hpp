// std::visit for use inside a step: a chain of comparisons that the compiler can optimize, without tables or exceptions.
#pragma once

#include <type_traits>
#include <variant>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Calls f with the alternative that `variant` holds; `variant` must not be valueless.
template <std::size_t I = 0, class Variant, class F>
decltype(auto) dispatch(Variant& variant, F&& f) {
    HAMILCAR_ASSERT(!variant.valueless_by_exception());
    if constexpr (I + 1 == std::variant_size_v<std::remove_const_t<Variant>>) {
        return f(*std::get_if<I>(&variant));
    } else {
        if (variant.index() == I) return f(*std::get_if<I>(&variant));
        return dispatch<I + 1>(variant, f);
    }
}

// Whether `check`, a lambda of a type, holds for each alternative of a variant.
template <class... Types, class Check>
consteval bool every_alternative(std::type_identity<std::variant<Types...>>, Check check) {
    return (check.template operator()<Types>() && ...);
}

}  // namespace hamilcar
