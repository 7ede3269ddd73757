// Contact deflections at which a standing tire of any model produces given forces, for initial states and equilibria.
#pragma once

#include "hamilcar/tire/list.hpp"

namespace hamilcar {

// Deflections that produce (Fx, Fy) at the depth and camber of `contact`, or the closest forces that friction allows.
Deflection<double> contact_deflection(const Tire<double>& tire, const TireContact<double>& contact, double Fx,
                                      double Fy);

}  // namespace hamilcar
