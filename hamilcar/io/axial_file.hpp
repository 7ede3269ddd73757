// Reads the springs and dampers of a suspension: [axle.spring], [[axle.further_spring]], and likewise dampers.
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"
#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar::io {

// An axle's two sides, which are one composition where one suspension carries both wheels.
struct AxleSides {
    const Composition &left, &right;
    std::string_view usual_part;  // that springs act on unless the file says otherwise
};

// Each is given for the left side and comes with its mirror image. The two may be one.
void add_springs_and_dampers(const TableReader& axle, const AxleSides& sides, SuspensionDescription& left,
                             SuspensionDescription& right);

}  // namespace hamilcar::io
