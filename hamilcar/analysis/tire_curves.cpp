#include "hamilcar/analysis/tire_curves.hpp"

#include <cmath>
#include <limits>

namespace hamilcar {

namespace {

// Deflection of the casing that carries a load, by Newton's method.
double depth_for(const auto& tire, double load) {
    double depth = 0.01;
    for (int i = 0; i < 50; ++i) {
        TireContact<double> c{};
        c.friction = 1;
        const auto carried = [&](double at) {
            c.depth = at;
            return tire.force(c).elastic;
        };
        constexpr double probe = 1e-6;
        const double slope = (carried(depth + probe) - carried(depth - probe)) / (2 * probe);
        const double step = (load - carried(depth)) / slope;
        depth = std::max(depth + step, 1e-5);
        if (std::abs(step) < 1e-13) break;
    }
    return depth;
}

// Until the deflections stand still: Heun steps well within what the fastest return allows.
template <class Model>
TireForce<double> settled(const Model& tire, TireContact<double> c) {
    constexpr double h = 1e-3, enough = 1e-12;
    TireForce<double> force = tire.force(c);
    for (int i = 0; i < 20000; ++i) {
        const TireContact<double> start = c;
        c.u += h * force.u_rate, c.v += h * force.v_rate;
        const TireForce<double> next = tire.force(c);
        c.u = start.u + h / 2 * (force.u_rate + next.u_rate);
        c.v = start.v + h / 2 * (force.v_rate + next.v_rate);
        force = tire.force(c);
        if (std::abs(force.u_rate) + std::abs(force.v_rate) < enough) break;
    }
    return force;
}

}  // namespace

TireForce<double> steady_force(const Tire<double>& any_tire, const SteadyRolling& rolling) {
    return std::visit(
        [&](const auto& tire) {
            const double v = rolling.speed, size = std::abs(v);
            TireContact<double> c{};
            c.depth = depth_for(tire, rolling.load);
            c.v_x = v;
            c.v_sx = -rolling.kappa * size, c.v_sy = std::tan(rolling.alpha) * size;
            c.camber = std::sin(rolling.camber);
            c.omega = (v - c.v_sx) / tire.rolling_radius;
            c.friction = 1;
            return settled(tire, c);
        },
        any_tire);
}

TireFigures tire_figures(const Tire<double>& tire, double load) {
    constexpr double probe = 1e-4;
    const auto force = [&](double kappa, double alpha, double camber = 0) {
        return steady_force(tire, {.load = load, .kappa = kappa, .alpha = alpha, .camber = camber});
    };
    TireFigures f{.load = load};
    f.slip_stiffness = (force(probe, 0).Fx - force(-probe, 0).Fx) / (2 * probe);
    const TireForce<double> left = force(0, probe), right = force(0, -probe);
    f.cornering_stiffness = (right.Fy - left.Fy) / (2 * probe);
    f.camber_stiffness = (force(0, 0, -probe).Fy - force(0, 0, probe).Fy) / (2 * probe);
    constexpr double nothing = 1e-9;  // of the load: rounding, and no force to have a trail
    const double lateral = right.Fy - left.Fy;
    const bool corners = std::abs(lateral) > nothing * load;
    f.trail = corners ? (left.Mz - right.Mz) / lateral : std::numeric_limits<double>::quiet_NaN();
    for (int i = 1; i <= 600; ++i) {
        const double alpha = 1e-3 * i, kappa = 1e-3 * i;
        const double y = std::abs(force(0, alpha).Fy) / load, x = force(kappa, 0).Fx / load;
        if (y > f.peak_y) f.peak_y = y, f.peak_alpha = alpha;
        if (x > f.peak_x) f.peak_x = x, f.peak_kappa = kappa;
    }
    f.sliding_x = -force(-1, 0).Fx / load;
    return f;
}

TireCurves tire_curves(const Tire<double>& tire, const std::vector<double>& loads) {
    TireCurves out;
    const auto sweep = [&](double load, double first, double last, auto&& rolling) {
        constexpr int steps = 120;
        TireCurve curve{.load = load, .slip = {}, .force = {}};
        for (int i = 0; i <= steps; ++i) {
            curve.slip.push_back(first + (last - first) * i / steps);
            curve.force.push_back(steady_force(tire, rolling(curve.slip.back())));
        }
        return curve;
    };
    constexpr double widest = 0.35;  // 20 degrees
    for (const double load : loads) {
        out.longitudinal.push_back(
            sweep(load, -1, 1, [&](double kappa) { return SteadyRolling{.load = load, .kappa = kappa}; }));
        out.lateral.push_back(
            sweep(load, -widest, widest, [&](double alpha) { return SteadyRolling{.load = load, .alpha = alpha}; }));
    }
    const double middle = loads[loads.size() / 2];
    for (const double alpha : {0.0, 0.035, 0.07, 0.14}) {
        out.combined_alpha.push_back(alpha);
        out.combined.push_back(sweep(middle, -1, 1, [&](double kappa) {
            return SteadyRolling{.load = middle, .kappa = kappa, .alpha = alpha};
        }));
    }
    return out;
}

}  // namespace hamilcar
