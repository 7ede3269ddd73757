// One function per table of a wheel, in the order of docs/files/vehicle.md.
#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/force/axial.hpp"
#include "hamilcar/io/default_values.hpp"

namespace hamilcar::io {

namespace {

Point read_spin_axis(const TableReader& wheel) {
    constexpr Range tilt{"number from -20 to 20", -20, 20};
    Point axis{};
    wheel.choose({{"camber_deg", "toe_in_deg"}, {"spin_axis"}}, [&](std::size_t group) {
        if (group == 1) {
            axis = wheel.direction("spin_axis");
            return wheel.expect(axis[1] > 0, "spin_axis", "a direction to the left: y above zero");
        }
        const double camber = wheel.number("camber_deg", tilt), toe_in = wheel.number("toe_in_deg", tilt);
        axis = {std::cos(camber) * std::sin(toe_in), std::cos(camber) * std::cos(toe_in), -std::sin(camber)};
    });
    return axis;
}

// Where the straight lines between the points pass v = 0.
double force_at_rest(const Samples& curve) {
    const auto& [v, f] = curve;
    const auto above = std::ranges::find_if(v, [](double velocity) { return velocity >= 0; });
    if (above == v.end() || v.front() > 0) return std::nan("");
    const auto i = static_cast<std::size_t>(above - v.begin());
    return i == 0 ? f[0] : f[i] - v[i] * (f[i] - f[i - 1]) / (v[i] - v[i - 1]);
}

DamperDescription read_damper_curve(const TableReader& damper) {
    const Samples curve = damper.samples("velocity_m_per_s", "force_N", any_number);
    constexpr std::size_t max = Damper<double>::max_segments + 1;
    damper.expect(curve.argument.size() >= 2 && curve.argument.size() <= max, "velocity_m_per_s",
                  "2 to " + std::to_string(max) + " numbers");
    const double largest = std::abs(*std::ranges::max_element(curve.value, {}, [](double f) { return std::abs(f); }));
    damper.expect(std::abs(force_at_rest(curve)) <= 1e-9 * largest, "force_N",
                  "a curve through the origin: no force at velocity 0");
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
        damper.expect(curve.argument[i] * curve.value[i] >= 0, "force_N",
                      "forces with the sign of their velocity, so that energy is only lost");
    }
    return {curve.argument, curve.value};
}

}  // namespace

WheelDescription read_wheel(const TableReader& wheel) {
    const Point center = wheel.array<3>("center_m");
    wheel.expect(center[1] > 0, "center_m", "a point of the left side, y above zero");
    return {center, read_spin_axis(wheel), wheel.number("spin_inertia_kg_m2", positive)};
}

DamperDescription read_damper(const TableReader& damper) {
    DamperDescription out;
    damper.choose({{"damping_N_s_per_m"}, {"velocity_m_per_s", "force_N"}}, [&](std::size_t group) {
        if (group == 1) {
            out = read_damper_curve(damper);
        } else {
            const double damping = damper.number("damping_N_s_per_m", not_negative);
            out = {{-1, 1}, {-damping, damping}};
        }
    });
    return out;
}

StopDescription read_stop(const std::optional<TableReader>& stop) {
    if (!stop) return {};
    return {stop->number("gap_m", positive), stop->number("rate_N_per_m", not_negative),
            stop->number("progression_N_per_m2", not_negative, 0)};
}

BrakeDescription read_brake(const std::optional<TableReader>& brake, const WheelDescription& wheel,
                            const BrakeSystemDescription& system) {
    if (!brake) return {};
    const double spins = wheel.spin_inertia;
    BrakeDescription out;
    out.max_torque = brake->number("max_torque_N_m", not_negative);
    out.windup_stiffness =
        brake->number_or_else("windup_stiffness_N_m_per_rad", positive, default_windup_stiffness(spins));
    out.windup_damping = brake->number_or_else("windup_damping_N_m_s_per_rad", not_negative,
                                               default_windup_damping(out.windup_stiffness, spins));
    if (const auto valve = brake->optional_table("valve")) {
        out.valve_command = valve->number("command", fraction);
        out.valve_slope = valve->number("slope", fraction);
    }
    out.parking_torque = brake->number("parking_torque_N_m", not_negative, 0);
    read_brake_in_system(*brake, system, out);
    return out;
}

}  // namespace hamilcar::io
