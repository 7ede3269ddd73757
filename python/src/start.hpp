// A car at its start, for batches and rollouts: made once, at some milliseconds, then put where it is wanted at none.
#pragma once

#include <nanobind/stl/shared_ptr.h>

#include "documents.hpp"
#include "hamilcar/driver/direct_controls.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/simulation.hpp"
#include "python.hpp"

namespace hamilcar::python {

// What controls and channels need of a vehicle's description, its steering ratio for one, is its own.
struct Start {
    Simulation simulation;
    DirectControls controls;
    CommandLayout commands;
    std::vector<Channel> channels;

    Start(const VehicleDocument& vehicle, const ScenarioDocument& scenario)
        : simulation(vehicle.description, scenario.description),
          controls(simulation.vehicle(), scenario.description, simulation.schedule()),
          commands(simulation.vehicle()),
          channels(all_channels(simulation.vehicle())) {}
};

using Starts =
    std::vector<std::shared_ptr<const Start>>;  // none of which may be null: a list of Python may hold a None

inline void expect_start(const std::shared_ptr<const Start>& start) {
    if (!start) throw nb::type_error("expected a start, not None");
}
inline void expect_starts(const Starts& starts) {
    for (const auto& start : starts) expect_start(start);
}

}  // namespace hamilcar::python
