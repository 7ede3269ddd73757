// The blocks in plain doubles, one suspension after the other, for the Initial Process, channels and analyses: compiled once,
// here.
#include "hamilcar/block/integration.hpp"

namespace hamilcar {

template Velocity<double> velocity_block<double>(const Model<double>&, const State<double>&, const Input<double>&);
template Momenta<double> momenta_block<double>(const Model<double>&, const State<double>&, const Input<double>&,
                                               const Velocity<double>&);
template void evaluate_rhs<double>(const Model<double>&, const Input<double>&, const State<double>&, State<double>&,
                                   Evaluation<double>&);
template void close_loops<double>(const Model<double>&, const RackMotion<double>&, State<double>&, int);

}  // namespace hamilcar
