// A place in a run as Python holds it: with what it belongs to, so that no other car is sent there.
#pragma once

#include <fmt/format.h>

#include "hamilcar/engine/rhs_trace.hpp"
#include "hamilcar/run/simulation.hpp"
#include "python.hpp"

namespace hamilcar::python {

struct Place {
    Snapshot snapshot;
    std::string integrator;
    double step = 0;         // [s]
    std::vector<int> shape;  // of the model, who drives, and what controllers remember
    std::vector<std::string> controllers;

    explicit Place(const Simulation& of)
        : integrator(of.scenario().solver.integrator),
          step(of.scenario().solver.step),
          shape(numbers_of(of.model()).shape) {
        const DriverDescription& driver = of.scenario().driver;
        shape.insert(shape.end(), {of.model().vehicle.state_size, driver.steering.has_value(), driver.speed.has_value(),
                                   driver.shifting.has_value()});
        for (const PowerUnitDescription& unit : of.vehicle().power_units) {
            shape.push_back(static_cast<int>(unit.gearbox.ratios.size()));
        }
        shape.push_back(static_cast<int>(of.control_memory().size()));
        for (const ControllerDescription& one : of.vehicle().controllers) controllers.push_back(one.kind);
    }

    void expect_of(const Simulation& car) const {
        const Place own(car);
        const bool fits = own.shape == shape && own.controllers == controllers;
        if (fits && own.integrator == integrator && own.step == step) return;
        throw nb::value_error(
            "this snapshot is of a car of another structure, with other controllers, or of another method or step");
    }
};

// Lists of pointers may hold a None.
template <class T>
const T& expect_object(const T* one, const char* what) {
    if (!one) throw nb::type_error(fmt::format("expected {}, not None", what).c_str());
    return *one;
}

}  // namespace hamilcar::python
