// Controls as rows of numbers from Python: checked, and given to whoever keeps schedule and driver of a car.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "hamilcar/driver/direct_controls.hpp"
#include "hamilcar/run/channels.hpp"
#include "python.hpp"

namespace hamilcar::python {

inline nb::list described(const std::vector<Channel>& channels) {
    nb::list out;
    for (const Channel& channel : channels) {
        out.append(
            nb::make_tuple(channel.column.name, channel.column.unit, channel.column.description, channel.standard));
    }
    return out;
}
inline nb::list described(const DirectControls& controls) {
    nb::list out;
    for (const DirectControls::Entry& one : controls.list()) {
        out.append(
            nb::make_tuple(std::string(one.name), std::string(one.unit), std::string(one.meaning), one.min, one.max));
    }
    return out;
}

inline void expect_count(const Numbers& targets, std::size_t count) {
    if (targets.size() == count) return;
    throw nb::value_error(fmt::format("expected {} numbers for the controls, found {}", count, targets.size()).c_str());
}
// A number for each control, NaN for one that is left alone.
inline void expect_targets(const DirectControls& controls, const double* targets) {
    for (std::size_t i = 0; i < controls.list().size(); ++i) {
        const DirectControls::Entry& entry = controls.list()[i];
        const double value = targets[i];
        if (std::isnan(value)) continue;
        const bool whole = entry.control != Control::gear || value == std::floor(value);
        if (value >= entry.min && value <= entry.max && std::isfinite(value) && whole) continue;
        const bool bounded = std::isfinite(entry.min) && std::isfinite(entry.max);
        const std::string range = bounded ? fmt::format("{} to {}", entry.min, entry.max) : "a finite number";
        throw nb::value_error(fmt::format("{} = {}: expected {}{}{}", entry.name, value,
                                          entry.control == Control::gear ? "a whole number, " : "", range,
                                          entry.unit == "1" ? "" : fmt::format(" [{}]", entry.unit))
                                  .c_str());
    }
}

// `access(change)` calls change(schedule, driver).
template <class Access>
void move_controls(const DirectControls& controls, const double* targets, const DirectControls::Interval& interval,
                   const Access& access) {
    access([&](Schedule& schedule, Driver* driver) {
        for (std::size_t i = 0; i < controls.list().size(); ++i) {
            if (!std::isnan(targets[i])) controls.move(i, targets[i], interval, schedule, driver);
        }
    });
}
// Where they are: what was interrupted on its way stays there.
template <class Access>
void stop_controls(const DirectControls& controls, const double* targets, double time, const Access& access) {
    access([&](Schedule& schedule, Driver* driver) {
        for (std::size_t i = 0; i < controls.list().size(); ++i) {
            if (!std::isnan(targets[i])) {
                controls.hold(i, controls.value(i, time, schedule), time, schedule, driver);
            }
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
