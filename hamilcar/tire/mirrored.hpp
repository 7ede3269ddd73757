// The same tire on the other side of the car: asymmetric coefficients change sign.
#pragma once

#include "hamilcar/description/tire.hpp"

namespace hamilcar {

MagicFormulaDescription mirrored(MagicFormulaDescription tire);
TireDescription mirrored(const TireDescription& tire);
// Without asymmetry: no ply steer, no conicity.
MagicFormulaDescription symmetric(MagicFormulaDescription tire);

}  // namespace hamilcar
