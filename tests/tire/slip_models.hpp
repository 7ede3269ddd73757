// One symmetric tire of every type with slip curves, and helpers of the tests: the curves themselves, and the tire with settled
// deflections.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/tire/list.hpp"
#include "hamilcar/tire/mirrored.hpp"
#include "support/paths.hpp"
#include "support/tires.hpp"
#include "tire/magic_sets.hpp"

namespace hamilcar::test {

struct SlipModel {
    std::string name;
    TireDescription description;
    double load;    // nominal [N]
    double radius;  // [m]
    // Measured bounds: of the combined force over the friction ellipse, and of the work over that exchanged which a closed path at a
    // standstill can release, while the contact sticks and while it slides in turn.
    double ellipse;
    std::array<double, 2> released;
    friend void PrintTo(const SlipModel& model, std::ostream* out) { *out << model.name; }
};

inline CasingDescription plain_casing() {
    return {.radius = 0.32,
            .rolling_radius = 0.31,
            .vertical_stiffness = 200e3,
            .vertical_growth = 0,
            .vertical_damping = 100,
            .carcass_damping = 0.004};
}

// The front tire of a HMMWV as published with Chrono (BSD-3), HMMWV_TMeasyTire.json; the carcass is estimated.
inline TmeasyDescription truck_tire() {
    TmeasyDescription d;
    d.casing = plain_casing();
    d.casing.radius = 0.4699, d.casing.rolling_radius = 0.45, d.casing.vertical_stiffness = 400e3;
    d.nominal_load = 8562.8266;
    d.longitudinal = {TmeasyCurve{151447.29, 0.12, 7575.3614, 0.9, 4657.9208},
                      TmeasyCurve{236412.79, 0.15, 12808.276, 0.95, 8625.3352}};
    d.lateral = {TmeasyCurve{50931.693, 0.38786, 6615.0404, 0.82534, 6091.5092},
                 TmeasyCurve{94293.847, 0.38786, 12509.947, 0.91309, 11443.875}};
    d.trail = {0.178, 0.19}, d.trail_vanishes = {0.40726, 0.40726}, d.trail_ends = {0.82534, 0.91309};
    d.rolling_resistance = 0.015, d.carcass_x = 600e3, d.carcass_y = 200e3;
    return d;
}

// Round numbers, whose forces are worked out by hand in slip_limits_test.cpp.
inline FialaDescription worked_fiala() {
    return {.casing = plain_casing(),
            .longitudinal_stiffness = 80e3,
            .cornering_stiffness = 60e3,
            .static_friction = 0.9,
            .sliding_friction = 0.7,
            .width = 0.2,
            .rolling_resistance = 0.01,
            .relaxation_x = 0.2,
            .relaxation_y = 0.4};
}

inline BrushDescription worked_brush() {
    return {.casing = plain_casing(),
            .nominal_load = 4000,
            .longitudinal_stiffness = 80e3,
            .cornering_stiffness = 60e3,
            .friction = 1,
            .contact_length = 0.15,
            .rolling_resistance = 0.01,
            .carcass_x = 310e3,
            .carcass_y = 125e3};
}

inline MagicFormulaDescription shipped_set() {
    return symmetric(io::read_tir(test::source_path("vehicles/tires/pacejka_205_60_r15.tir")).tire);
}

inline std::vector<SlipModel> slip_models() {
    std::mt19937 source(11);
    const auto random = [&](MagicVersion version) { return symmetric(random_magic_set(source, version)); };
    const auto old = random(MagicVersion::v52), late = random(MagicVersion::v61);
    return {{"shipped", shipped_set(), 3059, 0.2948, 1.03, {0.035, 0}},
            {"magic_52", old, 4000, 0.32, 1.02, {0.22, 0.04}},
            {"magic_61", late, 4000, 0.32, 1.21, {0.015, 0}},
            {"tmeasy", truck_tire(), 8562.8266, 0.4699, 1.02, {0.012, 0}},
            {"fiala", worked_fiala(), 4000, 0.32, 1, {2e-4, 0}},
            {"brush", worked_brush(), 4000, 0.32, 1, {0.032, 0.01}},
            {"dugoff", dugoff_tire(), 3000, 0.2948, 1, {0.046, 0}}};
}

inline TireForce<double> force(const Tire<double>& tire, const TireContact<double>& c) {
    return std::visit([&](const auto& model) { return model.force(c); }, tire);
}

// The curves, evaluated directly; empty for a tire without curves.
struct Curve {
    SlipLimits<double> limits;
    SlipForces<double> forces;
};
inline Curve curve(const Tire<double>& tire, double load, double friction, const Slip<double>& slip) {
    return std::visit(
        [&](const auto& model) -> Curve {
            if constexpr (requires { model.curves; }) {
                const auto at = model.curves.at_load(load, 0.0, friction);
                return {at.limits, model.curves.forces(at, slip)};
            } else {
                return {};
            }
        },
        tire);
}

// The relaxation length at a speed, with its lower bound.
inline double length(double sigma, double speed) {
    return std::max(sigma, 0.05 + std::abs(speed) / 300);
}

// Standing under a load, on a road of friction factor one.
inline TireContact<double> loaded(const Tire<double>& tire, double load) {
    TireContact<double> c{};
    c.friction = 1;
    for (int i = 0; i < 3; ++i) {  // the casings here are linear springs
        c.depth += 1e-3;
        c.depth *= load / force(tire, c).elastic;
    }
    return c;
}

// One Runge-Kutta step of the deflections; contact_at(t) gives everything but u and v.
template <class ContactAt>
void advance(const Tire<double>& tire, const ContactAt& contact_at, double t, double h, Deflection<double>& d) {
    const auto rate = [&](double at, double u, double v) {
        TireContact<double> c = contact_at(at);
        c.u = u, c.v = v;
        return force(tire, c);
    };
    const auto k1 = rate(t, d.u, d.v);
    const auto k2 = rate(t + h / 2, d.u + h / 2 * k1.u_rate, d.v + h / 2 * k1.v_rate);
    const auto k3 = rate(t + h / 2, d.u + h / 2 * k2.u_rate, d.v + h / 2 * k2.v_rate);
    const auto k4 = rate(t + h, d.u + h * k3.u_rate, d.v + h * k3.v_rate);
    d.u += h / 6 * (k1.u_rate + 2 * k2.u_rate + 2 * k3.u_rate + k4.u_rate);
    d.v += h / 6 * (k1.v_rate + 2 * k2.v_rate + 2 * k3.v_rate + k4.v_rate);
}

// A constant contact with settled deflections.
inline TireContact<double> settled(const Tire<double>& tire, TireContact<double> c) {
    Deflection<double> d{c.u, c.v};
    for (int i = 0; i < 40000; ++i) {
        advance(
            tire, [&](double) { return c; }, 0, 5e-4, d);
        const double moved = std::abs(d.u - c.u) + std::abs(d.v - c.v);
        c.u = d.u, c.v = d.v;
        if (moved < 1e-15) break;
    }
    return c;
}

}  // namespace hamilcar::test
