// The shipped car's tire on a roller: slip velocities as given functions of time, deflections integrated here.
#pragma once

#include "hamilcar/tire/linear_tire.hpp"
#include "support/car.hpp"

namespace hamilcar::test {

inline LinearTireDescription paper_tire() {
    return std::get<LinearTireDescription>(paper_car().suspensions[0].wheels[0].tire);
}

// A contact at rest under a vertical load; on a road of friction factor one.
inline TireContact<double> loaded(const LinearTireDescription& tire, double load) {
    TireContact<double> c{};
    c.depth = load / tire.vertical_stiffness;
    c.friction = 1;
    return c;
}

// One Runge-Kutta step of the deflections; contact_at(t) gives everything but u and v.
template <class ContactAt>
void advance(const LinearTire<double>& tire, const ContactAt& contact_at, double t, double h, Deflection<double>& d) {
    const auto rate = [&](double at, double u, double v) {
        TireContact<double> c = contact_at(at);
        c.u = u, c.v = v;
        return tire.force(c);
    };
    const auto k1 = rate(t, d.u, d.v);
    const auto k2 = rate(t + h / 2, d.u + h / 2 * k1.u_rate, d.v + h / 2 * k1.v_rate);
    const auto k3 = rate(t + h / 2, d.u + h / 2 * k2.u_rate, d.v + h / 2 * k2.v_rate);
    const auto k4 = rate(t + h, d.u + h * k3.u_rate, d.v + h * k3.v_rate);
    d.u += h / 6 * (k1.u_rate + 2 * k2.u_rate + 2 * k3.u_rate + k4.u_rate);
    d.v += h / 6 * (k1.v_rate + 2 * k2.v_rate + 2 * k3.v_rate + k4.v_rate);
}

// The force of a constant contact once its deflections have settled: after 40 relaxation lengths, e^-40.
inline TireForce<double> settled(const LinearTireDescription& description, TireContact<double> c) {
    const LinearTire<double> tire(description);
    const double length = std::max(description.relaxation_longitudinal, description.relaxation_lateral);
    const double speed = std::max(std::abs(c.v_x), 0.5), h = 0.2 * 0.2 / (speed + LinearTire<double>::return_speed);
    Deflection<double> d{c.u, c.v};
    for (double t = 0; t < 40 * length / speed; t += h)
        advance(
            tire, [&](double) { return c; }, t, h, d);
    c.u = d.u, c.v = d.v;
    return tire.force(c);
}

}  // namespace hamilcar::test
