// What $ROAD_CRG_MODS asks for is done to the road as it was read.
#pragma once

#include "hamilcar/description/crg.hpp"
#include "hamilcar/io/crg_header.hpp"

namespace hamilcar::io::crg {

// In OpenCRG's order: what is scaled is scaled about the start of the line, then all is turned and moved.
void modify(const Header& header, CrgDescription& road);

}  // namespace hamilcar::io::crg
