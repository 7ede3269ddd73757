// Figure 9 of the paper: the norm of the constraint violations over time and against the gain of their stabilization.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/io/page.hpp"
#include "hamilcar/run/stabilization_sweep.hpp"

namespace hamilcar::cli {

constexpr double paper_gain = 400, paper_norm = 0.005;  // [1/s]; "comparatively small", the paper says
constexpr double figure_interval = 0.01;                // between points of the figures [s]

// What the sweep over the gain comes to with one steering; gains [1/s], norms of the constraint violations.
struct GainSweep {
    std::string steering;  // how it is interpolated: "smoother", "smooth"
    std::optional<double> first_unstable_gain;
    std::optional<SweepRun> best, at_paper_gain;  // of the stable ones that with the smallest root mean square
};

// The case's points of steering twice: with a continuous acceleration, and as monotone cubics, whose acceleration jumps at every
// point (docs/theory/errata.md, section 6).
struct Figure9 {
    double stability_limit;  // [1/s]
    std::vector<GainSweep> sweeps;
};

// Sweeps the gain, writes the data into the folder and adds the pictures to the page. None where the run was interrupted.
std::optional<Figure9> write_figure_9(const std::string& folder, const VehicleDescription& vehicle,
                                      const ScenarioDescription& scenario, io::Page& page);

nlohmann::json json_of(const Figure9& figure);

// A table as CSV, a vector a column.
void write_columns(const std::string& path, const std::vector<std::string>& headings,
                   const std::vector<const std::vector<double>*>& columns);

}  // namespace hamilcar::cli
