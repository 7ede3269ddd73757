#include "hamilcar/engine/engine.hpp"
#include "hamilcar/engine/flush.hpp"

#ifndef HAMILCAR_INSTRUCTION_SET  // inside the library: for everybody who turns the ring himself
namespace hamilcar {
template void evaluate<double>(const Model<double>&, const Input<double>&, const State<double>&, State<double>&,
                               RingTurn<double>&);
}
#endif

namespace hamilcar::engine_parts {

Health<double> advance_car(const Model<double>& model, Integrator<State<double>>& integrator, const Schedule& schedule,
                           double time, State<double>& state) {
    const FlushTinyNumbers flush;
    return integration_block(model, integrator, schedule, time, state);
}

}  // namespace hamilcar::engine_parts
