// Reads a rigid body: `mass_kg`, `center_of_mass_m`, `inertia_kg_m2`, `products_kg_m2`.
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// A carrier's inertia leaves out what spins; `wheel` says what that is.
BodyDescription read_body(const TableReader& table, const WheelDescription& wheel = {});

}  // namespace hamilcar::io
