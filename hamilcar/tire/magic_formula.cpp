// What the Magic Formula's coefficients are multiplied by before any load, slip or camber is known: scaling factors, and
// the inflation pressure (Besselink, Schmeitz, Pacejka 2010).
#include "hamilcar/tire/magic_formula.hpp"

#include <cmath>

namespace hamilcar {

MagicCoefficients scaled(const MagicFormulaDescription& d) {
    const MagicCoefficients& from = d.coefficients;
    MagicCoefficients c = from;
    const double dpi = d.nominal_pressure > 0 ? (d.pressure - d.nominal_pressure) / d.nominal_pressure : 0;
    const auto multiply = [&c](double factor, std::initializer_list<MagicName> names) {
        for (const MagicName name : names) c[name] *= factor;
    };
    multiply(from[LCX], {PCX1});
    multiply(1 + dpi * (from[PPX3] + from[PPX4] * dpi), {PDX1, PDX2});
    multiply(from[LEX], {PEX1, PEX2, PEX3});
    multiply(from[LKX] * (1 + dpi * (from[PPX1] + from[PPX2] * dpi)), {PKX1, PKX2});
    multiply(from[LHX], {PHX1, PHX2});
    multiply(from[LVX], {PVX1, PVX2});
    multiply(from[LXAL], {RBX1, RBX3});
    multiply(from[LSGKP], {PTX1, PTX2});

    multiply(from[LCY], {PCY1});
    multiply(1 + dpi * (from[PPY3] + from[PPY4] * dpi), {PDY1, PDY2});
    multiply(from[LEY], {PEY1, PEY2});
    multiply(from[LKY] * (1 + from[PPY1] * dpi), {PKY1});
    multiply(1 + from[PPY2] * dpi, {PKY2, PKY5});
    multiply(from[LKYC] * (1 + from[PPY5] * dpi), {PKY6, PKY7});
    multiply(from[LHY], {PHY1, PHY2});
    multiply(from[LVY], {PVY1, PVY2});
    multiply(from[LKYC], {PVY3, PVY4});
    multiply(from[LYKA], {RBY1, RBY4});
    multiply(from[LVYKA], {RVY1, RVY2, RVY3});
    multiply(from[LSGAL] * from[LFZO], {PTY1});

    multiply(from[LMX] * from[LVMX], {QSX1});
    multiply(from[LMX] * (1 + from[PPMX1] * dpi), {QSX2});
    multiply(from[LMX], {QSX3, QSX4, QSX10, QSX12, QSX13, QSX14});
    const double pressure_ratio = 1 + dpi;
    multiply(from[LMY] * std::pow(pressure_ratio, from[QSY8]), {QSY1, QSY2, QSY3, QSY4, QSY5, QSY6});

    multiply(from[LKY], {QBZ1, QBZ2, QBZ3, QBZ9});
    multiply(c[PCY1], {QBZ10});  // scales with B_y C_y
    multiply(from[LTR] * (1 - from[PPZ1] * dpi), {QDZ1, QDZ2});
    multiply(from[LRES], {QDZ6, QDZ7});
    multiply(from[LKZC] * (1 + from[PPZ2] * dpi), {QDZ8, QDZ9});
    multiply(from[LKZC], {QDZ10, QDZ11});
    multiply(from[LS], {SSZ1, SSZ2, SSZ3, SSZ4});

    if (d.angle_slip) {  // older sets scale the camber itself, and their rolling resistance is proportional to the load
        c[QSY7] = 1;
        multiply(from[LGAX] * from[LGAX], {PDX3});
        multiply(from[LGAY] * from[LGAY], {PDY3});
        multiply(from[LGAY], {PEY4, PKY3, PHY3, PVY3, PVY4});
        multiply(from[LGAZ], {QBZ4, QBZ5, QDZ3, QDZ8, QDZ9, QEZ5, QHZ3, QHZ4});
        multiply(from[LGAZ] * from[LGAZ], {QDZ4});
        multiply(from[LFZO], {QDZ1, QDZ2, SSZ2});
    }
    // A step uses LFZO FNOMIN only; these coefficients refer to FNOMIN itself, as does the leading factor of (4.E70).
    multiply(from[LFZO], {QSX3, QSX6, QSX9, QSX11, QSY2, QSY6, PTX1, PTX2});
    multiply(std::pow(from[LFZO], c[QSY7] - 1), {QSY1, QSY2, QSY3, QSY4, QSY5, QSY6});
    return c;
}

}  // namespace hamilcar
