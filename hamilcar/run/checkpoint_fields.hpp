// Every field of a checkpoint with the values that it may have: one list for who writes and for who reads. A visitor has
//
//     real(name, number, limits), whole(name, number or enumeration, limits), choice(name, enumeration, which are allowed),
//     truth(name, yes), state(name, layout, numbers, limits of the position)
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "hamilcar/run/record.hpp"
#include "hamilcar/run/simulation.hpp"
#include "hamilcar/vehicle/state_layout.hpp"

namespace hamilcar {

// What a field may be, ends included; no NaN is within any limits.
struct Limits {
    double min, max;
};
inline constexpr Limits any_finite{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
inline constexpr Limits any_number_at_all{-std::numeric_limits<double>::infinity(),
                                          std::numeric_limits<double>::infinity()};

// What the vehicle, the method and the scenario leave open.
struct SnapshotBounds {
    explicit SnapshotBounds(const Simulation& simulation);

    StateLayout layout;
    int order;                                 // of the method
    bool is_multi_step;                        // it remembers past rates
    double step;                               // [s]
    double lowest_gear = 0, highest_gear = 0;  // that a driver who has begun may have chosen
    std::array<bool, static_cast<std::size_t>(EndingMemory::Reason::roll) + 1> endings{};  // by reason
    CommandLayout commands;
    std::size_t control_memory;              // numbers that sensors and controllers remember
    static constexpr double steps = 1e9;     // that a run may have
    static constexpr double farthest = 1e9;  // from the origin, and along a path [m]
};

// Of a driver at `time` after the run's start [s].
template <class SomeMemory, class Visitor>
void visit_driver(SomeMemory& d, double time, const SnapshotBounds& b, Visitor& v) {
    const Limits along{-b.farthest, b.farthest}, clock{0, time};
    v.truth("driver.begun", d.begun), v.real("driver.first_time", d.first_time, clock);
    v.truth("driver.has_throttle", d.has_throttle), v.real("driver.throttle", d.throttle, {0, 1});

    v.truth("driver.path.begun", d.path.begun);
    v.real("driver.path.station", d.path.station, along), v.real("driver.path.offset", d.path.offset, along);
    v.real("driver.path.shift", d.path.shift, along), v.real("driver.path.farthest", d.path.farthest, along);
    v.real("driver.path.farthest_station", d.path.farthest_station, along);

    v.real("driver.speed.integral", d.speed.integral, any_finite);
    v.truth("driver.speed.braking", d.speed.braking), v.real("driver.speed.hold", d.speed.hold, {0, 1});
    v.real("driver.speed.interrupted", d.speed.interrupted, any_finite);
    v.real("driver.speed.straining", d.speed.straining, any_finite);
    v.real("driver.speed.watched_from", d.speed.watched_from, any_finite);
    v.real("driver.speed.watched", d.speed.watched, any_finite);
    v.truth("driver.speed.out_of_reach", d.speed.out_of_reach);
    v.real("driver.speed.wanted", d.speed.wanted, any_finite);
    v.real("driver.speed.reached", d.speed.reached, any_finite);

    v.whole("driver.shifting.phase", d.shifting.phase, {0, static_cast<double>(ShiftMemory::Phase::changing)});
    const bool begun = d.shifting.phase != ShiftMemory::Phase::unbegun;
    const Limits gears = begun ? Limits{b.lowest_gear, b.highest_gear} : Limits{0, 0};
    v.whole("driver.shifting.gear", d.shifting.gear, gears), v.whole("driver.shifting.next", d.shifting.next, gears);
    v.real("driver.shifting.clock", d.shifting.clock, any_finite);
    v.real("driver.shifting.throttle", d.shifting.throttle, any_finite);

    v.choice("driver.ending.reason", d.ending.reason, b.endings);
    v.real("driver.ending.reached", d.ending.reached, any_finite);
    v.real("driver.ending.time", d.ending.time, clock);
    v.truth("driver.ending.begun", d.ending.begun);
    v.real("driver.ending.x", d.ending.x, along), v.real("driver.ending.y", d.ending.y, along);
    v.real("driver.ending.lateral_velocity", d.ending.lateral_velocity, any_finite);
    v.real("driver.ending.last_time", d.ending.last_time, clock);
    v.real("driver.ending.distance", d.ending.distance, along);
    v.real("driver.ending.lateral_acceleration", d.ending.lateral_acceleration, any_finite);
}

// Of a Snapshot to be read or a const one to be written.
template <class SomeSnapshot, class Visitor>
void visit_snapshot(SomeSnapshot& s, const SnapshotBounds& b, Visitor& v) {
    v.whole("step_count", s.step_count, {0, b.steps});
    const auto size = static_cast<std::size_t>(b.layout.size());
    v.state("state", b.layout, std::span(s.state.values.data(), size), Limits{-b.farthest, b.farthest});

    // Since a run's start every step has added one rate to the ring of past ones.
    const auto taken = static_cast<double>(s.step_count);
    const double remembered = b.is_multi_step ? std::min(taken, static_cast<double>(b.order)) : 0;
    const auto newest = b.is_multi_step ? static_cast<double>(s.step_count % b.order) : 0;
    v.whole("memory.remembered", s.memory.remembered, {remembered, remembered});
    v.whole("memory.newest", s.memory.newest, {newest, newest});
    v.real("memory.substep", s.memory.substep, {0, b.step});
    v.truth("memory.converged", s.memory.converged);
    for (int j = 0; j < s.memory.remembered; ++j) {
        const auto k = static_cast<std::size_t>((s.memory.newest + b.order - j) % b.order);
        v.state("memory.past", b.layout, std::span(s.memory.past[k].values.data(), size), any_finite);
    }

    for (std::size_t i = 0; i < control_count; ++i) {
        v.truth("inputs.follows", s.inputs.follows[i]);
        if (!s.inputs.follows[i]) continue;
        auto& span = s.inputs.spans[i];
        v.real("inputs.inverse_duration", span.piece.inverse_duration, any_finite);
        v.real("inputs.y0", span.piece.y0, any_finite), v.real("inputs.a", span.piece.a, any_finite);
        v.real("inputs.b", span.piece.b, any_finite), v.real("inputs.c", span.piece.c, any_finite);
        v.real("inputs.begin", span.begin, any_number_at_all), v.real("inputs.end", span.end, any_number_at_all);
    }
    const std::vector<Command>& commands = b.commands.commands();
    v.whole("commands", s.inputs.command_count,
            {static_cast<double>(commands.size()), static_cast<double>(commands.size())});
    for (std::size_t i = 0; i < commands.size(); ++i) {
        v.real(commands[i].name, s.inputs.commands[i], {commands[i].min, commands[i].max});
    }
    for (std::size_t i = 0; i < b.control_memory; ++i) v.real("controllers' memory", s.control[i], any_finite);
    visit_driver(s.driver, (taken + 1) * b.step, b, v);
}

// How the run went so far. Where no energy account was kept its error is a NaN, which is no number of a file.
template <class SomeSummary, class Visitor>
void visit_figures(SomeSummary& summary, Visitor& v) {
    constexpr Limits size{0,
                          any_number_at_all.max};  // of numbers that were too large, none is left but an infinite one
    bool kept = !std::isnan(summary.max_balance_error);
    v.real("max_violation", summary.max_violation, size);
    v.truth("energy_kept", kept);
    if (kept) {
        v.real("max_balance_error", summary.max_balance_error, size);
    } else if constexpr (!std::is_const_v<SomeSummary>) {
        summary.max_balance_error = std::numeric_limits<double>::quiet_NaN();
    }
    v.real("max_kinetic_energy", summary.max_kinetic_energy, size);
    v.real("max_work", summary.max_work, size);
    v.real("wall_time", summary.wall_time, size);
}

}  // namespace hamilcar
