#include "hamilcar/engine/car_ring.hpp"

#include "hamilcar/engine/flush.hpp"

namespace hamilcar {

Health<double> advance_car(const CarRing& ring, Integrator<State<double>>& integrator, const Schedule& schedule,
                           double time, State<double>& state) {
    const FlushTinyNumbers flush;
    CarRing::Report first, further;
    integrate(ring, integrator, schedule, time, state, state, first, further);
    return first.health();
}

}  // namespace hamilcar
