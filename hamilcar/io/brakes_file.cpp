// A brake system: what becomes of the foot's force, and what every brake needs to make torque of pressure. People know pedals, boosters
// and cylinders; the description has the pressures that follow from them.
#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <initializer_list>
#include <numbers>

#include "hamilcar/base/text.hpp"

namespace hamilcar::io {

namespace {

constexpr double bar = 1e5;                            // [Pa]
constexpr Range lag{"number not below 0.005", 0.005};  // that explicit steps can follow [s]

// What may be left out, all [E] (docs/files/vehicle.md).
constexpr double default_response_time = 0.05;  // [s]
// With the response above a chamber has 60 percent of its pressure after 0.2 s and falls to 5 percent in 0.5 s; FMVSS 121 (S5.3.3,
// S5.3.4) allows trucks 0.45 and 0.55 s.
constexpr double default_chamber_time = 0.15;  // [s]
// A caliper with pad friction 0.4 on both sides at a radius of 0.13 m has a piston of 1 / 0.104 m for each N m/Pa. Clearance, pads, caliper
// and hose give way by 1 mm of its stroke at the reference pressure.
double default_volume(double max_torque, double full_pressure) {
    constexpr double smallest = 0.2e-6;  // that a file may state [m^3]
    return std::max(1e-3 / 0.104 * max_torque / full_pressure, smallest);
}
// An open line raises an empty brake by 2000 bar/s at a difference of 100 bar, as a full application in a tenth of a second does.
double default_line_flow(double volume) {
    return 2000 * bar / brake_reference_pressure * volume;
}

void refuse(const TableReader& table, std::initializer_list<const char*> keys, const std::string& expectation) {
    if (table.is_recording()) return;
    for (const char* key : keys) {
        if (table.has(key)) table.expect(false, key, expectation);
    }
}

// The booster multiplies the foot's force up to its knee; beyond it the foot alone adds to the pressure.
void read_pedal(const TableReader& table, BrakeSystemDescription& to) {
    constexpr Range from_one{"number from 1 to 30", 1, 30};
    constexpr std::string_view diameter_key = "master_cylinder_diameter_mm";
    to.pedal_ratio = table.number("pedal_ratio", from_one);
    const double gain = table.number("booster_gain", from_one, 1);
    const double diameter = table.number(diameter_key, positive);
    to.master_area = std::numbers::pi / 4 * diameter * diameter;
    const double by_foot = to.pedal_force * to.pedal_ratio / to.master_area, boosted = gain * by_foot;  // [Pa]
    to.knee_pressure = std::min(table.number_or_else("knee_pressure_bar", positive, boosted), boosted);
    to.knee_command = to.knee_pressure / boosted;
    to.full_pressure = to.knee_pressure + (1 - to.knee_command) * by_foot;
    // Brakes have 50 to 200 bar; far from that a unit is wrong.
    table.expect(to.full_pressure >= 10 * bar && to.full_pressure <= 400 * bar, diameter_key,
                 "a cylinder in which force, ratio and gain make 10 to 400 bar (here " +
                     number_text(to.full_pressure / bar) + ")");
}

void read_fluid(const TableReader& table, BrakeSystemDescription& to) {
    constexpr std::string_view circuits[] = {"front_rear", "diagonal"};
    constexpr Range flow{"number above 0, 50 at most", 0, 50, false};  // [cm^3/s]
    constexpr Range pressure{"number from 50 to 400", 50, 400};        // [bar]
    read_pedal(table, to);
    to.circuits = static_cast<BrakeCircuits>(table.one_of("circuits", circuits, 0));
    const auto modulator = table.optional_table("modulator");
    to.modulated = modulator.has_value();
    if (!modulator) return;
    to.pump_flow = modulator->number("pump_flow_cm3_per_s", flow);
    to.pump_pressure = modulator->number("pump_pressure_bar", pressure);
}

void read_air(const TableReader& table, BrakeSystemDescription& to) {
    constexpr Range pressure{"number from 1 to 20", 1, 20};  // reservoirs of trucks have 8 to 12 [bar]
    to.full_pressure = to.knee_pressure = table.number("full_pressure_bar", pressure);
    const auto modulator = table.optional_table("modulator");
    to.modulated = modulator.has_value();
    if (!modulator) return;
    refuse(*modulator, {"pump_flow_cm3_per_s", "pump_pressure_bar"},
           "an empty table: with air the reservoir is the pump");
    modulator->finish();
}

// A drum's own friction pulls its shoes on.
void read_kind(const TableReader& brake, BrakeDescription& to) {
    constexpr std::string_view kinds[] = {"disc", "drum"};
    constexpr Range share{"number from 0 to 0.8", 0, 0.8};
    brake.choose("type", kinds, 0, [&](std::size_t kind) {
        to.self_energizing = kind == 1 ? brake.number("self_energizing", share) : 0;
    });
}

void read_friction(const TableReader& heat, BrakeDescription& to) {
    constexpr Range relative{"number from 0.05 to 2", 0.05, 2};
    constexpr std::size_t max_points = 12;
    constexpr double max_share = 0.9;  // of the friction at which the drum would lock by itself
    const Samples curve = heat.samples("temperature_degC", "friction", relative);
    heat.expect(curve.argument.size() >= 2 && curve.argument.size() <= max_points, "temperature_degC",
                "2 to " + std::to_string(max_points) + " numbers");
    const double max = max_share / std::max(to.self_energizing, max_share / relative.max);
    heat.expect(
        std::ranges::max(curve.value) <= max, "friction",
        "numbers of " + number_text(max) + " at most: with more, a drum of this 'self_energizing' locks by itself");
    to.temperature = curve.argument, to.friction = curve.value;
}

void read_heat(const TableReader& heat, BrakeDescription& to) {
    // Together they keep the temperature slow enough for explicit steps at any speed of a vehicle.
    constexpr Range capacity{"number not below 100", 100};
    constexpr Range cooling{"number from 0 to 1000", 0, 1000}, cooling_by_speed{"number from 0 to 100", 0, 100};
    constexpr Range loss{"number from 0 to 0.02", 0, 0.02};  // of all the friction at 50 m/s
    to.heat.capacity = heat.number("capacity_J_per_K", capacity);
    to.heat.cooling = heat.number("cooling_W_per_K", cooling, 0);
    to.heat.cooling_per_speed = heat.number("cooling_W_s_per_K_m", cooling_by_speed, 0);
    heat.choose({{}, {"temperature_degC", "friction"}}, [&](std::size_t group) {
        if (group == 1) read_friction(heat, to);
    });
    heat.choose({{}, {"friction_loss_s_per_m", "friction_radius_m"}}, [&](std::size_t group) {
        if (group == 0) return;
        to.friction_loss_per_speed = heat.number("friction_loss_s_per_m", loss);
        to.friction_radius = heat.number("friction_radius_m", positive);
    });
}

void read_fluid_line(const TableReader& brake, BrakeDescription& to) {
    constexpr Range volume{"number from 0.2 to 1000", 0.2, 1000};          // [cm^3]
    constexpr Range flow{"number above 0, 10000 at most", 0, 1e4, false};  // [cm^3/s]
    to.volume = brake.number_or_else("volume_cm3", volume, to.volume);
    to.line_flow = brake.number_or_else("line_flow_cm3_per_s", flow, default_line_flow(to.volume));
}

void read_line(const TableReader& brake, const BrakeSystemDescription& system, BrakeDescription& to) {
    const bool is_air = system.medium == BrakeMedium::air;
    to.volume = is_air ? 0 : default_volume(to.max_torque, system.full_pressure);
    to.line_flow = default_line_flow(to.volume);
    to.fill_time = to.release_time = is_air ? default_chamber_time : 0;
    brake.choose({{"volume_cm3", "line_flow_cm3_per_s"}, {"fill_time_s", "release_time_s"}}, [&](std::size_t group) {
        if (brake.is_recording() || (group == 1) == is_air) {
            if (group == 0) return read_fluid_line(brake, to);
            to.fill_time = brake.number("fill_time_s", lag, default_chamber_time);
            to.release_time = brake.number("release_time_s", lag, default_chamber_time);
        } else if (is_air) {
            refuse(brake, {"volume_cm3", "line_flow_cm3_per_s"}, "'fill_time_s' in its place: this is a key of fluid");
        } else {
            refuse(brake, {"fill_time_s", "release_time_s"}, "'volume_cm3' in its place: this is a key of air");
        }
    });
}

}  // namespace

BrakeSystemDescription read_brake_system(const TableReader& file) {
    constexpr std::string_view media[] = {"fluid", "air"};
    constexpr Range circuit{.words = "whole number from 0 to 2", .min = 0, .max = 2, .is_whole = true};
    BrakeSystemDescription out;
    const auto table = file.optional_table("brakes");
    if (!table) return out;
    out.exists = true;
    out.pedal_force = table->number("pedal_force_N", positive);
    table->choose("medium", media, 0, [&](std::size_t medium) {
        out.medium = static_cast<BrakeMedium>(medium);
        (out.medium == BrakeMedium::air ? read_air : read_fluid)(*table, out);
    });
    out.response_time = table->number("response_time_s", lag, default_response_time);
    out.trailer_response_time = table->number_or_else("trailer_response_time_s", lag, out.response_time);
    out.failed_circuit = static_cast<int>(table->number("failed_circuit", circuit, 0));
    if (!file.is_recording() && !file.has("trailer")) {
        refuse(*table, {"trailer_response_time_s"}, "a [[trailer]] in this file, whose control line it is about");
    }
    return out;
}

void read_brake_in_system(const TableReader& brake, const BrakeSystemDescription& system, BrakeDescription& to) {
    if (!system.exists && !brake.is_recording()) {
        return refuse(
            brake,
            {"volume_cm3", "line_flow_cm3_per_s", "fill_time_s", "release_time_s", "type", "self_energizing", "heat"},
            "a [brakes] in this file, without which torques follow the pedal at once");
    }
    read_line(brake, system, to);
    read_kind(brake, to);
    if (const auto heat = brake.optional_table("heat")) read_heat(*heat, to);
}

}  // namespace hamilcar::io
