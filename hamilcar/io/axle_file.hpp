// Reads an axle whose suspension has a program of its own. All others: composed_axle_file.hpp.
#pragma once

#include "hamilcar/io/wheel_file.hpp"

namespace hamilcar::io {

bool has_own_program(std::string_view suspension);

// The left corner of an [[axle]] of such a suspension, named "<axle>_left"; it has half of the axle's share of the drive
// torque.
CornerDescription read_left_corner(const TableReader& axle, std::string_view suspension, const NamedTires& tires);

}  // namespace hamilcar::io
