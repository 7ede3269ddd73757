// One function per table of a power unit, in the order of docs/files/vehicle.md.
#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/driveline/source.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/default_values.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

using units::rpm;

void expect_points(const TableReader& table, std::string_view key, std::size_t count) {
    table.expect(count >= 2 && count <= std::size_t{max_curve_points}, key,
                 "2 to " + std::to_string(max_curve_points) + " numbers");
}

// Between overrun and full load, if the file has any.
void read_part_loads(const TableReader& engine, EngineDescription& to) {
    if (!engine.has("part_load")) return;
    constexpr Range part{"number between 0 and 1", 0, 1, false};
    const std::vector<double> speed = to.torque[0].speed;
    for (const TableReader& load : engine.tables("part_load")) {
        const double throttle = load.number("throttle", part);
        load.expect(throttle > to.throttle.back() && throttle < 1, "throttle",
                    "a number between the one before, " + number_text(to.throttle.back()) + ", and 1");
        const std::vector<double> torque = load.numbers("torque_N_m", any_number);
        load.expect(torque.size() == speed.size(), "torque_N_m",
                    std::to_string(speed.size()) + " numbers, one for each of 'speed_rpm'");
        to.throttle.push_back(throttle);
        to.torque.push_back({speed, torque});
    }
    engine.expect(to.throttle.size() < std::size_t{max_curve_points}, "part_load",
                  std::to_string(max_curve_points - 2) + " part loads at most");
}

// Between two points ratio and torque ratio are linear, their product, turbine power over pump power, a parabola.
double max_efficiency(const Samples& torque_ratio) {
    double max_found = 0;
    const auto look = [&](double nu, double ratio) { max_found = std::max(max_found, nu * ratio); };
    for (std::size_t i = 0; i < torque_ratio.argument.size(); ++i) {
        const double x = torque_ratio.argument[i], y = torque_ratio.value[i];
        look(x, y);
        if (i + 1 == torque_ratio.argument.size()) break;
        const double next = torque_ratio.argument[i + 1], slope = (torque_ratio.value[i + 1] - y) / (next - x);
        const double top = slope < 0 ? 0.5 * (x - y / slope) : next;
        if (top > x && top < next) look(top, y + slope * (top - x));
    }
    return max_found;
}

// The starter brings it to where it fires, against its drag.
void check_starting(const TableReader& table, const EngineDescription& engine) {
    using Engine = CombustionEngine<double>;
    const Curve<double> drag(engine.torque.front().speed, engine.torque.front().torque);
    const double starter = Engine::starter_share * engine.torque.back().torque.front();
    const double fires = Engine::full_combustion * engine.idle_speed;
    double max = -drag.at(fires);
    for (std::size_t i = 0; i < engine.torque.front().speed.size(); ++i) {
        if (engine.torque.front().speed[i] < fires) max = std::max(max, -engine.torque.front().torque[i]);
    }
    table.expect(
        max < starter, "overrun_N_m",
        "numbers above " + number_text(-starter) +
            " up to half of 'idle_rpm', where it fires: the starter has 0.3 times the first of 'full_load_N_m'");
}

EngineDescription read_engine(const TableReader& table) {
    constexpr Range not_positive{"number not above zero", -std::numeric_limits<double>::infinity(), 0};
    const Samples full = table.samples("speed_rpm", "full_load_N_m", any_number);
    Samples overrun{full.argument, default_overrun(full.argument, std::ranges::max(full.value))};
    if (table.has("overrun_N_m")) overrun = table.samples("speed_rpm", "overrun_N_m", not_positive);
    expect_points(table, "speed_rpm", full.argument.size());
    table.expect(full.argument[0] >= 0, "speed_rpm", "speeds not below zero");
    for (std::size_t i = 0; i < full.value.size(); ++i) {
        table.expect(full.value[i] >= overrun.value[i], "full_load_N_m", "no torque below that of 'overrun_N_m'");
    }
    table.expect(full.value[0] > 0, "full_load_N_m", "a first torque above zero: the engine has to start");
    table.expect(full.value.back() <= 0, "full_load_N_m", "a last torque of 0 or below: there the engine is limited");
    EngineDescription engine;
    engine.idle_speed = table.number("idle_rpm", positive);
    table.expect(engine.idle_speed < full.argument.back(), "idle_rpm", "a number below the last of 'speed_rpm'");
    engine.throttle = {0};
    engine.torque = {{overrun.argument, overrun.value}};
    read_part_loads(table, engine);
    engine.throttle.push_back(1);
    engine.torque.push_back({full.argument, full.value});
    if (!table.is_recording()) check_starting(table, engine);
    return engine;
}

MotorDescription read_motor(const TableReader& table) {
    return {.max_torque = table.number("max_torque_N_m", positive),
            .max_power = table.number("max_power_W", positive),
            .max_speed = table.number("max_speed_rpm", positive),
            .regeneration = table.number("regeneration", fraction, 0)};
}

ConverterDescription read_converter(const TableReader& table) {
    constexpr std::string_view pump_key = "pump_torque_at_2000rpm_N_m";
    const Samples curve = table.samples("speed_ratio", "torque_ratio", positive);
    expect_points(table, "speed_ratio", curve.argument.size());
    table.expect(curve.argument.front() >= 0 && curve.argument.back() <= 1, "speed_ratio", "numbers from 0 to 1");
    ConverterDescription converter{.speed_ratio = curve.argument,
                                   .torque_ratio = curve.value,
                                   .capacity = table.numbers(pump_key, not_negative),
                                   .lockup_capacity = table.number("lockup_capacity_N_m", not_negative, 0)};
    table.expect(converter.capacity.size() == curve.argument.size(), pump_key,
                 std::to_string(curve.argument.size()) + " numbers, one for each of 'speed_ratio'");
    table.expect(max_efficiency(curve) <= 1 + 1e-9, "torque_ratio",
                 "numbers that times their speed ratio, there and between, are 1 at most: no converter makes power");
    table.expect(curve.argument.back() == 1, "speed_ratio", "a last number of 1, where pump and turbine turn alike");
    table.expect(converter.capacity.empty() || converter.capacity.back() == 0, pump_key,
                 "a last number of 0: what turns alike passes no torque");
    for (double& capacity : converter.capacity) capacity /= (2000 * rpm) * (2000 * rpm);
    return converter;
}

std::variant<ClutchDescription, ConverterDescription> read_coupling(const TableReader& unit) {
    std::variant<ClutchDescription, ConverterDescription> out;
    unit.choose({{"clutch"}, {"converter"}}, [&](std::size_t group) {
        if (group == 1) {
            out = read_converter(unit.table("converter"));
        } else if (const auto clutch = unit.optional_table("clutch")) {
            out = ClutchDescription{clutch->number("capacity_N_m", not_negative)};
        }
    });
    return out;
}

// A gear that was shifted to must not be left at once.
void check_shifts(const TableReader& table, const GearboxDescription& gearbox) {
    double step = 1;  // largest fall of the speed [1]
    for (std::size_t i = 0; i + 1 < gearbox.ratios.size(); ++i) {
        step = std::min(step, gearbox.ratios[i + 1] / gearbox.ratios[i]);
    }
    const auto check = [&](std::string_view key, double up, double down) {
        table.expect(gearbox.upshift_speed == 0 || down < up * step, key,
                     "a number below " + number_text(up * step / rpm) + ", which is left after shifting up");
    };
    check("downshift_rpm", gearbox.upshift_speed, gearbox.downshift_speed);
    check("downshift_closed_rpm", gearbox.upshift_speed_closed, gearbox.downshift_speed_closed);
    table.expect(!gearbox.automatic || gearbox.ratios.size() == 1 || gearbox.upshift_speed > 0, "upshift_rpm",
                 "a positive number: an automatic gearbox shifts by itself");
}

GearboxDescription read_gearbox(const std::optional<TableReader>& table) {
    constexpr Range efficiency{"number above 0, 1 at most", 0, 1, false};
    GearboxDescription gearbox;
    if (!table) return gearbox;
    gearbox.ratios = table->numbers("ratios", positive);
    table->expect(gearbox.ratios.size() <= std::size_t{max_gears}, "ratios",
                  std::to_string(max_gears) + " gears at most");
    table->expect(std::ranges::adjacent_find(gearbox.ratios, std::ranges::less_equal{}) == gearbox.ratios.end(),
                  "ratios", "numbers that decrease, from first gear on");
    gearbox.reverse_ratio = table->number("reverse_ratio", not_negative, 0);
    gearbox.efficiency = table->number("efficiency", efficiency, 1);
    gearbox.automatic = word<bool>(*table, "shift", {{"manual", false}, {"automatic", true}});
    gearbox.shift_time = table->number("shift_time_s", not_negative, gearbox.shift_time);
    gearbox.upshift_speed = table->number("upshift_rpm", not_negative, 0);
    gearbox.upshift_speed_closed = table->number_or_else("upshift_closed_rpm", not_negative, gearbox.upshift_speed);
    gearbox.downshift_speed = table->number("downshift_rpm", not_negative, 0);
    gearbox.downshift_speed_closed =
        table->number_or_else("downshift_closed_rpm", not_negative, gearbox.downshift_speed);
    check_shifts(*table, gearbox);
    return gearbox;
}

// What shifts up at a speed has to come there.
void check_limit(const TableReader& table, const PowerUnitDescription& unit) {
    const double max_speed = std::visit(
        [](const auto& source) {
            if constexpr (requires { source.torque; }) {
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

// Of the differentials, the one that the unit drives.
std::size_t read_output(const TableReader& unit, const VehicleDescription& vehicle) {
    const std::string name = unit.text("output");
    const auto& all = vehicle.differentials;
    std::vector<std::string_view> names;
    for (const DifferentialDescription& differential : all) names.push_back(differential.name);
    const auto found = std::ranges::find(names, name);
    const std::string hint = did_you_mean(name, names);
    unit.expect(found != names.end(), "output",
                "the name of a [[differential]], which an axle needs to be driven" + (hint.empty() ? "" : "; " + hint));
    return static_cast<std::size_t>(found - names.begin());
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

PowerUnitDescription read_power_unit(const TableReader& table, const VehicleDescription& vehicle) {
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
    check_limit(table, unit);
    const auto* clutch = std::get_if<ClutchDescription>(&unit.coupling);
    const bool stalls = std::holds_alternative<EngineDescription>(unit.source) && clutch && clutch->capacity == 0;
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
    for (const PowerUnitDescription& unit : vehicle.power_units) driven[unit.output] = true;
    for (const DifferentialDescription& differential : vehicle.differentials) {
        for (const DifferentialDescription::Output& output : differential.outputs) {
            if (!output.wheel) driven[output.number] = true;
        }
    }
    for (std::size_t i = 0; i < tables.size(); ++i) {
        tables[i].expect(driven[i], "name",
                         "a differential that a power unit has for its 'output', or another one among its 'outputs'");
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
    if (file.is_recording()) return;
    check_inputs(differentials, vehicle);
    std::vector<std::pair<double, Point>> rotors;
    for (const PowerUnitDescription& unit : vehicle.power_units) rotors.emplace_back(unit.inertia, unit.axis);
    if (!has_units) return;
    file.tables("power_unit")
        .back()
        .expect(has_room_for(vehicle.chassis, rotors), "inertia_kg_m2",
                "a rotor that leaves the chassis, whose inertia contains it, an inertia "
                "that a body can have");
}

}  // namespace

void read_powertrain(const TableReader& file, VehicleDescription& vehicle) {
    for (const std::string_view key : {"differential", "power_unit"}) static_cast<void>(file.has(key));
    file.choose_flag("powertrain", true, file, [&](bool wanted) {
        if (wanted) read_differentials_and_power_units(file, vehicle);
    });
}

}  // namespace hamilcar::io
