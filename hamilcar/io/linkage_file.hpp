// Reads a linkage that a file composes itself: suspension = "linkage", joints and cut joints one by one.
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"
#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar::io {

// [[axle.joint]], [[axle.cut]], `carrier_part` and, for an axle with two wheels, `right_carrier_part`. Checked: every part
// is carried, and the wheels have one freedom each.
Composition read_linkage(const TableReader& axle, const WheelDescription& wheel, bool on_trailer);

// The right side of a linkage with one wheel.
Composition mirrored_composition(Composition left);

}  // namespace hamilcar::io
