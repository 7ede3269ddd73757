// Which channel of an OpenCRG file is what, and where its longitudinal sections lie.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hamilcar/io/crg_header.hpp"

namespace hamilcar::io::crg {

struct Channels {
    std::optional<std::size_t> phi, slope, banking;  // of the reference line
    std::vector<std::size_t> sections;               // from right to left ...
    std::vector<double> v;                           // ... at [m]
};

Channels find_channels(const Header& header);

}  // namespace hamilcar::io::crg
