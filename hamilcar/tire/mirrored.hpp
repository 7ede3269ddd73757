// The same tire on the other side of the car: what is skew in its coefficients changes sign.
#pragma once

#include "hamilcar/description/tire.hpp"

namespace hamilcar {

MagicFormulaDescription mirrored(MagicFormulaDescription tire);
TireDescription mirrored(const TireDescription& tire);
// Without anything skew: no ply steer, no conicity.
MagicFormulaDescription symmetric(MagicFormulaDescription tire);

}  // namespace hamilcar
