// Reads the road of a scenario: the plane and everything that stands on it. A new element is one function that reads its keys
// and one line in read_road.
#pragma once

#include "hamilcar/description/road.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// One number holds for the whole run, a list goes with the times in `time_s`.
SignalDescription read_signal(const TableReader& table, std::string_view key, const Range& range);

RoadDescription read_road(const TableReader& table);

}  // namespace hamilcar::io
