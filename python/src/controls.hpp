// Controls as rows of numbers from Python: checked, and given to whoever keeps schedule and driver of a car.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "hamilcar/driver/direct_controls.hpp"
#include "python.hpp"

namespace hamilcar::python {

inline nb::list described(const DirectControls& controls) {
    nb::list out;
    for (const DirectControls::Entry& one : controls.list()) {
        out.append(
            nb::make_tuple(std::string(one.name), std::string(one.unit), std::string(one.meaning), one.min, one.max));
    }
    return out;
}

// Rows of one number for each control, NaN for one that is left alone.
inline void expect_controls(const DirectControls& controls, const Numbers& targets, std::size_t rows) {
    const std::size_t count = controls.list().size();
    if (targets.size() != rows * count) {
        throw nb::value_error(
            fmt::format("expected {} controls for each of {} cars, found {} numbers", count, rows, targets.size())
                .c_str());
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const DirectControls::Entry& entry = controls.list()[i % count];
        const double value = targets.data()[i];
        if (std::isnan(value)) continue;
        const bool whole = entry.control != Control::gear || value == std::floor(value);
        if (value >= entry.min && value <= entry.max && std::isfinite(value) && whole) continue;
        throw nb::value_error(fmt::format("{} = {:g}: expected {}{:g} to {:g}{}", entry.name, value,
                                          entry.control == Control::gear ? "a whole number, " : "", entry.min,
                                          entry.max, entry.unit == "1" ? "" : fmt::format(" [{}]", entry.unit))
                                  .c_str());
    }
}

// `access(change)` calls change(schedule, driver).
template <class Access>
void move_controls(const DirectControls& controls, const double* targets, double time, double duration,
                   const Access& access) {
    access([&](Schedule& schedule, Driver* driver) {
        for (std::size_t i = 0; i < controls.list().size(); ++i) {
            if (!std::isnan(targets[i])) controls.move(i, targets[i], time, duration, schedule, driver);
        }
    });
}
template <class Access>
void hold_controls(const DirectControls& controls, const double* targets, double time, const Access& access) {
    access([&](Schedule& schedule, Driver* driver) {
        for (std::size_t i = 0; i < controls.list().size(); ++i) {
            if (!std::isnan(targets[i])) controls.hold(i, targets[i], time, schedule, driver);
        }
    });
}

}  // namespace hamilcar::python
