// Tires as a person writes them down. Signs and axes of a Magic Formula set are those of its file, ISO-W (docs/models/axes.md).
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "hamilcar/description/magic_coefficients.hpp"

namespace hamilcar {

// Linear tire with friction limit and relaxation, the paper's (docs/models/forces.md).
struct LinearTireDescription {
    double radius = 0;                   // unloaded [m]
    double rolling_radius = 0;           // effective [m]
    double vertical_stiffness = 0;       // [N/m]
    double vertical_damping = 0;         // [N s/m]
    double longitudinal_stiffness = 0;   // slip stiffness per load, C_kappa / Fz [1]
    double cornering_reference = 0;      // peak of C_alpha over load [N/rad]
    double cornering_load = 0;           // load at that peak [N]: C_alpha = 2 ref x / (1 + x^2), x = Fz / load
    double friction = 0;                 // [1]
    double relaxation_longitudinal = 0;  // [m]
    double relaxation_lateral = 0;       // [m]
    double carcass_damping = 0;          // damping time of the contact deflection [s]
    double rolling_resistance = 0;       // [1]
};

// A frictionless vertical spring that also pulls: for ride and energy studies, not for driving.
struct SpringTireDescription {
    double radius = 0;              // [m]
    double rolling_radius = 0;      // [m]
    double vertical_stiffness = 0;  // [N/m]
};

// What every tire with slip curves has besides them: Fz = stiffness d + growth d^2 + damping d'.
struct CasingDescription {
    double radius = 0;               // unloaded [m]
    double rolling_radius = 0;       // effective [m]
    double vertical_stiffness = 0;   // [N/m]
    double vertical_growth = 0;      // [N/m^2]
    double vertical_damping = 0;     // [N s/m]
    double carcass_damping = 0.004;  // damping time of the contact deflection [s]
};

// Pacejka's Magic Formula with the coefficients of a .tir file.
struct MagicFormulaDescription {
    CasingDescription casing;
    std::string name;                 // of the file, for messages
    bool angle_slip = false;          // MF 5.2 and older: slip angle and camber as angles; later tan(alpha), sin(gamma)
    bool camber_by_stiffness = true;  // MF 6: camber force by PKY6, PKY7; 5.2: by PHY3
    bool upright_aligning_force = false;               // MF 6.1 on: the trail works on the side force without camber
    bool relaxation_by_load = false;                   // MF 5.2: PTX, PTY; else by the stiffness of the carcass
    bool has_longitudinal = true, has_lateral = true;  // USE_MODE: forces that are computed at all ...
    bool has_combined = true;                          // ... and with each other
    double nominal_load = 0;                           // FNOMIN [N]
    double nominal_radius = 0;                         // R0 of the formulas [m]
    double nominal_pressure = 0;                       // NOMPRES [Pa]
    double pressure = 0;                               // INFLPRES [Pa]; as the nominal one: zero change
    double nominal_speed = 16.7;                       // LONGVL [m/s]
    double carcass_x = 0, carcass_y = 0;               // stiffness of the carcass against the rim [N/m]
    std::array<double, 2> load{0, 1e9};                // FZMIN, FZMAX [N]
    std::array<double, 2> slip{-1.5, 1.5};             // KPUMIN, KPUMAX [1]
    std::array<double, 2> angle{-1.5, 1.5};            // ALPMIN, ALPMAX [rad]
    std::array<double, 2> camber{-0.35, 0.35};         // CAMMIN, CAMMAX [rad]
    MagicCoefficients coefficients;
    std::vector<std::string> remarks;  // of who read the file: what it leaves open or is not used
};

// One direction of a TMeasy characteristic, at the load it was measured at.
struct TmeasyCurve {
    double stiffness = 0;      // dF0: force per slip at zero slip [N]
    double peak_slip = 0;      // sM [1]
    double peak_force = 0;     // FM [N]
    double sliding_slip = 0;   // sS [1]
    double sliding_force = 0;  // FS [N]
};

// Rill's TMeasy: curves by stiffness, peak and full sliding, at a load and at twice that load.
struct TmeasyDescription {
    CasingDescription casing;
    double nominal_load = 0;                           // [N]
    std::array<TmeasyCurve, 2> longitudinal, lateral;  // at the nominal load and twice it
    std::array<double, 2> trail{};                     // pneumatic trail over contact length at zero slip [1]
    std::array<double, 2> trail_vanishes{};            // lateral slip at which the trail is gone first [1]
    std::array<double, 2> trail_ends{};                // ... and for good [1]
    double friction = 1;                               // scales forces [1]
    double rolling_resistance = 0;                     // [1]
    double carcass_x = 0, carcass_y = 0;               // [N/m]
};

// Fiala's tire: a parabolic pressure, one friction that falls with slip, constant stiffnesses.
struct FialaDescription {
    CasingDescription casing;
    double longitudinal_stiffness = 0;          // CSLIP [N]
    double cornering_stiffness = 0;             // CALPHA [N/rad]
    double static_friction = 0;                 // UMAX [1]
    double sliding_friction = 0;                // UMIN, at full slip [1]
    double width = 0;                           // of the contact: lever of the aligning moment [m]
    double rolling_resistance = 0;              // [1]
    double relaxation_x = 0, relaxation_y = 0;  // [m]
};

// Brush model with a parabolic pressure: stiffness per load, one friction, half contact length as the root of the load.
struct BrushDescription {
    CasingDescription casing;
    double nominal_load = 0;              // [N]
    double longitudinal_stiffness = 0;    // at the nominal load [N]
    double cornering_stiffness = 0;       // at the nominal load [N/rad]
    double friction = 0;                  // [1]
    double contact_length = 0;            // at the nominal load [m]
    double rolling_resistance = 0;        // [1]
    double carcass_x = 0, carcass_y = 0;  // [N/m]
};

// Dugoff's tire: a uniform pressure, constant stiffnesses and friction.
struct DugoffDescription {
    CasingDescription casing;
    double longitudinal_stiffness = 0;          // [N]
    double cornering_stiffness = 0;             // [N/rad]
    double friction = 0;                        // [1]
    double rolling_resistance = 0;              // [1]
    double relaxation_x = 0, relaxation_y = 0;  // [m]
};

using TireDescription = std::variant<LinearTireDescription, SpringTireDescription, MagicFormulaDescription,
                                     TmeasyDescription, FialaDescription, BrushDescription, DugoffDescription>;

// Size and vertical spring of any tire.
inline CasingDescription casing_of(const TireDescription& tire) {
    const auto read = [](const auto& t) -> CasingDescription {
        using Description = std::decay_t<decltype(t)>;
        if constexpr (std::is_same_v<Description, LinearTireDescription>) {
            return {t.radius, t.rolling_radius, t.vertical_stiffness, 0, t.vertical_damping, t.carcass_damping};
        } else if constexpr (std::is_same_v<Description, SpringTireDescription>) {
            return {t.radius, t.rolling_radius, t.vertical_stiffness, 0, 0, 0};
        } else {
            return t.casing;
        }
    };
    return std::visit(read, tire);
}

}  // namespace hamilcar
