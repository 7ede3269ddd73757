#include "hamilcar/integrator/stabilization.hpp"

#include <fmt/format.h>

namespace hamilcar {

namespace {
// Share of the exact limit that StabilizationRule::limit takes: at the limit itself a violation would never decay.
constexpr double limit_share = 0.7;
}  // namespace

GainChoice stabilization_gain(const SolverDescription& solver) {
    if (solver.constraints == ConstraintMode::exact) return {};
    const Method& method = *find_method(solver.integrator);
    const double limit = method.real_axis_limit / solver.step;
    if (solver.stabilization == StabilizationRule::limit) return {limit_share * limit, {}};
    if (solver.stabilization == StabilizationRule::paper) {
        if (method.paper_limit) return {*method.paper_limit / solver.step, {}};  // (36)
        return {0, fmt::format("stabilization = \"limit\" or a stabilization_gain_per_s with {}: the paper's Table 3 "
                               "has Adams-Bashforth "
                               "methods only",
                               method.name)};
    }
    const double gain = solver.stabilization_gain;
    const bool fixed_step = method.family != MethodFamily::embedded_runge_kutta;
    if (!solver.check_stability || !fixed_step || gain < limit) return {gain, {}};  // (35)
    return {gain,
            fmt::format("less than {:.4g}, or a step below {:.3g} s, since {} is unstable beyond alpha h = {:.4g} "
                        "(here {:g} x {:g})",
                        limit, method.real_axis_limit / gain, method.name, method.real_axis_limit, gain, solver.step)};
}

}  // namespace hamilcar
