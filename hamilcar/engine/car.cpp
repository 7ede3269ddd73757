#include "hamilcar/engine/engine.hpp"
#include "hamilcar/engine/flush.hpp"

namespace hamilcar::engine_parts {

Health<double> advance_car(const Model<double>& model, Integrator<State<double>>& integrator, const Schedule& schedule,
                           double time, State<double>& state) {
    const FlushTinyNumbers flush;
    return integration_block(model, integrator, schedule, time, state);
}

}  // namespace hamilcar::engine_parts
