// What the blocks ask of a tire model.
#pragma once

#include <concepts>
#include <string_view>

#include "hamilcar/tire/contact.hpp"

namespace hamilcar {

template <class Model, class T>
concept TireModel = requires(const Model tire, const TireContact<T>& contact, const T& depth) {
    { Model::keyword } -> std::convertible_to<std::string_view>;  // in vehicle files
    { Model::has_moments } -> std::convertible_to<bool>;          // Mx and Mz
    { tire.radius } -> std::convertible_to<T>;                    // unloaded [m]
    { tire.rolling_radius } -> std::convertible_to<T>;            // [m]
    { tire.force(contact) } -> std::same_as<TireForce<T>>;
    { tire.potential(depth) } -> std::same_as<T>;  // of the vertical spring [J]
    Model::members();
};

}  // namespace hamilcar
