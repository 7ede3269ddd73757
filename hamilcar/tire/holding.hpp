// Deflections with which a standing tire carries given forces, whatever its model: for starts and equilibria.
#pragma once

#include "hamilcar/tire/list.hpp"

namespace hamilcar {

// Of a contact that is pressed and inclined as `contact` says; as near as friction lets it come.
Deflection<double> holding(const Tire<double>& tire, const TireContact<double>& contact, double Fx, double Fy);

}  // namespace hamilcar
