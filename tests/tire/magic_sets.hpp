// Random coefficient sets of the Magic Formula: every coefficient of a version nonzero, near values that measured tires have.
#pragma once

#include <random>

#include "hamilcar/description/tire.hpp"

namespace hamilcar::test {

enum class MagicVersion { v52, v60, v61 };

namespace detail {

struct Typical {
    MagicName name;
    double value;
};

// What all versions have.
constexpr Typical of_all[]{
    {PCX1, 1.65},   {PDX1, 1.2},    {PDX2, -0.04}, {PDX3, 3},     {PEX1, 0.35},   {PEX2, 0.1},    {PEX3, -0.05},
    {PEX4, 0.1},    {PKX1, 21.5},   {PKX2, -0.2},  {PKX3, 0.25},  {PHX1, -0.002}, {PHX2, 0.002},  {PVX1, 0.003},
    {PVX2, -0.002}, {RBX1, 12.5},   {RBX2, -11},   {RCX1, 1.1},   {REX1, -0.3},   {REX2, 0.2},    {RHX1, 0.007},
    {PCY1, 1.2},    {PDY1, -1},     {PDY2, 0.15},  {PDY3, -8},    {PEY1, -1},     {PEY2, -0.5},   {PEY3, -0.1},
    {PEY4, -5},     {PKY1, -16},    {PKY2, 2.1},   {PKY3, 0.3},   {PHY1, 0.003},  {PHY2, -0.001}, {PVY1, 0.04},
    {PVY2, -0.02},  {PVY3, -0.5},   {PVY4, 0.1},   {RBY1, 6.8},   {RBY2, 5},      {RBY3, -0.02},  {RCY1, 1.08},
    {REY1, -0.2},   {REY2, 0.2},    {RHY1, 0.009}, {RHY2, 0.003}, {RVY1, 0.05},   {RVY2, -0.07},  {RVY3, 0.5},
    {RVY4, 25},     {RVY5, 1.9},    {RVY6, -10.7}, {QSX1, 0.01},  {QSX2, 0.5},    {QSX3, 0.05},   {QSY1, 0.01},
    {QSY2, 0.002},  {QSY3, 0.001},  {QSY4, 1e-4},  {QBZ1, 9},     {QBZ2, -1.1},   {QBZ3, -0.8},   {QBZ4, 0.1},
    {QBZ5, -0.3},   {QBZ9, 18},     {QBZ10, 0.3},  {QCZ1, 1.18},  {QDZ1, 0.1},    {QDZ2, -0.004}, {QDZ3, -0.1},
    {QDZ4, 8},      {QDZ6, -0.008}, {QDZ7, 0.003}, {QDZ8, -0.25}, {QDZ9, 0.03},   {QEZ1, -1.6},   {QEZ2, -0.3},
    {QEZ3, 0.2},    {QEZ4, 0.2},    {QEZ5, -1},    {QHZ1, 0.006}, {QHZ2, -0.002}, {QHZ3, 0.14},   {QHZ4, 0.02},
    {SSZ1, 0.04},   {SSZ2, 0.01},   {SSZ3, 0.7},   {SSZ4, -0.24}, {PPX1, -0.35},  {PPX2, 0.1},    {PPX3, -0.1},
    {PPX4, 0.06},   {PPY1, 0.4},    {PPY2, 0.5},   {PPY3, -0.1},  {PPY4, 0.05},   {LFZO, 1},      {LCX, 1},
    {LMUX, 1},      {LEX, 1},       {LKX, 1},      {LHX, 1},      {LVX, 1},       {LCY, 1},       {LMUY, 1},
    {LEY, 1},       {LKY, 1},       {LHY, 1},      {LVY, 1},      {LTR, 1},       {LRES, 1},      {LXAL, 1},
    {LYKA, 1},      {LVYKA, 1},     {LS, 1},       {LMX, 1},      {LVMX, 1},      {LMY, 1}};
constexpr Typical of_52[]{{PHY3, 0.03}, {PTX1, 2.3}, {PTX2, 1.2}, {PTX3, 0.5}, {PTY1, 2.1}, {PTY2, 2},
                          {LGAX, 1},    {LGAY, 1},   {LGAZ, 1},   {LSGKP, 1},  {LSGAL, 1}};
constexpr Typical of_6[]{{RBX3, 1},    {PEY5, 5},    {PKY4, 1.95}, {PKY5, 0.5},  {PKY6, -0.9},  {PKY7, -0.24},
                         {RBY4, 1},    {QSX4, 0.02}, {QSX5, 1},    {QSX6, 1.2},  {QSX7, 3},     {QSX8, 0.5},
                         {QSX9, 1},    {QSX10, 0.3}, {QSX11, 0.8}, {QSX12, 0.2}, {QSX13, 0.01}, {QSX14, 0.05},
                         {QSY5, 0.1},  {QSY6, 0.05}, {QSY7, 0.85}, {QSY8, -0.4}, {QDZ10, 0.1},  {QDZ11, 0.05},
                         {PPY5, -0.2}, {PPZ1, -0.1}, {PPZ2, 0.2},  {PPMX1, 0.1}, {LKYC, 1},     {LKZC, 1}};

}  // namespace detail

inline MagicFormulaDescription random_magic_set(std::mt19937& source, MagicVersion version) {
    MagicFormulaDescription d;
    d.casing = {.radius = 0.32,
                .rolling_radius = 0.31,
                .vertical_stiffness = 200e3,
                .vertical_growth = 0,
                .vertical_damping = 100,
                .carcass_damping = 0.004};
    d.angle_slip = d.relaxation_by_load = version == MagicVersion::v52;
    d.camber_by_stiffness = version != MagicVersion::v52;
    d.upright_aligning_force = version == MagicVersion::v61;
    d.nominal_load = 4000, d.nominal_radius = 0.32, d.nominal_pressure = 200e3, d.pressure = 220e3;
    d.carcass_x = 310e3, d.carcass_y = 125e3;
    std::uniform_real_distribution<double> near(0.8, 1.2);
    const auto fill = [&](const auto& list) {
        for (const auto& [name, value] : list) d.coefficients[name] = value * near(source);
    };
    fill(detail::of_all);
    if (version == MagicVersion::v52) {
        fill(detail::of_52);
    } else {
        fill(detail::of_6);
    }
    if (source() % 2) {  // both signs of PDY1 are in use
        d.coefficients[PDY1] = -d.coefficients[PDY1], d.coefficients[PDY2] = -d.coefficients[PDY2];
    }
    return d;
}

}  // namespace hamilcar::test
