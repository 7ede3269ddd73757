#include "hamilcar/integrator/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hamilcar {

namespace {

using Complex = std::complex<double>;

// 1 + z b (I - z A)^-1 1, by the stages.
double growth(const Tableau& method, Complex z) {
    std::array<Complex, max_stages> rate{};
    Complex end = 1;
    for (std::size_t s = 0; s < static_cast<std::size_t>(method.stages); ++s) {
        rate[s] = 1;
        for (std::size_t j = 0; j < s; ++j) rate[s] += z * method.stage[s][j] * rate[j];
        end += z * method.weights[s] * rate[s];
    }
    return std::abs(end);
}

// Largest modulus of the roots of x^n + c_1 x^(n-1) + ... + c_n, all at once by Weierstrass's iteration.
double largest_root(std::span<const Complex> c) {
    constexpr int iterations = 200;
    constexpr double accuracy = 1e-12;
    std::array<Complex, max_adams_order> root;
    const std::size_t n = c.size();
    double size = 0;
    for (const Complex& one : c) size = std::max(size, std::abs(one));
    for (std::size_t i = 0; i < n; ++i) root[i] = (1 + size) * std::pow(Complex(0.4, 0.9), static_cast<double>(i));
    for (int k = 0; k < iterations; ++k) {
        double moved = 0;
        for (std::size_t i = 0; i < n; ++i) {
            Complex value = 1, others = 1;
            for (const Complex& one : c) value = value * root[i] + one;
            for (std::size_t j = 0; j < n; ++j) others *= j == i ? Complex(1) : root[i] - root[j];
            const Complex step = value / others;
            root[i] -= step, moved = std::max(moved, std::abs(step));
        }
        if (!(moved > accuracy)) break;
    }
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(root[i]));
    return largest;
}

// y_{n+1} = sum_j d_j y_{n-j}: predicted, and where it is corrected evaluated there and corrected.
double growth(const Method& method, Complex z, bool corrected) {
    const auto order = static_cast<std::size_t>(method.order);
    const AdamsRow &b = adams_bashforth[order - 1], &a = adams_moulton[order - 1];
    std::array<Complex, max_adams_order> c;
    for (std::size_t j = 0; j < order; ++j) {
        const Complex predicted = z * b[j] + (j == 0 ? 1.0 : 0.0);
        const Complex past = j + 1 < order ? z * a[j + 1] : 0;
        c[j] = corrected ? -(z * a[0] * predicted + past + (j == 0 ? 1.0 : 0.0)) : -predicted;
    }
    return largest_root(std::span(c.data(), order));
}

}  // namespace

double growth(const Method& method, Complex z) {
    switch (method.family) {
        case MethodFamily::adams_bashforth: return growth(method, z, false);
        case MethodFamily::adams_bashforth_moulton: return growth(method, z, true);
        case MethodFamily::runge_kutta: return growth(classical_runge_kutta, z);
        case MethodFamily::embedded_runge_kutta: return growth(dormand_prince, z);
    }
    return 0;
}

double spurious_growth(const Method& method, double step, Complex lambda) {
    return std::log(growth(method, step * lambda)) / step - std::max(lambda.real(), 0.0);
}

bool is_stable(const Method& method, double step, std::span<const Complex> lambda) {
    constexpr double slow = 1e-3;  // of |lambda h|: every method of order one or more follows
    return std::ranges::all_of(lambda, [&](const Complex& one) {
        return step * std::abs(one) < slow || spurious_growth(method, step, one) <= tolerated_growth;
    });
}

double stable_step(const Method& method, double step, std::span<const Complex> lambda) {
    if (is_stable(method, step, lambda)) return step;
    constexpr int halvings = 30;
    constexpr double shortest = 1e-4;  // of the step
    double stable = std::log(shortest * step), unstable = std::log(step);
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (stable + unstable);
        (is_stable(method, std::exp(middle), lambda) ? stable : unstable) = middle;
    }
    return std::exp(stable);
}

}  // namespace hamilcar
