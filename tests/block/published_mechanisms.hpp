// Mechanisms that others have published with answers, from their data.
#pragma once

#include "support/mechanisms.hpp"

namespace hamilcar::test {

inline constexpr double pi = std::numbers::pi;

// A round or a square steel bar as the Modelica Standard Library makes it: Parts.BodyCylinder, diameter 0.05 m, and
// Parts.BodyBox, width 0.05 m; 7700 kg/m^3.
inline void add_cylinder(Mechanism& to, std::size_t part, const Vec& from, const Vec& end) {
    const double length = (end - from).norm(), r = 0.025, mass = 7700 * pi * r * r * length;
    const double across = mass * (length * length + 3 * r * r) / 12;
    add_body(to, part, mass, (from + end) / 2, {mass * r * r / 2, across, across}, axes_along(end - from));
}
inline void add_box(Mechanism& to, std::size_t part, const Vec& from, const Vec& end) {
    const double length = (end - from).norm(), w = 0.05, mass = 7700 * w * w * length;
    const double across = mass * (length * length + w * w) / 12;
    add_body(to, part, mass, (from + end) / 2, {mass * w * w / 6, across, across}, axes_along(end - from));
}

// Modelica.Mechanics.MultiBody.Examples.Loops.PlanarFourbar, MSL 4: hinges at the origin, (0.4, 0), (0.5, 1.1) and
// (-0.15, 1); g = 9.80665 m/s^2 since MSL 4 (9.81 before, which misses the published table by a thousandth).
inline Mechanism msl_planar_four_bar() {
    const FourBar at{{0, 0, 0}, {0.4, 0, 0}, {0.5, 1.1, 0}, {-0.15, 1, 0}};
    Mechanism m = planar_four_bar(at);
    m.gravity = {0, -9.80665, 0};
    add_box(m, 1, at.O, at.A), add_box(m, 2, at.A, at.B), add_box(m, 3, at.D, at.B);
    return m;
}

// Modelica.Mechanics.MultiBody.Examples.Loops.Fourbar1: "one kinematic loop with four bars", R-S-U-P.
inline Mechanism msl_spatial_four_bar() {
    const SpatialSliderCrank at{{0, 0, 0}, {0, 0.5, 0.1}, {1, 0.2, 0}, Vec::UnitY(), Vec::UnitZ()};
    Mechanism m = spatial_slider_crank(at);
    m.gravity = {0, -9.80665, 0};
    add_cylinder(m, 1, at.A, at.B), add_cylinder(m, 3, at.S, at.B), add_cylinder(m, 2, {1, 0, 0}, at.S);
    return m;
}

// IFToMM benchmark library, "Spatial rigid slider-crank mechanism" (problem of R. Masoudi after Haug 1989, section
// 12.2): crank 0.08 m, rod 0.3 m, masses 0.12, 0.5 and 2 kg, crank at 6 rad/s upright. Its rod has moments 4e-4, 4e-3
// and 4e-3 kg m^2 in axes of its own, and those who solved it read them in two ways: the small one about the rod, or
// about the axis across the rod and the second axis of the universal joint.
enum class SmallMoment { along_rod, across_rod };
inline Mechanism iftomm_slider_crank(SmallMoment small) {
    const Vec A(0, 0.1, 0.12), B(0, 0.1, 0.2), S(0.2, 0, 0), rod = (B - S).normalized();
    const Vec second = Vec::UnitX().cross(rod).normalized();
    Mechanism m = spatial_slider_crank({A, B, S, Vec::UnitX(), second});
    m.gravity = {0, 0, -9.81};
    Mat3<double> axes;
    axes << rod, second, rod.cross(second);
    add_body(m, 1, 0.12, (A + B) / 2, {1e-4, 1e-5, 1e-4});
    const Vec moments = small == SmallMoment::along_rod ? Vec(4e-4, 4e-3, 4e-3) : Vec(4e-3, 4e-3, 4e-4);
    add_body(m, 3, 0.5, (B + S) / 2, moments, axes);
    add_body(m, 2, 2, S, {1e-4, 1e-4, 1e-4});
    return m;
}

// Crank, rod and slider of Flores, Leine, Glocker, Multibody System Dynamics 23 (2010) 165, without its clearance.
inline Mechanism flores_slider_crank() {
    const PlanarSliderCrank at{{0, 0, 0}, {0.153, 0, 0}, {0.459, 0, 0}};
    Mechanism m = planar_slider_crank(at);
    m.gravity = {0, -9.81, 0};
    add_body(m, 1, 0.038, (at.O + at.A) / 2, Vec::Constant(7.4e-5));
    add_body(m, 2, 0.038, (at.A + at.S) / 2, Vec::Constant(5.9e-4));
    add_body(m, 3, 0.076, at.S, Vec::Constant(2.7e-6));
    return m;
}

// R-S-U-R: the spatial four-bar of K. Ghobashy's uraeus (hardpoints of `spatial_fourbar_mod.csv`), in meters; its
// table is kinematic, so the bars are ours.
inline Mechanism uraeus_spatial_four_bar() {
    const Vec B(0, 0, 0.2), C(-0.75, -0.85, 0.65), E(-0.4, -0.85, 0), rod = B - C;
    const Vec first = rod.cross(Vec::UnitZ()).normalized();
    Mechanism m = spatial_four_bar({Vec::Zero(), B, C, E, first, rod.cross(first).normalized()});
    m.gravity = {0, 0, -9.81};
    add_cylinder(m, 1, Vec::Zero(), B), add_cylinder(m, 3, C, B), add_cylinder(m, 2, E, C);
    return m;
}

// IFToMM benchmark A02 (Gonzalez et al., Multibody System Dynamics 16 (2006) 179): N windows of equal bars, 1 m and 1
// kg each, one degree of freedom, which becomes N + 1 whenever the bars lie flat: there Phi_w is singular. While all
// cranks stay parallel, N windows move as one whose cranks weigh (N + 1) / 2 bars and whose coupler weighs N.
inline Mechanism windows(int N) {
    const FourBar at{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
    Mechanism m = planar_four_bar(at);
    m.gravity = {0, -9.81, 0};
    const double crank = (N + 1) / 2., coupler = N;
    add_body(m, 1, crank, (at.O + at.A) / 2, Vec::Constant(crank / 12));
    add_body(m, 2, coupler, (at.A + at.B) / 2, Vec::Constant(coupler / 12));
    add_body(m, 3, crank, (at.D + at.B) / 2, Vec::Constant(crank / 12));
    return m;
}

// Andrews' squeezer, IFToMM benchmark A03: three loops, seven bodies, a spring, a torque on the crank. Data and
// answer at 0.03 s of the Test Set for IVP Solvers (dm.uniba.it/~testset, "Andrews' squeezing mechanism"; also
// rdrr.io/cran/deTestSet, ex_andrews), a run of PSIDE with a tolerance of 1e-14. Its own equations with multipliers,
// integrated in long double for this test, end at the crank angle 15.81077119515 and not at ..119630: eleven digits
// of the published one are the problem's.
struct Squeezer {
    static Vec along(double angle) { return {std::cos(angle), std::sin(angle), 0}; }
    static Vec across(double angle) { return {std::sin(angle), -std::cos(angle), 0}; }
    // beta, Theta, gamma, Phi, delta, Omega, epsilon
    const double start[7] = {-0.0617138900142764496, 0,
                             0.455279819163070380,   0.222668390165885885,
                             0.487364979543842550,   -0.222668390165885885,
                             1.23054744454982119};
    const double end[7] = {15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                           0.5244099658805304, 0.5347301163226948, 1.048080741042263};
    const double end_rate[7] = {1139.920302151208,  -1424.379294994111, 11.03291221937134, 19.29337464421385,
                                0.5735699284790808, -19.29337464421385, 0.3231791658026955};
    const int coordinate[7] = {0, 1, 2, 4, 3, 6, 5};  // of the parts below

    Mechanism mechanism() const {
        const double beta = start[0], theta = start[1], gamma = start[2], phi = start[3], delta = start[4],
                     omega = start[5], epsilon = start[6];
        const Vec z = Vec::UnitZ(), A(-0.06934, -0.00227, 0), B(-0.03635, 0.03273, 0), C(0.014, 0.072, 0);
        const Vec P = 0.007 * along(beta), F = P - 0.028 * along(beta + theta), G = A + 0.04 * along(delta),
                  H = A + 0.04 * across(epsilon), D = B + 0.02 * along(gamma) + 0.018 * across(gamma);
        Mechanism m;
        const auto hinge = [&](std::size_t parent, const Vec& at) {
            return add_part(m, TreeJoint::revolute, parent, at, z);
        };
        const auto K1 = hinge(0, Vec::Zero()), K2 = hinge(K1, P), K3 = hinge(0, B), K5 = hinge(0, A), K4 = hinge(K5, G),
                   K7 = hinge(0, A), K6 = hinge(K7, H);
        for (const std::size_t part : {K3, K4, K6}) cut_hinge(m, K2, part, F);
        m.suspension.linkage.independent = {0};
        const auto body = [&](std::size_t part, double mass, const Vec& center, double inertia) {
            add_body(m, part, mass, center, Vec::Constant(inertia));
        };
        // A suspension has six bodies: the crank, which only turns about a fixed point, is a point mass at its pin, on
        // K2.
        const double pin = (2.194e-6 + 0.04325 * 0.00092 * 0.00092) / (0.007 * 0.007), own = 0.00365;
        const Vec middle = P - 0.0115 * along(beta + theta), both = (own * middle + pin * P) / (own + pin);
        body(K2, own + pin, both, 4.410e-7 + own * (middle - both).squaredNorm() + pin * (P - both).squaredNorm());
        body(K3, 0.02373, B + 0.01874 * along(gamma) + 0.01043 * across(gamma), 5.255e-6);
        body(K4, 0.00706, G + (0.02 - 0.01421) * across(phi + delta), 5.667e-7);
        body(K5, 0.07050, A + 0.02308 * along(delta) + 0.00916 * across(delta), 1.169e-5);
        body(K6, 0.00706, H + (0.02 - 0.01421) * along(omega + epsilon), 5.667e-7);
        body(K7, 0.05498, A + 0.01228 * along(epsilon) + 0.00449 * across(epsilon), 1.912e-5);
        const double rate = 4530, torque = 0.033;
        LineDescription spring{.part = K3, .on_part = point(D), .on_base = point(C), .coordinate = {}};
        m.suspension.springs.push_back({"spring", spring, {rate, -rate * ((D - C).norm() - 0.07785)}});
        m.suspension.springs.push_back({"motor", {.on_part = {}, .on_base = {}, .coordinate = 0}, {0, torque}});
        return m;
    }
};

}  // namespace hamilcar::test
