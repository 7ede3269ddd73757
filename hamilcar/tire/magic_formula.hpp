// Pacejka's Magic Formula, MF 5.2 to 6.2: forces and moments of steady rolling from slip, camber and load, pure and combined
// (Pacejka, Tire and Vehicle Dynamics, 3rd edition, (4.E1)-(4.E78), without turn slip). ISO-W axes.
//
//     y = D sin(C atan(B x - E (B x - atan B x)))          every curve; a weight has cos and starts at 1
// Scaling factors and inflation pressure are multiplied into the coefficients beforehand (magic_formula.cpp). Terms that most
// sets omit are skipped where no lane uses them.
#pragma once

#include <tuple>

#include "hamilcar/tire/slip_tire.hpp"

namespace hamilcar {

// The coefficients after scaling factors and inflation pressure have been applied.
MagicCoefficients scaled(const MagicFormulaDescription& description);

template <class T>
struct MagicFormula {
    static constexpr std::string_view keyword = "magic_formula";
    T nominal_load, inverse_nominal_load;                       // with LFZO [N, 1/N]
    T nominal_radius, inverse_speed;                            // R0 [m], 1/LONGVL [s/m]
    T min_load, max_load;                                       // [N]
    T inverse_min_load;                                         // [1/N]
    std::array<T, 2> slip, slope;                               // limits of kappa and of tan(alpha)
    T max_camber;                                               // of sin(gamma)
    T carcass_x, carcass_y;                                     // 1 / stiffness [m/N]; zero: relaxation by load
    T angle_slip, camber_by_stiffness, upright_aligning_force;  // 1 or 0
    T along, across;                                            // 1, or 0 for forces that the file omits
    T combined;                // 1, or 0 where longitudinal slip does not affect the moment
    T friction_x, friction_y;  // LMUX, LMUY
    std::array<T, magic_in_step> c;
    static constexpr auto members() {
        using M = MagicFormula;
        return std::tuple(&M::nominal_load, &M::inverse_nominal_load, &M::nominal_radius, &M::inverse_speed,
                          &M::min_load, &M::max_load, &M::inverse_min_load, &M::slip, &M::slope, &M::max_camber,
                          &M::carcass_x, &M::carcass_y, &M::angle_slip, &M::camber_by_stiffness,
                          &M::upright_aligning_force, &M::along, &M::across, &M::combined, &M::friction_x,
                          &M::friction_y, &M::c);
    }

    MagicFormula() = default;
    explicit MagicFormula(const MagicFormulaDescription& d);

    // Quantities that depend only on load, camber and the road's friction.
    struct AtLoad {
        SlipLimits<T> limits;
        T Fz, dfz, ratio;  // load, its relative change, load over the nominal one
        T gamma, gamma_square, gamma_size;
        T mu_x, mu_y;  // mu_y with the sign of PDY1
        T K_x, K_y;    // K_y with the sign of PKY1
        T B_x, B_y, inverse_K_y;
        T H_y, V_y;            // shifts of the side force
        T lambda_x, lambda_y;  // scaling of the friction by the road and by LMU: lambda*
    };

    AtLoad at_load(const T& load, const T& camber, const T& friction) const {
        AtLoad at;
        at.Fz = min(load, max_load);
        at.ratio = at.Fz * inverse_nominal_load;
        at.dfz = at.ratio - T(1);
        at.lambda_x = friction_x * friction, at.lambda_y = friction_y * friction;
        at.K_x = at.Fz * (c[PKX1] + c[PKX2] * at.dfz) * exponential_of(c[PKX3], at.dfz);
        const T gamma = angle_of(clamp(camber, T(-max_camber), max_camber));
        at.mu_x = (c[PDX1] + c[PDX2] * at.dfz) * (T(1) - c[PDX3] * gamma * gamma) * at.lambda_x;
        add_camber(at, gamma);
        at.limits.stiffness_x = abs(at.K_x), at.limits.stiffness_y = abs(at.K_y);
        at.limits.friction_x = abs(at.mu_x) * at.Fz, at.limits.friction_y = abs(at.mu_y) * at.Fz;
        at.limits.softness_x = abs(at.B_x * c[PCX1]), at.limits.softness_y = abs(at.B_y * c[PCY1]);
        relaxation(at);
        return at;
    }

    SlipForces<T> forces(const AtLoad& at, const Slip<T>& wanted_slip) const {
        const T kappa = clamp(wanted_slip.longitudinal, slip[0], slip[1]);
        const T tangent = clamp(wanted_slip.lateral, slope[0], slope[1]);
        T alpha = tangent;
        if (any(angle_slip > T(0))) alpha = select(angle_slip > T(0), arctangent(tangent), tangent);
        const T own = any(at.lambda_y != T(1)) ? T(1) / at.lambda_y : T(1);
        // Independent arc tangents are computed together, then those of the curves with E.
        const Curve x = longitudinal(at, kappa), y = lateral(at, alpha);
        const Weight along_weight = longitudinal_weight(at, kappa, alpha),
                     side_weight = lateral_weight(at, kappa, alpha);
        Trail trail = pneumatic_trail(at, kappa, alpha, own);
        const auto first = arctangents<T, 4>({x.z, y.z, trail.curve.z, trail.turn}, {T(1), T(1), T(1), T(1)});
        const auto second = arctangents<T, 3>({along_weight.y, side_weight.y, T(c[RVY6] * kappa)},
                                              {along_weight.x, side_weight.x, T(1)});
        trail.bend(first[3]);
        const auto bent =
            arctangents<T, 3>({x.bent(first[0]), y.bent(first[1]), trail.curve.bent(first[2])}, {T(1), T(1), T(1)});
        const Slants slant = slants(at, trail.pulled, alpha, own);
        const T Fx =
            (at.mu_x * at.Fz * sine(T(c[PCX1] * bent[0])) + longitudinal_shift(at)) * along_weight.value(second[0]);
        const T pushed = induced_side_force(at, slant.push) * sine(T(c[RVY5] * second[2]));
        T upright = (at.mu_y * at.Fz * sine(T(c[PCY1] * bent[1])) + at.V_y) * side_weight.value(second[1]);
        const T Fy = upright + pushed;
        if (any(upright_aligning_force > T(0))) {
            upright = select(upright_aligning_force > T(0), force_without_camber(at, kappa, alpha), upright);
        }
        const T lever = trail.length * wanted_slip.ahead * cosine(T(c[QCZ1] * bent[2]));
        return {.Fx = along * Fx,
                .Fy = across * Fy,
                .Mx = across * overturning(at, Fy),
                .Mz = across * (residual_moment(at, slant.residual) * wanted_slip.ahead - lever * upright +
                                moment_arm(at, Fy) * Fx),
                .resistance = rolling_resistance(at, Fx, wanted_slip.v_x)};
    }

private:
    // B x, and E; `angle` is atan(B x).
    struct Curve {
        T z, E;
        T bent(const T& angle) const { return z - E * (z - angle); }
    };
    // A weight at x + shift, B (x + shift) = y / x, over that at the shift alone, B shift = shifted / x.
    struct Weight {
        T y, x, shifted, C, E;

        // `angle` is atan(y / x).
        T value(const T& angle) const {
            const T here = at(y, angle);
            if (!any(shifted != T(0))) return here;
            return select(shifted != T(0), T(here / at(shifted, arctangent(shifted, x))), here);
        }

    private:
        T at(const T& over, T angle) const {
            if (any(E != T(0))) {
                const T z = over / x;
                angle = select(E != T(0), arctangent(T(z - E * (z - angle))), angle);
            }
            return cosine(T(C * angle));
        }
    };
    static T exponential_of(const T& factor, const T& dfz) {
        return any(factor != T(0)) ? exponential(T(factor * dfz)) : T(1);
    }
    // Camber angle from its sine, as older sets use it.
    T angle_of(const T& s) const {
        if (!any(angle_slip > T(0))) return s;
        const T z = s * s;
        return select(angle_slip > T(0), T(s * (T(1) + z * (T(1.0 / 6) + z * (T(3.0 / 40) + z * T(15.0 / 336))))), s);
    }

    // K_y = over / under.
    struct Quotient {
        T over, under;
    };
    Quotient cornering_stiffness(const AtLoad& at) const {  // (4.E25)
        const T x = at.ratio, y = c[PKY2] + c[PKY5] * at.gamma_square;
        T over = (x + x) * y, under = x * x + y * y;  // sin(2 atan(x / y))
        if (any(c[PKY4] != T(2))) {
            over = select(c[PKY4] != T(2), sine(T(c[PKY4] * arctangent(T(x / y)))), over);
            under = select(c[PKY4] != T(2), T(1), under);
        }
        return {c[PKY1] * nominal_load * over * (T(1) - c[PKY3] * at.gamma_size), under};
    }

    // lambda' of the road's friction: shifts decrease more slowly than forces, (4.E8).
    T degressive(const T& own) const {
        if (!any(own != T(1))) return T(1);
        return select(angle_slip > T(0), own, T(T(10) * own / (T(1) + T(9) * own)));
    }
    // Camber terms of the side force.
    void add_camber(AtLoad& at, const T& gamma) const {  // (4.E23)-(4.E30)
        at.gamma = gamma;
        at.gamma_square = gamma * gamma;
        at.gamma_size = abs(gamma);
        at.mu_y = (c[PDY1] + c[PDY2] * at.dfz) * (T(1) - c[PDY3] * at.gamma_square) * at.lambda_y;
        const Quotient K = cornering_stiffness(at);
        const auto over = reciprocals<T, 4>({K.over, K.under, c[PCY1] * at.mu_y * at.Fz, c[PCX1] * at.mu_x * at.Fz});
        at.K_y = K.over * over[1], at.inverse_K_y = K.under * over[0];
        at.B_y = at.K_y * over[2], at.B_x = at.K_x * over[3];
        const T own = at.Fz * degressive(at.lambda_y), V_gamma = own * (c[PVY3] + c[PVY4] * at.dfz) * gamma;
        const T K_gamma = at.Fz * (c[PKY6] + c[PKY7] * at.dfz);
        at.H_y = c[PHY1] + c[PHY2] * at.dfz + c[PHY3] * gamma +
                 camber_by_stiffness * (K_gamma * gamma - V_gamma) * at.inverse_K_y;
        at.V_y = own * (c[PVY1] + c[PVY2] * at.dfz) + V_gamma;
    }
    AtLoad without_camber(const AtLoad& at) const {
        AtLoad flat = at;
        add_camber(flat, T(0));
        return flat;
    }

    void relaxation(AtLoad& at) const {
        at.limits.relaxation_x = at.limits.stiffness_x * carcass_x;
        at.limits.relaxation_y = at.limits.stiffness_y * carcass_y;
        if (!any(carcass_x == T(0))) return;
        const T x = at.ratio / max(c[PTY2], T(1e-6));
        const T by_load_x = at.ratio * nominal_radius * (c[PTX1] + c[PTX2] * at.dfz) * exponential_of(-c[PTX3], at.dfz);
        const T by_load_y = c[PTY1] * nominal_radius * (x + x) / (T(1) + x * x) * (T(1) - c[PKY3] * at.gamma_size);
        at.limits.relaxation_x = select(carcass_x == T(0), by_load_x, at.limits.relaxation_x);
        at.limits.relaxation_y = select(carcass_y == T(0), by_load_y, at.limits.relaxation_y);
    }

    Curve longitudinal(const AtLoad& at, const T& kappa) const {  // (4.E9)-(4.E18)
        const T x = kappa + c[PHX1] + c[PHX2] * at.dfz;
        const T side = select(x < T(0), T(1) + c[PEX4], T(1) - c[PEX4]);
        return {at.B_x * x, min((c[PEX1] + at.dfz * (c[PEX2] + c[PEX3] * at.dfz)) * side, T(1))};
    }
    T longitudinal_shift(const AtLoad& at) const {
        return at.Fz * (c[PVX1] + c[PVX2] * at.dfz) * degressive(at.lambda_x);
    }
    Weight longitudinal_weight(const AtLoad& at, const T& kappa, const T& alpha) const {
        const T B = c[RBX1] + c[RBX3] * at.gamma_square, scaled_slip = c[RBX2] * kappa;  // (4.E50)-(4.E57)
        return {B * (alpha + c[RHX1]), sqrt(T(1) + scaled_slip * scaled_slip), B * c[RHX1], c[RCX1],
                min(c[REX1] + c[REX2] * at.dfz, T(1))};
    }

    Curve lateral(const AtLoad& at, const T& alpha) const {  // (4.E19)-(4.E30)
        const T x = alpha + at.H_y;
        const T skew = c[PEY3] + c[PEY4] * at.gamma;
        const T side = T(1) + c[PEY5] * at.gamma_square + select(x < T(0), skew, T(-skew));
        return {at.B_y * x, min((c[PEY1] + c[PEY2] * at.dfz) * side, T(1))};
    }
    Weight lateral_weight(const AtLoad& at, const T& kappa, const T& alpha) const {  // (4.E58)-(4.E67)
        const T B = c[RBY1] + c[RBY4] * at.gamma_square, scaled_slip = c[RBY2] * (alpha - c[RBY3]);
        const T shift = c[RHY1] + c[RHY2] * at.dfz;
        return {B * (kappa + shift), sqrt(T(1) + scaled_slip * scaled_slip), B * shift, c[RCY1],
                min(c[REY1] + c[REY2] * at.dfz, T(1))};
    }
    // The side force that the trail of MF 6.1 acts on.
    T force_without_camber(const AtLoad& at, const T& kappa, const T& alpha) const {
        const AtLoad flat = without_camber(at);
        const Curve y = lateral(flat, alpha);
        const Weight weight = lateral_weight(flat, kappa, alpha);
        const T force = flat.mu_y * flat.Fz * sine(T(c[PCY1] * arctangent(y.bent(arctangent(y.z))))) + flat.V_y;
        return force * weight.value(arctangent(weight.y, weight.x));
    }
    // Amplitude of the side force induced by longitudinal slip; `slant` is cos(atan(RVY4 alpha)).
    T induced_side_force(const AtLoad& at, const T& slant) const {
        return at.mu_y * at.Fz * (c[RVY1] + c[RVY2] * at.dfz + c[RVY3] * at.gamma) * slant;
    }

    // The square of the combined lateral and longitudinal slip, as an angle in older sets.
    T combined_slip_square(const T& x, const T& pulled) const {
        T square = x * x + pulled;
        if (any(angle_slip > T(0))) {
            const T run = cosine(x), rise = sine(x), whole = sqrt(rise * rise + pulled * run * run);
            const T angle = arctangent(whole, max(abs(run), T(1e-6)));
            square = select(angle_slip > T(0), angle * angle, square);
        }
        return square;
    }
    // Two independent cosines of arc tangents, with one division.
    struct Slants {
        T push, residual;
    };
    Slants slants(const AtLoad& at, const T& pulled, const T& alpha, const T& own) const {
        const T rest = alpha + at.H_y + at.V_y * at.inverse_K_y, B = c[QBZ9] * own + c[QBZ10] * at.B_y;
        const T pushed = c[RVY4] * alpha;
        const auto cosines =
            reciprocals<T, 2>({sqrt(T(1) + pushed * pushed), sqrt(T(1) + B * B * combined_slip_square(rest, pulled))});
        return {cosines[0], cosines[1]};
    }

    T overturning(const AtLoad& at, const T& Fy) const {  // (4.E69)
        const T side = Fy * inverse_nominal_load;
        T arm = c[QSX1] - at.gamma * (c[QSX2] + c[QSX12] * at.gamma_size) + c[QSX3] * side;
        if (any(c[QSX4] != T(0) || c[QSX10] != T(0))) {
            const T x = c[QSX6] * at.ratio;
            arm += c[QSX4] * cosine(T(c[QSX5] * arctangent(T(x * x)))) *
                       sine(T(c[QSX7] * at.gamma + c[QSX8] * arctangent(T(c[QSX9] * side)))) +
                   c[QSX10] * arctangent(T(c[QSX11] * at.ratio)) * at.gamma;
        }
        return nominal_radius * (at.Fz * arm + Fy * (c[QSX13] + c[QSX14] * at.gamma_size));
    }

    T rolling_resistance(const AtLoad& at, const T& Fx, const T& v_x) const {  // (4.E70)
        const T v = abs(v_x) * inverse_speed, vv = v * v;
        T share = c[QSY1] + c[QSY2] * Fx * inverse_nominal_load + c[QSY3] * v + c[QSY4] * vv * vv +
                  (c[QSY5] + c[QSY6] * at.ratio) * at.gamma_square;
        T load = at.ratio;
        if (any(c[QSY7] != T(1))) load = select(c[QSY7] != T(1), exponential(T(c[QSY7] * logarithm(load))), load);
        return nominal_radius * nominal_load * load * share;
    }

    // The pneumatic trail, D cos(C atan(curve)); E depends on the arc tangent of `turn`.
    struct Trail {
        T length, turn, turned, pulled;  // D without the sign of `ahead`; `turned`: asymmetric part of E
        Curve curve;
        void bend(const T& angle) { curve.E = min(curve.E * (T(1) + turned * T(0.636619772367581343) * angle), T(1)); }
    };
    Trail pneumatic_trail(const AtLoad& at, const T& kappa, const T& alpha, const T& own) const {
        const T stretch = combined * at.K_x * at.inverse_K_y * kappa, pulled = stretch * stretch, gamma = at.gamma;
        const T x = alpha + c[QHZ1] + c[QHZ2] * at.dfz + (c[QHZ3] + c[QHZ4] * at.dfz) * gamma;
        const T size = sqrt(combined_slip_square(x, pulled)), whole = select(x < T(0), T(-size), size);
        const T B = (c[QBZ1] + at.dfz * (c[QBZ2] + c[QBZ3] * at.dfz)) *
                    (T(1) + c[QBZ4] * gamma + c[QBZ5] * at.gamma_size) * own;
        const T tilt = select(angle_slip > T(0), gamma, at.gamma_size);
        const T D = at.Fz * nominal_radius * inverse_nominal_load * (c[QDZ1] + c[QDZ2] * at.dfz) *
                    (T(1) + c[QDZ3] * tilt + c[QDZ4] * at.gamma_square);
        return {D,
                B * c[QCZ1] * x,
                c[QEZ4] + c[QEZ5] * gamma,
                pulled,
                {B * whole, c[QEZ1] + at.dfz * (c[QEZ2] + c[QEZ3] * at.dfz)}};  // (4.E31)-(4.E49)
    }
    T residual_moment(const AtLoad& at, const T& slant) const {
        return at.Fz * nominal_radius * at.lambda_y * slant *
               (c[QDZ6] + c[QDZ7] * at.dfz +
                at.gamma * (c[QDZ8] + c[QDZ9] * at.dfz + (c[QDZ10] + c[QDZ11] * at.dfz) * at.gamma_size));
    }
    // Lever of the longitudinal force.  // (4.E76)
    T moment_arm(const AtLoad& at, const T& Fy) const {
        return nominal_radius *
               (c[SSZ1] + c[SSZ2] * Fy * inverse_nominal_load + (c[SSZ3] + c[SSZ4] * at.dfz) * at.gamma);
    }
};

template <class T>
MagicFormula<T>::MagicFormula(const MagicFormulaDescription& d)
    : nominal_load(d.nominal_load * d.coefficients[LFZO]),
      inverse_nominal_load(1 / (d.nominal_load * d.coefficients[LFZO])),
      nominal_radius(d.nominal_radius),
      inverse_speed(1 / d.nominal_speed),
      min_load(std::max(d.load[0], 0.02 * d.nominal_load)),
      max_load(d.load[1]),
      inverse_min_load(1 / std::max(d.load[0], 0.02 * d.nominal_load)),
      slip{T(d.slip[0]), T(d.slip[1])},
      slope{T(std::tan(d.angle[0])), T(std::tan(d.angle[1]))},
      max_camber(std::sin(std::min(d.camber[1], -d.camber[0]))),
      carcass_x(d.relaxation_by_load ? 0 : 1 / d.carcass_x),
      carcass_y(d.relaxation_by_load ? 0 : 1 / d.carcass_y),
      angle_slip(d.angle_slip ? 1 : 0),
      camber_by_stiffness(d.camber_by_stiffness ? 1 : 0),
      upright_aligning_force(d.upright_aligning_force ? 1 : 0),
      along(d.has_longitudinal ? 1 : 0),
      across(d.has_lateral ? 1 : 0),
      combined(d.has_combined ? 1 : 0),
      friction_x(d.coefficients[LMUX]),
      friction_y(d.coefficients[LMUY]) {
    const MagicCoefficients all = scaled(d);
    for (std::size_t i = 0; i < magic_in_step; ++i) c[i] = T(all[i]);
}

}  // namespace hamilcar
