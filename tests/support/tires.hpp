// A tire of every model in a size that fits the shipped car, and their common properties.
#pragma once

#include <vector>

#include "hamilcar/description/tire.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "support/paths.hpp"

namespace hamilcar::test {

// The bilateral vertical spring instead of a tire.
inline SpringTireDescription spring_of(const TireDescription& tire) {
    const CasingDescription casing = casing_of(tire);
    return {casing.radius, casing.rolling_radius, casing.vertical_stiffness};
}

inline void stretch(TireDescription& tire, double factor) {
    std::visit(
        [factor](auto& t) {
            if constexpr (requires { t.casing; }) {
                t.casing.radius *= factor;
            } else {
                t.radius *= factor;
            }
        },
        tire);
}

inline MagicFormulaDescription magic_tire() {
    return io::read_tir(source_path("vehicles/tires/pacejka_205_60_r15.tir")).tire;
}

inline TmeasyDescription tmeasy_tire() {
    return {.casing = magic_tire().casing,
            .nominal_load = 3000,
            .longitudinal = {TmeasyCurve{60e3, 0.12, 3400, 0.6, 3000}, TmeasyCurve{110e3, 0.14, 6400, 0.7, 5700}},
            .lateral = {TmeasyCurve{42e3, 0.2, 3000, 0.7, 2800}, TmeasyCurve{70e3, 0.22, 5600, 0.8, 5300}},
            .trail = {0.18, 0.19},
            .trail_vanishes = {0.2, 0.22},
            .trail_ends = {0.5, 0.55},
            .rolling_resistance = 0.012,
            .carcass_x = 310e3,
            .carcass_y = 125e3};
}

inline FialaDescription fiala_tire() {
    return {.casing = magic_tire().casing,
            .longitudinal_stiffness = 60e3,
            .cornering_stiffness = 38e3,
            .static_friction = 1.05,
            .sliding_friction = 0.85,
            .width = 0.195,
            .rolling_resistance = 0.012,
            .relaxation_x = 0.2,
            .relaxation_y = 0.3};
}

inline BrushDescription brush_tire() {
    return {.casing = magic_tire().casing,
            .nominal_load = 3000,
            .longitudinal_stiffness = 60e3,
            .cornering_stiffness = 38e3,
            .friction = 1,
            .contact_length = 0.18,
            .rolling_resistance = 0.012,
            .carcass_x = 310e3,
            .carcass_y = 125e3};
}

inline DugoffDescription dugoff_tire() {
    return {.casing = magic_tire().casing,
            .longitudinal_stiffness = 60e3,
            .cornering_stiffness = 38e3,
            .friction = 1,
            .rolling_resistance = 0.012,
            .relaxation_x = 0.2,
            .relaxation_y = 0.3};
}

inline std::vector<TireDescription> slip_tires() {
    return {magic_tire(), tmeasy_tire(), fiala_tire(), brush_tire(), dugoff_tire()};
}

}  // namespace hamilcar::test
