// The coefficients of the Magic Formula by the names they have in every .tir file, from MF 5.2 to 6.2 (Pacejka, Tire and
// Vehicle Dynamics, 3rd edition, 4.3.2 and Appendix 3; Besselink, Schmeitz, Pacejka, "An improved Magic Formula/Swift tyre
// model that can handle inflation pressure changes", Vehicle System Dynamics 48, 2010). Each with the value that a file means
// when it leaves it out.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace hamilcar {

// Those that a step reads, in the order of the file's sections: longitudinal, lateral, overturning, rolling, aligning ...
// clang-format off
#define HAMILCAR_MAGIC_IN_STEP(X)                                                                                     \
    X(PCX1, 1.65) X(PDX1, 1) X(PDX2, 0) X(PDX3, 0) X(PEX1, 0) X(PEX2, 0) X(PEX3, 0) X(PEX4, 0) X(PKX1, 20)            \
    X(PKX2, 0) X(PKX3, 0) X(PHX1, 0) X(PHX2, 0) X(PVX1, 0) X(PVX2, 0) X(RBX1, 0) X(RBX2, 0) X(RBX3, 0) X(RCX1, 1)     \
    X(REX1, 0) X(REX2, 0) X(RHX1, 0) X(PTX1, 0) X(PTX2, 0) X(PTX3, 0)                                                 \
    X(PCY1, 1.3) X(PDY1, 1) X(PDY2, 0) X(PDY3, 0) X(PEY1, 0) X(PEY2, 0) X(PEY3, 0) X(PEY4, 0) X(PEY5, 0)              \
    X(PKY1, -20) X(PKY2, 1.5) X(PKY3, 0) X(PKY4, 2) X(PKY5, 0) X(PKY6, 0) X(PKY7, 0) X(PHY1, 0) X(PHY2, 0)            \
    X(PHY3, 0) X(PVY1, 0) X(PVY2, 0) X(PVY3, 0) X(PVY4, 0) X(RBY1, 0) X(RBY2, 0) X(RBY3, 0) X(RBY4, 0) X(RCY1, 1)     \
    X(REY1, 0) X(REY2, 0) X(RHY1, 0) X(RHY2, 0) X(RVY1, 0) X(RVY2, 0) X(RVY3, 0) X(RVY4, 0) X(RVY5, 0) X(RVY6, 0)     \
    X(PTY1, 0) X(PTY2, 0)                                                                                             \
    X(QSX1, 0) X(QSX2, 0) X(QSX3, 0) X(QSX4, 0) X(QSX5, 0) X(QSX6, 0) X(QSX7, 0) X(QSX8, 0) X(QSX9, 0)                \
    X(QSX10, 0) X(QSX11, 0) X(QSX12, 0) X(QSX13, 0) X(QSX14, 0)                                                       \
    X(QSY1, 0) X(QSY2, 0) X(QSY3, 0) X(QSY4, 0) X(QSY5, 0) X(QSY6, 0) X(QSY7, 1)                                      \
    X(QBZ1, 0) X(QBZ2, 0) X(QBZ3, 0) X(QBZ4, 0) X(QBZ5, 0) X(QBZ9, 0) X(QBZ10, 0) X(QCZ1, 1) X(QDZ1, 0)               \
    X(QDZ2, 0) X(QDZ3, 0) X(QDZ4, 0) X(QDZ6, 0) X(QDZ7, 0) X(QDZ8, 0) X(QDZ9, 0) X(QDZ10, 0) X(QDZ11, 0)              \
    X(QEZ1, 0) X(QEZ2, 0) X(QEZ3, 0) X(QEZ4, 0) X(QEZ5, 0) X(QHZ1, 0) X(QHZ2, 0) X(QHZ3, 0) X(QHZ4, 0) X(SSZ1, 0)     \
    X(SSZ2, 0) X(SSZ3, 0) X(SSZ4, 0)

// ... and those that are multiplied into them beforehand: inflation pressure and scaling factors.
#define HAMILCAR_MAGIC_BEFORE(X)                                                                                      \
    X(PPX1, 0) X(PPX2, 0) X(PPX3, 0) X(PPX4, 0) X(PPY1, 0) X(PPY2, 0) X(PPY3, 0) X(PPY4, 0) X(PPY5, 0)                \
    X(PPZ1, 0) X(PPZ2, 0) X(PPMX1, 0) X(QSY8, 0) X(LFZO, 1) X(LCX, 1) X(LMUX, 1) X(LEX, 1) X(LKX, 1) X(LHX, 1)        \
    X(LVX, 1) X(LCY, 1) X(LMUY, 1) X(LEY, 1) X(LKY, 1) X(LKYC, 1) X(LHY, 1) X(LVY, 1) X(LGAX, 1) X(LGAY, 1)           \
    X(LGAZ, 1) X(LKZC, 1) X(LTR, 1) X(LRES, 1) X(LXAL, 1) X(LYKA, 1) X(LVYKA, 1) X(LS, 1) X(LMX, 1) X(LVMX, 1)        \
    X(LMY, 1) X(LSGKP, 1) X(LSGAL, 1)
// clang-format on

#define HAMILCAR_MAGIC_NAME(name, default_value) name,
enum MagicName : std::size_t {
    HAMILCAR_MAGIC_IN_STEP(HAMILCAR_MAGIC_NAME) magic_in_step,
    magic_last_in_step = magic_in_step - 1,  // the next one takes up the count
    HAMILCAR_MAGIC_BEFORE(HAMILCAR_MAGIC_NAME) magic_count
};
#undef HAMILCAR_MAGIC_NAME

struct MagicCoefficient {
    std::string_view name;
    double default_value;
};

#define HAMILCAR_MAGIC_ENTRY(name, default_value) MagicCoefficient{#name, default_value},
inline constexpr std::array<MagicCoefficient, magic_count> magic_coefficients{
    HAMILCAR_MAGIC_IN_STEP(HAMILCAR_MAGIC_ENTRY) HAMILCAR_MAGIC_BEFORE(HAMILCAR_MAGIC_ENTRY)};
#undef HAMILCAR_MAGIC_ENTRY

// A set, indexed by name: set[PKX1].
struct MagicCoefficients : std::array<double, magic_count> {
    MagicCoefficients() : std::array<double, magic_count>{} {
        for (std::size_t i = 0; i < magic_count; ++i) (*this)[i] = magic_coefficients[i].default_value;
    }
};

}  // namespace hamilcar
