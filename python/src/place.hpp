// A place in a run as Python holds it: with what it belongs to, so that no other car is sent there.
#pragma once

#include <fmt/format.h>

#include "hamilcar/run/simulation.hpp"
#include "python.hpp"

namespace hamilcar::python {

struct Place {
    Snapshot snapshot;
    int state_size = 0;
    std::string integrator;
    double step = 0;  // [s]

    explicit Place(const Simulation& of)
        : state_size(of.model().vehicle.state_size),
          integrator(of.scenario().solver.integrator),
          step(of.scenario().solver.step) {}

    void expect_of(const Simulation& car) const {
        const Place own(car);
        if (own.state_size == state_size && own.integrator == integrator && own.step == step) return;
        throw nb::value_error(
            fmt::format("this snapshot is of another car: a state of {} numbers, {} with steps of {:g} s; expected {}, "
                        "{}, {:g} s",
                        state_size, integrator, step, own.state_size, own.integrator, own.step)
                .c_str());
    }
};

// Lists of pointers may hold a None.
template <class T>
const T& expect_object(const T* one, const char* what) {
    if (!one) throw nb::type_error(fmt::format("expected {}, not None", what).c_str());
    return *one;
}

}  // namespace hamilcar::python
