#include "hamilcar/tire/mirrored.hpp"

#include <utility>

namespace hamilcar {

namespace {

// Side force, overturning and aligning moment are odd functions of slip angle and camber, except for these coefficients. QDZ3
// multiplies the camber in older sets and its magnitude in later ones.
template <class F>
void for_each_asymmetric(MagicFormulaDescription& tire, F&& f) {
    for (const MagicName name :
         {RHX1, QSX1, PEY3, PHY1, PHY2, PVY1, PVY2, RBY3, RVY1, RVY2, QBZ4, QDZ6, QDZ7, QEZ4, QHZ1, QHZ2, SSZ1}) {
        f(tire.coefficients[name]);
    }
    if (tire.angle_slip) f(tire.coefficients[QDZ3]);
}

}  // namespace

MagicFormulaDescription mirrored(MagicFormulaDescription tire) {
    for_each_asymmetric(tire, [](double& c) { c = -c; });
    tire.angle = {-tire.angle[1], -tire.angle[0]};
    tire.camber = {-tire.camber[1], -tire.camber[0]};
    return tire;
}

TireDescription mirrored(const TireDescription& tire) {
    const auto* magic = std::get_if<MagicFormulaDescription>(&tire);
    return magic ? TireDescription(mirrored(*magic)) : tire;
}

MagicFormulaDescription symmetric(MagicFormulaDescription tire) {
    for_each_asymmetric(tire, [](double& c) { c = 0; });
    return tire;
}

}  // namespace hamilcar
