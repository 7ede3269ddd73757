// Electric motors, and the battery that they share.
#include <algorithm>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/vehicle_tables.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t max_levels = 8;  // of a map
constexpr Range efficiency{"number from 0.05 to 1", 0.05, 1};
constexpr double default_efficiency = 0.9;  // [E] of motor and inverter together

// Rows of a map, each with a level and as many values as there are speeds.
struct MapKeys {
    std::string_view rows, level, value;
    Range range;
};

MapDescription read_map(const TableReader& table, const MapKeys& keys) {
    MapDescription out;
    const std::vector<double> speed = table.numbers("speed_rpm", not_negative);
    expect_points(table, "speed_rpm", speed.size());
    table.expect(std::ranges::adjacent_find(speed, std::ranges::greater_equal{}) == speed.end(), "speed_rpm",
                 "numbers that increase");
    for (const TableReader& row : table.tables(keys.rows)) {
        const double level = row.number(keys.level, positive);
        row.expect(out.level.empty() || level > out.level.back(), keys.level, "a number above the one before");
        const std::vector<double> values = row.numbers(keys.value, keys.range);
        row.expect(values.size() == speed.size(), keys.value,
                   std::to_string(speed.size()) + " numbers, one for each of 'speed_rpm'");
        out.level.push_back(level), out.speed.push_back(speed), out.value.push_back(values);
    }
    table.expect(out.level.size() <= max_levels, keys.rows, std::to_string(max_levels) + " tables at most");
    return out;
}

// The numbers that stand for the whole motor, from its map.
void read_torque_map(const TableReader& table, MotorDescription& to) {
    to.torque = read_map(table, {"at_voltage", "voltage_V", "torque_N_m", not_negative});
    if (table.is_recording()) return;
    for (std::size_t i = 0; i < to.torque.level.size(); ++i) {
        for (std::size_t k = 0; k < to.torque.speed[i].size(); ++k) {
            const double torque = to.torque.value[i][k];
            to.max_torque = std::max(to.max_torque, torque);
            to.max_power = std::max(to.max_power, torque * to.torque.speed[i][k]);
        }
    }
    to.max_speed = to.torque.speed[0].back();
    table.expect(to.max_power > 0, "at_voltage", "torques above zero at some speed");
}

}  // namespace

void expect_points(const TableReader& table, std::string_view key, std::size_t count) {
    table.expect(count >= 2 && count <= std::size_t{max_curve_points}, key,
                 "2 to " + std::to_string(max_curve_points) + " numbers");
}

MotorDescription read_motor(const TableReader& table) {
    MotorDescription out;
    table.choose({{"max_torque_N_m", "max_power_W", "max_speed_rpm"}, {"speed_rpm", "at_voltage"}},
                 [&](std::size_t group) {
                     if (group == 1) return read_torque_map(table, out);
                     out.max_torque = table.number("max_torque_N_m", positive);
                     out.max_power = table.number("max_power_W", positive);
                     out.max_speed = table.number("max_speed_rpm", positive);
                 });
    out.regeneration = table.number("regeneration", fraction, 0);
    out.brake_regeneration = table.number("brake_regeneration", fraction, 0);
    table.choose({{"efficiency"}, {"efficiency_map"}}, [&](std::size_t group) {
        if (group == 1) {
            out.efficiency_map =
                read_map(table.table("efficiency_map"), {"at_torque", "torque_N_m", "efficiency", efficiency});
        } else {
            out.efficiency = table.number("efficiency", efficiency, default_efficiency);
        }
    });
    return out;
}

BatteryDescription read_battery(const std::optional<TableReader>& table, const VehicleDescription& vehicle) {
    BatteryDescription out;
    if (!table) return out;
    out.exists = true;
    out.capacity = table->number("capacity_Ah", positive);
    const Samples voltage = table->samples("charge", "open_voltage_V", positive);
    expect_points(*table, "charge", voltage.argument.size());
    table->expect(voltage.argument.front() == 0 && voltage.argument.back() == 1, "charge", "numbers from 0 to 1");
    table->expect(std::ranges::is_sorted(voltage.value), "open_voltage_V", "numbers that do not decrease");
    out.charge = voltage.argument, out.voltage = voltage.value;
    out.resistance = table->number("resistance_ohm", not_negative);
    out.initial_charge = table->number("initial_charge", fraction, out.initial_charge);
    out.max_discharge = table->number("max_discharge_W", positive);
    out.max_charge = table->number("max_charge_W", not_negative);
    out.auxiliary_power = table->number("auxiliary_power_W", not_negative, 0);
    if (table->is_recording()) return out;
    // Beyond half of the open-circuit voltage more current brings less power.
    const double most = out.resistance > 0 ? out.voltage.front() * out.voltage.front() / (4 * out.resistance) : 1e12;
    table->expect(out.max_discharge < most, "max_discharge_W",
                  "a number below " + number_text(most) + ", all that the resistance lets through when it is empty");
    table->expect(out.auxiliary_power < out.max_discharge, "auxiliary_power_W", "a number below 'max_discharge_W'");
    const bool electric = std::ranges::any_of(vehicle.power_units, [](const PowerUnitDescription& unit) {
        return std::holds_alternative<MotorDescription>(unit.source);
    });
    table->expect(electric, "capacity_Ah", "a [[power_unit]] with a motor beside the battery");
    return out;
}

}  // namespace hamilcar::io
