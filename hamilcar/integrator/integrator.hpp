// Advances a state vector by one step of a chosen method. Holds the history of multi-step methods; never allocates.
//
// Adams methods start with a Runge-Kutta method of order six, so their first
// steps are as accurate as the rest. The adaptive method divides the given steps as its error estimate requires and
// meets their ends.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/integrator/methods.hpp"
#include "hamilcar/math/arrays.hpp"

namespace hamilcar {

// y' = f(t, y), written into the third argument.
template <class F, class State>
concept RightHandSide = std::invocable<F&, double, const State&, State&>;

// `State` has an array `values` of T; the first `size` of them are integrated.
template <class State>
class Integrator {
public:
    // `zero`: a state of full size, for states of dynamic size.
    Integrator(const Method& method, double step, int size, double tolerance = 1e-8, const State& zero = {})
        : method_(method), step_(step), size_(size), tolerance_(tolerance) {
        HAMILCAR_ASSERT(method.order <= max_adams_order && static_cast<std::size_t>(size) <= zero.values.size());
        work_.fill(zero);
        for (int j = 0; j < method.order; ++j) memory_.past[static_cast<std::size_t>(j)] = zero;
        memory_.remembered = memory_.newest = 0;
        memory_.substep = step, memory_.converged = true;
    }

    const Method& method() const { return method_; }
    double step() const { return step_; }
    // Forgets the past, as after a jump in the state.
    void restart() { memory_.remembered = 0; }
    // As if the past were known: for who puts it in, or starts single numbers of the state by themselves.
    void assume_past() { memory_.remembered = method_.order; }
    // Rates, the latest first.
    State& past(int back) { return memory_.past[static_cast<std::size_t>(place(memory_, back))]; }
    const State& past(int back) const { return memory_.past[static_cast<std::size_t>(place(memory_, back))]; }
    // False once the adaptive method could not meet its tolerance with any step.
    bool converged() const { return memory_.converged; }
    // Everything that later steps depend on, to return to an earlier time. Only what the method uses is written and read.
    struct Memory {
        int remembered = 0, newest = 0;
        double substep = 0;
        bool converged = true;
        std::array<State, max_adams_order> past;
        Memory() {}
    };
    void save(Memory& to) const {
        to.remembered = memory_.remembered, to.newest = memory_.newest;
        to.substep = memory_.substep, to.converged = memory_.converged;
        copy_past(memory_, to);
    }
    void restore(const Memory& from) {
        memory_.remembered = from.remembered, memory_.newest = from.newest;
        memory_.substep = from.substep, memory_.converged = from.converged;
        copy_past(from, memory_);
    }
    // Calls f with every stored rate.
    template <class F>
    void change_past(F&& f) {
        for (int j = 0; j < method_.order; ++j) f(memory_.past[static_cast<std::size_t>(j)]);
    }

    // y(t) -> y(t + step), to another place or to the same.
    template <RightHandSide<State> F>
    void advance(F&& f, double t, const State& from, State& to) {
        switch (method_.family) {
            case MethodFamily::adams_bashforth: return advance_adams(f, t, from, to, false);
            case MethodFamily::adams_bashforth_moulton: return advance_adams(f, t, from, to, true);
            case MethodFamily::runge_kutta: return advance_runge_kutta(classical_runge_kutta, f, t, step_, from, to);
            case MethodFamily::embedded_runge_kutta: return advance_adaptive(f, t, from, to);
        }
    }
    template <RightHandSide<State> F>
    void advance(F&& f, double t, State& y) {
        advance(f, t, y, y);
    }

private:
    void copy(const State& from, State& to) const { std::copy_n(from.values.begin(), size_, to.values.begin()); }
    int place(const Memory& memory, int back) const { return (memory.newest + method_.order - back) % method_.order; }
    void copy_past(const Memory& from, Memory& to) const {
        for (int j = 0; j < std::min(from.remembered, method_.order); ++j) {
            const auto k = static_cast<std::size_t>(place(from, j));
            copy(from.past[k], to.past[k]);
        }
    }

    using T = typename decltype(State::values)::value_type;

    template <class F>
    void advance_adams(F& f, double t, const State& from, State& to, bool corrected) {
        memory_.newest =
            (memory_.newest + 1) % method_.order;  // no longer history than needed, so that it stays in the cache
        f(t, from, memory_.past[memory_.newest]);
        if (memory_.remembered < method_.order) ++memory_.remembered;
        if (memory_.remembered < method_.order) return advance_runge_kutta(butcher_6, f, t, step_, from, to);
        if (!corrected) return add_past(adams_bashforth[method_.order - 1], 0, from, to);

        State& predicted = work_[max_stages];
        add_past(adams_bashforth[method_.order - 1], 0, from, predicted);
        f(t + step_, predicted, work_[0]);
        const AdamsRow& a = adams_moulton[method_.order - 1];
        add_past(a, 1, from, to);
        add_scaled(T(step_ * a[0]), work_[0].values.data(), to.values.data(), size_);
    }

    // to = from + h sum_j row[j + skip] f_{n-j}
    void add_past(const AdamsRow& row, int skip, const State& from, State& to) {
        const int count = method_.order - skip;
        std::array<const T*, max_adams_order> rate;
        std::array<T, max_adams_order> weight;
        for (int j = 0; j < count; ++j) {
            rate[j] = memory_.past[(memory_.newest + method_.order - j) % method_.order].values.data();
            weight[j] = T(step_ * row[j + skip]);
        }
        add_weighted(from.values.data(), rate.data(), weight.data(), count, to.values.data(), size_);
    }

    template <class F>
    void stages(const Tableau& method, F& f, double t, double h, const State& y) {
        for (int s = 0; s < method.stages; ++s) {
            State& at = work_[max_stages];
            copy(y, at);
            for (int j = 0; j < s; ++j) {
                if (method.stage[s][j] == 0) continue;
                add_scaled(T(h * method.stage[s][j]), work_[j].values.data(), at.values.data(), size_);
            }
            f(t + h * method.nodes[s], at, work_[s]);
        }
    }

    void add_stages(const std::array<double, max_stages>& weights, int count, double h, State& y) const {
        for (int s = 0; s < count; ++s) {
            if (weights[s] == 0) continue;
            add_scaled(T(h * weights[s]), work_[s].values.data(), y.values.data(), size_);
        }
    }

    template <class F>
    void advance_runge_kutta(const Tableau& method, F& f, double t, double h, const State& from, State& to) {
        stages(method, f, t, h, from);
        if (&from != &to) copy(from, to);
        add_stages(method.weights, method.stages, h, to);
    }

    // Largest error of a trial step relative to the tolerance; numbers below one count as one. Infinite for a NaN.
    double error_ratio(double h, const State& y) const {
        double worst = 0;
        for (int i = 0; i < size_; ++i) {
            T error(0);
            for (int s = 0; s < dormand_prince.stages; ++s) {
                error += T(h * (dormand_prince.weights[s] - dormand_prince.embedded[s])) * work_[s].values[i];
            }
            const double scale = std::max(1.0, std::fabs(value_of(y.values[i])));
            const double ratio = std::fabs(value_of(error)) / (tolerance_ * scale);
            if (!std::isfinite(ratio)) return std::numeric_limits<double>::infinity();
            worst = std::max(worst, ratio);
        }
        return worst;
    }

    template <class F>
    void advance_adaptive(F& f, double t, const State& from, State& y) {
        if (&from != &y) copy(from, y);
        const double min_step = 1e-9 * step_;  // below it the method gives up
        double done = 0;
        while (done < step_) {
            const bool last = memory_.substep >= step_ - done;
            const double h = last ? step_ - done : memory_.substep;
            stages(dormand_prince, f, t + done, h, y);
            const double ratio = error_ratio(h, y);
            if (ratio <= 1) {
                add_stages(dormand_prince.weights, dormand_prince.stages, h, y);
                done = last ? step_ : done + h;
            } else if (h < min_step) {
                memory_.converged = false;
                return;
            }
            const double proposed = h * std::min(5.0, std::max(0.2, 0.9 * std::pow(std::max(ratio, 1e-10), -0.2)));
            if (!last || proposed < memory_.substep || ratio > 1) memory_.substep = std::min(proposed, step_);
        }
    }

    Method method_;
    double step_;
    int size_;
    double tolerance_;
    Memory memory_;
    std::array<State, max_stages + 1> work_;
};

}  // namespace hamilcar
