// All tire models; a new one is added here.
#pragma once

#include <variant>

#include "hamilcar/scalar/dispatch.hpp"
#include "hamilcar/tire/brush.hpp"
#include "hamilcar/tire/dugoff.hpp"
#include "hamilcar/tire/fiala.hpp"
#include "hamilcar/tire/linear_tire.hpp"
#include "hamilcar/tire/magic_formula.hpp"
#include "hamilcar/tire/spring_tire.hpp"
#include "hamilcar/tire/tire_model.hpp"
#include "hamilcar/tire/tmeasy.hpp"

namespace hamilcar {

template <class T>
using Tire = std::variant<LinearTire<T>, SpringTire<T>, SlipTire<T, MagicFormula>, SlipTire<T, Tmeasy>,
                          SlipTire<T, Fiala>, SlipTire<T, Brush>, SlipTire<T, Dugoff>>;

static_assert(every_alternative(std::type_identity<Tire<double>>(),
                                []<class Model>() { return TireModel<Model, double>; }));

template <class T>
Tire<T> make_tire(const TireDescription& description) {
    struct {
        Tire<T> operator()(const LinearTireDescription& d) const { return LinearTire<T>(d); }
        Tire<T> operator()(const SpringTireDescription& d) const { return SpringTire<T>(d); }
        Tire<T> operator()(const MagicFormulaDescription& d) const { return SlipTire<T, MagicFormula>(d); }
        Tire<T> operator()(const TmeasyDescription& d) const { return SlipTire<T, Tmeasy>(d); }
        Tire<T> operator()(const FialaDescription& d) const { return SlipTire<T, Fiala>(d); }
        Tire<T> operator()(const BrushDescription& d) const { return SlipTire<T, Brush>(d); }
        Tire<T> operator()(const DugoffDescription& d) const { return SlipTire<T, Dugoff>(d); }
    } make;
    return std::visit(make, description);
}

}  // namespace hamilcar
