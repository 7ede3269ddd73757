// Every tire model the program knows. A new one is one line here.
#pragma once

#include <variant>

#include "hamilcar/tire/linear_tire.hpp"
#include "hamilcar/tire/spring_tire.hpp"

namespace hamilcar {

template <class T>
using Tire = std::variant<LinearTire<T>, SpringTire<T>>;

template <class T>
Tire<T> make_tire(const TireDescription& description) {
    struct {
        Tire<T> operator()(const LinearTireDescription& d) const { return LinearTire<T>(d); }
        Tire<T> operator()(const SpringTireDescription& d) const { return SpringTire<T>(d); }
    } make;
    return std::visit(make, description);
}

}  // namespace hamilcar
