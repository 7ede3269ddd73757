// One function per table of a power unit, in the order of docs/files/vehicle.md.
#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <utility>

#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/default_values.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

using units::rpm;

// What shifts up at a speed has to come there.
void check_limit(const TableReader& table, const PowerUnitDescription& unit) {
    const double max_speed = std::visit(
        [](const auto& source) {
            if constexpr (requires { source.idle_speed; }) {
                return source.torque.back().speed.back();
            } else {
                return source.max_speed;
            }
        },
        unit.source);
    const auto gearbox = table.optional_table("gearbox");
    if (!gearbox || table.is_recording()) return;
    gearbox->expect(unit.gearbox.upshift_speed < max_speed, "upshift_rpm",
                    "a number below the speed at which the torque ends, " + number_text(max_speed / rpm));
}

// A differential, or a wheel that none drives.
DrivenPart read_output(const TableReader& unit, const VehicleDescription& vehicle) {
    const std::string name = unit.text("output");
    std::vector<std::string> wheels;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t on) { wheels.push_back(on == 0 ? wheel.name : ""); });
    std::vector<std::string_view> names;
    for (const DifferentialDescription& differential : vehicle.differentials) names.push_back(differential.name);
    const std::size_t differentials = names.size();
    names.insert(names.end(), wheels.begin(), wheels.end());
    const auto found = std::ranges::find(names, name);
    const std::string hint = did_you_mean(name, names);
    unit.expect(found != names.end() && !name.empty(), "output",
                "the name of a [[differential]], which an axle needs to be driven, or of a wheel of the motor vehicle" +
                    (hint.empty() ? "" : "; " + hint));
    const auto place = static_cast<std::size_t>(found - names.begin());
    if (place < differentials) return {.wheel = false, .number = place};
    const DrivenPart out{.wheel = true, .number = place - differentials};
    for (const DifferentialDescription& differential : vehicle.differentials) {
        for (const DrivenPart& driven : differential.outputs) {
            unit.expect(!driven.wheel || driven.number != out.number, "output",
                        "a wheel that no differential drives, or the differential '" + differential.name + "'");
        }
    }
    return out;
}

SuspensionWheelDescription& wheel_of(VehicleDescription& vehicle, std::size_t number) {
    std::size_t before = 0, s = 0;
    while (number >= before + vehicle.suspensions[s].wheels.size()) before += vehicle.suspensions[s++].wheels.size();
    return vehicle.suspensions[s].wheels[number - before];
}

// A unit on the carrier of a wheel turns with it; one in the chassis reaches a wheel whose drive reacts on the chassis.
void read_mount(const TableReader& table, PowerUnitDescription& unit, VehicleDescription& vehicle) {
    unit.in_wheel = word<bool>(table, "mount", {{"chassis", false}, {"carrier", true}});
    if (table.is_recording() || !(unit.in_wheel || unit.output.wheel)) return;
    if (!unit.in_wheel) {
        return table.expect(wheel_of(vehicle, unit.output.number).drive_reaction == 0, "output",
                            "a wheel that a shaft from the chassis can drive: this one's axle carries what drives it");
    }
    table.expect(unit.output.wheel, "output", "the name of a wheel, on whose carrier the unit sits");
    table.expect(std::holds_alternative<MotorDescription>(unit.source), "mount",
                 "\"chassis\": an engine does not turn with a wheel");
    for (const char* key : {"clutch", "converter", "shafts"}) {
        table.expect(!table.has(key), key, "no such table: a unit on a carrier turns with its wheel");
    }
    table.expect(unit.gearbox.ratios.size() == 1, "gearbox", "one ratio: a unit on a carrier turns with its wheel");
    table.expect(unit.gearbox.reverse_ratio == 0 || unit.gearbox.reverse_ratio == unit.gearbox.ratios[0], "gearbox",
                 "a reverse_ratio of 0 or that of the one ratio: a unit on a carrier turns with its wheel");
    SuspensionWheelDescription& wheel = wheel_of(vehicle, unit.output.number);
    const double ratio = unit.gearbox.ratios[0];
    wheel.drive_reaction = wheel.part;
    wheel.wheel.spin_inertia += ratio * ratio * unit.inertia;
}

// What goes with the largest torque where the file does not tell it.
void read_by_torque(const TableReader& table, PowerUnitDescription& unit) {
    double torque = 0, inertia = 0;
    if (const auto* engine = std::get_if<EngineDescription>(&unit.source)) {
        torque = std::ranges::max(engine->torque.back().torque), inertia = default_engine_inertia(torque);
    } else {
        torque = std::get<MotorDescription>(unit.source).max_torque, inertia = default_motor_inertia(torque);
    }
    unit.inertia = table.number_or_else("inertia_kg_m2", positive, inertia);
    unit.stiffness = table.number_or_else("stiffness_N_m_per_rad", positive, default_unit_stiffness(torque));
}

PowerUnitDescription read_power_unit(const TableReader& table, VehicleDescription& vehicle) {
    PowerUnitDescription unit;
    unit.name = table.text("name");
    unit.axis = table.direction("axis", unit.axis);
    constexpr double min_response_time = 0.005;  // that explicit steps can follow [s]
    unit.response_time = table.number("response_time_s", not_negative, 0);
    table.expect(unit.response_time == 0 || unit.response_time >= min_response_time, "response_time_s",
                 "0, at once, or a number not below 0.005");
    unit.damping_ratio = table.number("damping_ratio", not_negative, 0.1);
    unit.output = read_output(table, vehicle);
    table.choose({{"engine"}, {"motor"}}, [&](std::size_t group) {
        if (group == 0) {
            unit.source = read_engine(table.table("engine"));
        } else {
            unit.source = read_motor(table.table("motor"));
        }
    });
    read_by_torque(table, unit);
    unit.coupling = read_coupling(table);
    unit.gearbox = read_gearbox(table.optional_table("gearbox"));
    unit.shafts = read_shafts(table.optional_table("shafts"));
    read_mount(table, unit, vehicle);
    check_limit(table, unit);
    const auto* clutch = std::get_if<ClutchDescription>(&unit.coupling);
    const bool stalls = std::holds_alternative<EngineDescription>(unit.source) && clutch && clutch->capacity == 0;
    const auto* motor = std::get_if<MotorDescription>(&unit.source);
    table.expect(!motor || motor->brake_regeneration == 0 || clutch, "converter",
                 "no such table beside brake_regeneration: what it passes on is not known to the brakes");
    table.expect(!stalls, "engine", "a [power_unit.clutch] that slips or a [power_unit.converter] beside it");
    return unit;
}

std::vector<std::string> names_of_others(const VehicleDescription& vehicle) {
    std::vector<std::string> names;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { names.push_back(wheel.name); });
    for (const SuspensionDescription& suspension : vehicle.suspensions) names.push_back(suspension.name);
    for (const TrailerDescription& trailer : vehicle.trailers) names.push_back(trailer.name);
    return names;
}

// `tables`: of the differentials in the vehicle's order.
void check_inputs(const std::vector<TableReader>& tables, const VehicleDescription& vehicle) {
    std::vector<bool> driven(tables.size());
    for (const PowerUnitDescription& unit : vehicle.power_units) {
        if (!unit.output.wheel) driven[unit.output.number] = true;
    }
    for (const DifferentialDescription& differential : vehicle.differentials) {
        for (const DrivenPart& output : differential.outputs) {
            if (!output.wheel) driven[output.number] = true;
        }
    }
    for (std::size_t i = 0; i < tables.size(); ++i) {
        tables[i].expect(driven[i], "name",
                         "a differential that a power unit has for its 'output', or another one among its 'outputs'");
    }
}

// All wheels that a part drives.
void add_wheels_of(const DrivenPart& part, const VehicleDescription& vehicle, std::vector<std::size_t>& to) {
    if (part.wheel) return to.push_back(part.number);
    for (const DrivenPart& output : vehicle.differentials[part.number].outputs) add_wheels_of(output, vehicle, to);
}

// Of two motors that brake one wheel in place of its brake neither would know of the other.
void check_regeneration(const TableReader& file, const VehicleDescription& vehicle) {
    std::vector<std::size_t> braked;
    for (std::size_t i = 0; i < vehicle.power_units.size(); ++i) {
        const auto* motor = std::get_if<MotorDescription>(&vehicle.power_units[i].source);
        if (!motor || motor->brake_regeneration <= 0) continue;
        std::vector<std::size_t> own;
        add_wheels_of(vehicle.power_units[i].output, vehicle, own);
        for (const std::size_t wheel : own) {
            file.tables("power_unit")[i].table("motor").expect(std::ranges::find(braked, wheel) == braked.end(),
                                                               "brake_regeneration",
                                                               "0: another motor that drives the same wheel has it");
        }
        braked.insert(braked.end(), own.begin(), own.end());
    }
}

void read_differentials_and_power_units(const TableReader& file, VehicleDescription& vehicle) {
    const bool has_differentials = file.has("differential"), has_units = file.has("power_unit");
    std::vector<TableReader> differentials;
    if (has_differentials) differentials = read_differentials(file, vehicle);
    if (has_units) {
        std::vector<std::string> taken = names_of_others(vehicle);
        for (const TableReader& table : file.tables("power_unit")) {
            check_name(table, taken, "power unit, axle, wheel or trailer");
            vehicle.power_units.push_back(read_power_unit(table, vehicle));
        }
        file.expect(vehicle.power_units.size() <= std::size_t{max_power_units}, "power_unit",
                    std::to_string(max_power_units) + " power units at most");
    }
    vehicle.battery = read_battery(file.optional_table("battery"), vehicle);
    if (file.is_recording()) return;
    check_inputs(differentials, vehicle);
    check_regeneration(file, vehicle);
    std::vector<std::pair<double, Point>> rotors;
    for (const PowerUnitDescription& unit : vehicle.power_units) {
        if (unit.in_wheel) continue;
        rotors.emplace_back(unit.inertia, unit.axis);
        if (unit.shafts.exists) rotors.emplace_back(unit.shafts.gearbox_inertia, unit.axis);
    }
    if (!has_units) return;
    file.tables("power_unit")
        .back()
        .expect(has_room_for(vehicle.chassis, rotors), "inertia_kg_m2",
                "a rotor that leaves the chassis, whose inertia contains it, an inertia "
                "that a body can have");
}

}  // namespace

void read_powertrain(const TableReader& file, VehicleDescription& vehicle) {
    for (const std::string_view key : {"differential", "power_unit", "battery"}) static_cast<void>(file.has(key));
    file.choose_flag("powertrain", true, file, [&](bool wanted) {
        if (wanted) read_differentials_and_power_units(file, vehicle);
    });
}

}  // namespace hamilcar::io
