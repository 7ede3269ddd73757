// Reference implementation of the Magic Formula, line by line as published, for comparison only: MF 5.2 (as PAC2002 prints it) and
// MF 6.0 to 6.2 (Pacejka, Tire and Vehicle Dynamics, 3rd edition, (4.E1)-(4.E78); 6.0 has the 2nd edition's side force in the
// aligning moment). Every scaling factor and pressure term is where it is in print. ISO-W, rolling ahead, no turn slip.
//
// Where print and the vendors' solvers differ, this follows the solvers: camber is its sine throughout 6.x; the trail uses Fz0',
// overturning and rolling moment Fz0; rolling resistance is Fz0 (Fz/Fz0)^QSY7.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/description/tire.hpp"

namespace hamilcar::test {

struct LiteralInput {
    double load, kappa, alpha, gamma;  // [N, 1, rad, rad]
    double road = 1;                   // friction factor, as lambda_mu
    double speed = 16.7;               // [m/s], positive
};

struct LiteralAnswer {
    double Fx, Fy, Mx, Mz, resistance;
    double mu_x, mu_y, K_x, K_y, sigma_x, sigma_y;
};

class LiteralMagicFormula {
public:
    LiteralMagicFormula(const MagicFormulaDescription& d, const LiteralInput& in) : d_(d), p(d.coefficients), in_(in) {
        Fz = in.load, Fz0 = d.nominal_load, Fz0_ = p[LFZO] * Fz0, R0 = d.nominal_radius;
        dfz = (Fz - Fz0_) / Fz0_;
        dpi = d.nominal_pressure > 0 ? (d.pressure - d.nominal_pressure) / d.nominal_pressure : 0;
        alpha = d.angle_slip ? in.alpha : std::tan(in.alpha);
        gamma = d.angle_slip ? in.gamma : std::sin(in.gamma);
        lmu_x = p[LMUX] * in.road, lmu_y = p[LMUY] * in.road;
    }

    LiteralAnswer answer() {
        LiteralAnswer out{};
        out.Fx = pure_longitudinal(out) * G_xa();
        const Side side = pure_side(gamma);
        const double Gyk = G_yk(gamma), SVyk = S_Vyk(side.mu);
        out.Fy = Gyk * side.Fy0 + SVyk;
        const double flat = d_.upright_aligning_force ? G_yk(0) * pure_side(0).Fy0 : out.Fy - SVyk;
        out.mu_y = side.mu, out.K_y = side.K;
        out.Mz = aligning(side, out, flat);
        out.Mx = overturning(out.Fy);
        out.resistance = rolling(out.Fx);
        relaxation(out);
        return out;
    }

private:
    struct Side {
        double Fy0, mu, K, SH, SV, B, C;
    };

    static double sgn(double x) { return x < 0 ? -1 : 1; }
    static double bend(double B, double E, double x) { return B * x - E * (B * x - std::atan(B * x)); }

    // The friction scaling of vertical shifts: digressive in 6.x, (4.E8) with A_mu = 10.
    double of_shift(double lmu) const { return d_.angle_slip ? lmu : 10 * lmu / (1 + 9 * lmu); }

    double pure_longitudinal(LiteralAnswer& out) const {
        const double g = d_.angle_slip ? gamma * p[LGAX] : gamma;
        const double SHx = (p[PHX1] + p[PHX2] * dfz) * p[LHX], kx = in_.kappa + SHx, Cx = p[PCX1] * p[LCX];
        out.mu_x =
            (p[PDX1] + p[PDX2] * dfz) * (1 + p[PPX3] * dpi + p[PPX4] * dpi * dpi) * (1 - p[PDX3] * g * g) * lmu_x;
        const double Dx = out.mu_x * Fz;
        const double Ex =
            std::min(1.0, (p[PEX1] + p[PEX2] * dfz + p[PEX3] * dfz * dfz) * (1 - p[PEX4] * sgn(kx)) * p[LEX]);
        out.K_x = Fz * (p[PKX1] + p[PKX2] * dfz) * std::exp(p[PKX3] * dfz) * (1 + p[PPX1] * dpi + p[PPX2] * dpi * dpi) *
                  p[LKX];
        const double Bx = out.K_x / (Cx * Dx), SVx = Fz * (p[PVX1] + p[PVX2] * dfz) * p[LVX] * of_shift(lmu_x);
        return Dx * std::sin(Cx * std::atan(bend(Bx, Ex, kx))) + SVx;
    }

    Side pure_side(double camber) const {
        const double g = d_.angle_slip ? camber * p[LGAY] : camber;
        Side y;
        y.K = p[PKY1] * Fz0_ * (1 + p[PPY1] * dpi) * (1 - p[PKY3] * std::abs(g)) *
              std::sin(p[PKY4] * std::atan(Fz / Fz0_ / ((p[PKY2] + p[PKY5] * g * g) * (1 + p[PPY2] * dpi)))) * p[LKY];
        const double camber_scale = d_.angle_slip ? 1 : p[LKYC];
        const double SVyg = Fz * (p[PVY3] + p[PVY4] * dfz) * g * camber_scale * of_shift(lmu_y);
        const double Kyg0 = Fz * (p[PKY6] + p[PKY7] * dfz) * (1 + p[PPY5] * dpi) * camber_scale;
        y.SH = (p[PHY1] + p[PHY2] * dfz) * p[LHY] + (d_.camber_by_stiffness ? (Kyg0 * g - SVyg) / y.K : p[PHY3] * g);
        y.SV = Fz * (p[PVY1] + p[PVY2] * dfz) * p[LVY] * of_shift(lmu_y) + SVyg;
        y.C = p[PCY1] * p[LCY];
        y.mu = (p[PDY1] + p[PDY2] * dfz) * (1 + p[PPY3] * dpi + p[PPY4] * dpi * dpi) * (1 - p[PDY3] * g * g) * lmu_y;
        const double ay = alpha + y.SH, Dy = y.mu * Fz;
        const double Ey = std::min(
            1.0, (p[PEY1] + p[PEY2] * dfz) * (1 + p[PEY5] * g * g - (p[PEY3] + p[PEY4] * g) * sgn(ay)) * p[LEY]);
        y.B = y.K / (y.C * Dy);
        y.Fy0 = Dy * std::sin(y.C * std::atan(bend(y.B, Ey, ay))) + y.SV;
        return y;
    }

    static double weight(double B, double C, double E, double SH, double x) {
        return std::cos(C * std::atan(bend(B, E, x + SH))) / std::cos(C * std::atan(bend(B, E, SH)));
    }

    double G_xa() const {
        const double B = (p[RBX1] + p[RBX3] * gamma * gamma) * std::cos(std::atan(p[RBX2] * in_.kappa)) * p[LXAL];
        return weight(B, p[RCX1], std::min(1.0, p[REX1] + p[REX2] * dfz), p[RHX1], alpha);
    }

    double G_yk(double camber) const {
        const double B =
            (p[RBY1] + p[RBY4] * camber * camber) * std::cos(std::atan(p[RBY2] * (alpha - p[RBY3]))) * p[LYKA];
        return weight(B, p[RCY1], std::min(1.0, p[REY1] + p[REY2] * dfz), p[RHY1] + p[RHY2] * dfz, in_.kappa);
    }

    double S_Vyk(double mu) const {
        const double D = mu * Fz * (p[RVY1] + p[RVY2] * dfz + p[RVY3] * gamma) * std::cos(std::atan(p[RVY4] * alpha));
        return D * std::sin(p[RVY5] * std::atan(p[RVY6] * in_.kappa)) * p[LVYKA];
    }

    // Equivalent slip of the moments with longitudinal slip.
    double equivalent(double a, double ratio) const {
        const double k = ratio * in_.kappa;
        if (d_.angle_slip) return std::atan(std::hypot(std::tan(a), k)) * sgn(a);
        return std::hypot(a, k) * sgn(a);
    }

    double aligning(const Side& side, const LiteralAnswer& out, double flat) const {
        const double g = d_.angle_slip ? gamma * p[LGAZ] : gamma, size = std::abs(g), ratio = out.K_x / out.K_y;
        const double camber_scale = d_.angle_slip ? 1 : p[LKZC];
        const double SHt = p[QHZ1] + p[QHZ2] * dfz + (p[QHZ3] + p[QHZ4] * dfz) * g, at = alpha + SHt;
        const double Bt =
            (p[QBZ1] + p[QBZ2] * dfz + p[QBZ3] * dfz * dfz) * (1 + p[QBZ4] * g + p[QBZ5] * size) * p[LKY] / lmu_y;
        const double Ct = p[QCZ1], skew = d_.angle_slip ? g : size;
        const double Dt = Fz * R0 / (d_.angle_slip ? Fz0 : Fz0_) * (p[QDZ1] + p[QDZ2] * dfz) * (1 - p[PPZ1] * dpi) *
                          (1 + p[QDZ3] * skew + p[QDZ4] * g * g) * p[LTR];
        const double Et =
            std::min(1.0, (p[QEZ1] + p[QEZ2] * dfz + p[QEZ3] * dfz * dfz) *
                              (1 + (p[QEZ4] + p[QEZ5] * g) * 2 / std::numbers::pi * std::atan(Bt * Ct * at)));
        const double t = Dt * std::cos(Ct * std::atan(bend(Bt, Et, equivalent(at, ratio)))) * std::cos(in_.alpha);
        const double ar = alpha + side.SH + side.SV / side.K;
        const double Br = p[QBZ9] * p[LKY] / lmu_y + p[QBZ10] * side.B * side.C;
        const double Dr =
            Fz * R0 * lmu_y * std::cos(in_.alpha) *
            ((p[QDZ6] + p[QDZ7] * dfz) * p[LRES] +
             ((p[QDZ8] + p[QDZ9] * dfz) * (1 + p[PPZ2] * dpi) + (p[QDZ10] + p[QDZ11] * dfz) * size) * g * camber_scale);
        const double Mzr = Dr * std::cos(std::atan(Br * equivalent(ar, ratio)));
        const double s =
            R0 * p[LS] *
            (p[SSZ1] + p[SSZ2] * out.Fy / (d_.angle_slip ? Fz0 : Fz0_) + (p[SSZ3] + p[SSZ4] * dfz) * gamma);
        return -t * flat + Mzr + s * out.Fx;
    }

    double overturning(double Fy) const {
        const double steady = p[QSX1] * p[LVMX] - p[QSX2] * gamma * (1 + p[PPMX1] * dpi) + p[QSX3] * Fy / Fz0;
        const double lean = p[QSX4] * std::cos(p[QSX5] * std::atan(std::pow(p[QSX6] * Fz / Fz0, 2))) *
                            std::sin(p[QSX7] * gamma + p[QSX8] * std::atan(p[QSX9] * Fy / Fz0));
        const double rest = p[QSX10] * std::atan(p[QSX11] * Fz / Fz0) * gamma;
        const double later = Fy * (p[QSX13] + p[QSX14] * std::abs(gamma)) - p[QSX12] * Fz * gamma * std::abs(gamma);
        return R0 * p[LMX] * (Fz * (steady + lean + rest) + later);
    }

    double rolling(double Fx) const {
        const double v = in_.speed / d_.nominal_speed, pressure = 1 + dpi;
        return R0 * Fz0 * p[LMY] *
               (p[QSY1] + p[QSY2] * Fx / Fz0 + p[QSY3] * std::abs(v) + p[QSY4] * std::pow(v, 4) +
                (p[QSY5] + p[QSY6] * Fz / Fz0) * gamma * gamma) *
               std::pow(Fz / Fz0, p[QSY7]) * std::pow(pressure, p[QSY8]);
    }

    void relaxation(LiteralAnswer& out) const {
        if (!d_.relaxation_by_load) {
            out.sigma_x = std::abs(out.K_x) / d_.carcass_x, out.sigma_y = std::abs(out.K_y) / d_.carcass_y;
            return;
        }
        out.sigma_x = Fz * (p[PTX1] + p[PTX2] * dfz) * std::exp(-p[PTX3] * dfz) * R0 / Fz0 * p[LSGKP];
        out.sigma_y = p[PTY1] * std::sin(2 * std::atan(Fz / (p[PTY2] * Fz0_))) *
                      (1 - p[PKY3] * std::abs(gamma * p[LGAY])) * R0 * p[LFZO] * p[LSGAL];
    }

    const MagicFormulaDescription& d_;
    const MagicCoefficients& p;
    LiteralInput in_;
    double Fz, Fz0, Fz0_, R0, dfz, dpi, alpha, gamma, lmu_x, lmu_y;
};

inline LiteralAnswer literal_magic_formula(const MagicFormulaDescription& d, const LiteralInput& in) {
    return LiteralMagicFormula(d, in).answer();
}

}  // namespace hamilcar::test
