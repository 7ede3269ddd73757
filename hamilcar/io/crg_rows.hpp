// The rows of an OpenCRG file behind its header, in ASCII or binary. There are as many as the file has bytes for, whatever
// its header announces.
#pragma once

#include "hamilcar/description/crg.hpp"
#include "hamilcar/io/crg_channels.hpp"

namespace hamilcar::io::crg {

// Adds to `road` its heights, headings, slopes and bankings. Rows of padding at the end are left out.
void read_rows(Text& text, const Header& header, const Channels& channels, CrgDescription& road);

}  // namespace hamilcar::io::crg
