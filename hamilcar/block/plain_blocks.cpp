// The blocks in plain doubles, suspension after suspension, as starts, channels and analyses ask for them: compiled here, once.
#include "hamilcar/block/integration.hpp"

namespace hamilcar {

template Velocity<double> velocity_block<double>(const Model<double>&, const State<double>&, const Input<double>&);
template Momenta<double> momenta_block<double>(const Model<double>&, const State<double>&, const Input<double>&,
                                               const Velocity<double>&);
template void evaluate<double>(const Model<double>&, const Input<double>&, const State<double>&, State<double>&,
                               RingTurn<double>&);
template void close_loops<double>(const Model<double>&, const RackMotion<double>&, State<double>&, int);

}  // namespace hamilcar
