#include "hamilcar/engine/car_rhs.hpp"

#include "hamilcar/engine/flush_denormals.hpp"

namespace hamilcar {

Health<double> advance_car(const CarRhs& rhs, Integrator<State<double>>& integrator, const Schedule& schedule,
                           double time, State<double>& state, double* measured) {
    const FlushDenormals flush;
    CarRhs::Report first, further;
    integrate(rhs, integrator, schedule, time, state, state, first, further);
    if (measured) rhs.read_measurement(first, measured);
    return first.health();
}

}  // namespace hamilcar
