// [steering]: the ratio from steering wheel to rack, and the mechanics between them.
#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hamilcar::io {

namespace {

void read_rack_curve(const TableReader& table, SteeringDescription& to) {
    const Samples curve = table.samples("angle_deg", "rack_m", not_negative);
    table.expect(curve.argument.size() >= 2 && curve.argument[0] == 0, "angle_deg",
                 "at least two angles, the first of them 0");
    table.expect(curve.value[0] == 0 &&
                     std::ranges::adjacent_find(curve.value, std::ranges::greater_equal{}) == curve.value.end(),
                 "rack_m", "displacements that begin with 0 and increase");
    to.angle = curve.argument, to.rack = curve.value;
    to.rack_per_revolution = 2 * std::numbers::pi * curve.value[1] / curve.argument[1];
}

// What may be left out, all [E] (docs/files/vehicle.md).
constexpr double default_stop_stiffness = 2e6;         // a rubber ring gives way by 5 mm under 10 kN [N/m]
constexpr double default_rack_slack = 1e-4;            // that friction holds before it slides [m]
constexpr double default_wheel_slack = 0.01;           // likewise [rad]
constexpr double default_hands_stiffness = 1000;       // 3 N m turn firm hands by 0.2 degrees [N m/rad]
constexpr Range lag{"number not below 0.002", 0.002};  // that explicit steps can follow [s]

void read_rack(const TableReader& rack, SteeringMechanicsDescription& to) {
    constexpr Range mass{"number from 0.5 to 1000", 0.5, 1000};
    to.rack_mass = rack.number("mass_kg", mass);
    to.rack_damping = rack.number("damping_N_s_per_m", not_negative, 0);
    to.rack_friction = rack.number("friction_N", not_negative, 0);
    to.rack_stiffness = rack.number_or_else("holding_stiffness_N_per_m", positive,
                                            std::max(to.rack_friction, 1.0) / default_rack_slack);
    to.stop_stiffness = rack.number("stop_stiffness_N_per_m", positive, default_stop_stiffness);
}

void read_column(const TableReader& column, SteeringMechanicsDescription& to) {
    constexpr Range inertia{"number from 0.001 to 10", 0.001, 10};
    constexpr Range error{"number from 0 to 10", 0, 10};
    to.wheel_inertia = column.number("inertia_kg_m2", inertia);
    to.wheel_damping = column.number("damping_N_m_s_per_rad", not_negative, 0);
    to.wheel_friction = column.number("friction_N_m", not_negative, 0);
    to.wheel_stiffness = column.number_or_else("holding_stiffness_N_m_per_rad", positive,
                                               std::max(to.wheel_friction, 0.01) / default_wheel_slack);
    to.bar_stiffness = column.number("torsion_bar_stiffness_N_m_per_rad", positive);
    to.bar_damping = column.number("torsion_bar_damping_N_m_s_per_rad", not_negative, 0);
    to.joint_error = column.number("joint_error_deg", error, 0);
    to.joint_phase = column.number("joint_phase_deg", any_number, 0);
}

void read_assist(const TableReader& assist, SteeringAssistDescription& to) {
    constexpr std::size_t max_points = 12;
    const auto expect_points = [&](const char* key, std::size_t count) {
        assist.expect(count >= 2 && count <= max_points, key, "2 to " + std::to_string(max_points) + " numbers");
    };
    const Samples force = assist.samples("torque_N_m", "force_N", not_negative);
    expect_points("torque_N_m", force.argument.size());
    assist.expect(!force.argument.empty() && force.argument[0] == 0 && force.value[0] == 0, "torque_N_m",
                  "a curve that begins with no force at no torque");
    assist.expect(std::ranges::is_sorted(force.value), "force_N", "forces that do not decrease");
    to.torque = force.argument, to.force = force.value;
    assist.choose({{}, {"speed_m_per_s", "share"}}, [&](std::size_t group) {
        if (group == 0) return;
        const Samples share = assist.samples("speed_m_per_s", "share", not_negative);
        expect_points("speed_m_per_s", share.argument.size());
        to.speed = share.argument, to.share = share.value;
    });
    to.response_time = assist.number("response_time_s", lag, to.response_time);
    to.lead_time = assist.number("lead_time_s", not_negative, to.lead_time);
    to.fastest_rack = assist.number("fastest_rack_m_per_s", positive, to.fastest_rack);
    to.rack_band = assist.number("rack_speed_band_m_per_s", positive, to.rack_band);
}

void read_hands(const TableReader& hands, SteeringMechanicsDescription& to) {
    to.hands_stiffness = hands.number("stiffness_N_m_per_rad", positive, to.hands_stiffness);
    to.hands_damping = hands.number_or_else("damping_N_m_s_per_rad", not_negative, to.hands_damping);
}

void read_mechanics(const TableReader& table, SteeringDescription& steering) {
    table.choose({{}, {"rack", "column", "assist", "hands"}}, [&](std::size_t group) {
        if (group == 0) return;
        SteeringMechanicsDescription to;
        read_rack(table.table("rack"), to);
        read_column(table.table("column"), to);
        constexpr double damping_ratio = 0.7;
        to.hands_stiffness = default_hands_stiffness;
        to.hands_damping = 2 * damping_ratio * std::sqrt(to.hands_stiffness * to.wheel_inertia);
        if (const auto hands = table.optional_table("hands")) read_hands(*hands, to);
        if (const auto assist = table.optional_table("assist")) read_assist(*assist, to.assist);
        steering.mechanics = to;
    });
}

}  // namespace

SteeringDescription read_steering(const std::optional<TableReader>& table) {
    SteeringDescription steering;
    if (!table) return steering;
    table->choose({{"rack_m_per_revolution"}, {"angle_deg", "rack_m"}}, [&](std::size_t group) {
        if (group == 1) return read_rack_curve(*table, steering);
        steering.rack_per_revolution = table->number("rack_m_per_revolution", positive);
    });
    steering.rack_travel = table->number("rack_travel_m", positive);
    read_mechanics(*table, steering);
    return steering;
}

}  // namespace hamilcar::io
