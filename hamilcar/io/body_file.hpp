// Reads a rigid body: `mass_kg`, `center_of_mass_m`, `inertia_kg_m2`, `products_kg_m2`.
#pragma once

#include <utility>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// A carrier's inertia leaves out what spins; `wheel` says what that is.
BodyDescription read_body(const TableReader& table, const WheelDescription& wheel = {});

// Whether the body, its inertia that of all it holds, has room for rotors with these inertias about their axes, unit vectors.
bool has_room_for(const BodyDescription& body, const std::vector<std::pair<double, Point>>& rotors);

}  // namespace hamilcar::io
