// The one place where the energy of a car of plain numbers is compiled.
#include "hamilcar/analysis/energy.hpp"

namespace hamilcar {

template Energy<double> energy<double>(const Model<double>&, const State<double>&, const Velocity<double>&,
                                       const Momenta<double>&);

}  // namespace hamilcar
