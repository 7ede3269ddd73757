#include "hamilcar/engine/car_rhs.hpp"

#include "hamilcar/engine/flush_denormals.hpp"

namespace hamilcar {

Health<double> advance_car(const CarRhs& rhs, Integrator<State<double>>& integrator, const Schedule& schedule,
                           double time, State<double>& state) {
    const FlushDenormals flush;
    CarRhs::Report first, further;
    integrate(rhs, integrator, schedule, time, state, state, first, further);
    return first.health();
}

}  // namespace hamilcar
