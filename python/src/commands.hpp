// Commands of actuators as rows of numbers from Python: checked, and given to a car's schedule.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "hamilcar/driver/schedule.hpp"
#include "python.hpp"

namespace hamilcar::python {

inline nb::list described(const CommandLayout& layout) {
    nb::list out;
    for (const Command& one : layout.commands()) {
        out.append(nb::make_tuple(one.name, one.unit, one.meaning, one.rest, one.min, one.max));
    }
    return out;
}

// A number for each command of each car, NaN for one that is left alone. The controllers would cut what is beyond the limits at their
// next decision, which may be steps away.
inline void expect_commands(const CommandLayout& layout, const Numbers& told, std::size_t cars) {
    const auto count = static_cast<std::size_t>(layout.size());
    if (told.size() != cars * count) {
        throw nb::value_error(
            fmt::format("expected {} numbers for the commands, found {}", cars * count, told.size()).c_str());
    }
    for (std::size_t i = 0; i < told.size(); ++i) {
        const Command& command = layout.commands()[i % count];
        const double value = told.data()[i];
        if (std::isnan(value) || (value >= command.min && value <= command.max)) continue;
        throw nb::value_error(
            fmt::format("{} = {}: expected {} to {}", command.name, value, command.min, command.max).c_str());
    }
}

inline void tell_commands(const double* told, Schedule& schedule) {
    std::vector<double> commands(schedule.commands().begin(), schedule.commands().end());
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (!std::isnan(told[i])) commands[i] = told[i];
    }
    schedule.set_commands(commands);
}

}  // namespace hamilcar::python
