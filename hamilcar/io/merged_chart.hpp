// One diagram of several runs: their curves in one, told apart by labels.
#pragma once

#include "hamilcar/io/page.hpp"

namespace hamilcar::io {

// A chart of each run, of one title, with the run's label.
using LabeledCharts = std::vector<std::pair<const Chart*, std::string>>;

// What all of them show beside their curves comes once, the rest under the run's label. At least one chart.
Chart merged(const LabeledCharts& charts);

}  // namespace hamilcar::io
