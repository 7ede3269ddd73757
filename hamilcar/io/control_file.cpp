// Controllers and the sensors that they see the car through. A kind of controller says which keys it has (control/kinds.hpp), so that one
// that a program adds is read, checked and described in the schema like those that come with Hamilcar.
#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/base/key_unit.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/control/kinds.hpp"

namespace hamilcar::io {

namespace {

// Faster than any control unit, and far from a number that a counter of steps could not hold.
constexpr Range rate{"number from 1 to 10000", 1, 10000};  // [Hz]

std::string range_words(const ControllerKey& key) {
    if (std::isinf(key.max)) return std::isinf(key.min) ? "number" : "number not below " + number_text(key.min);
    return "number from " + number_text(key.min) + " to " + number_text(key.max);
}

void read_settings(const TableReader& table, const ControllerKind& kind, ControllerDescription& to) {
    for (const ControllerKey& key : kind.keys) {
        const std::string words = range_words(key);
        const double value =
            table.number(key.key, Range{words, key.min, key.max}, key.fallback * unit_of_key(key.key).to_si);
        table.note(key.key, key.meaning, kind.keyword);
        if (!table.is_recording() && table.has(key.key)) to.settings.emplace_back(key.key, value);
    }
}

ControllerDescription read_controller(const TableReader& table, const VehicleDescription& vehicle) {
    const std::vector<const ControllerKind*> kinds = controller_kinds();
    std::vector<std::string_view> words;
    for (const ControllerKind* kind : kinds) words.push_back(kind->keyword);
    ControllerDescription out;
    table.choose("kind", words, {}, [&](std::size_t number) {
        const ControllerKind& kind = *kinds[number];
        out.kind = kind.keyword;
        read_settings(table, kind, out);
        if (table.is_recording()) return;
        const std::string lacks = kind.lacks(vehicle);
        table.expect(lacks.empty(), "kind", lacks);
    });
    out.rate = table.number("rate_hz", rate, out.rate);
    return out;
}

void read_all_controllers(const TableReader& file, VehicleDescription& vehicle) {
    if (!file.has("controller")) return;
    std::vector<ControllerDescription> read;
    for (const TableReader& table : file.tables("controller")) {
        read.push_back(read_controller(table, vehicle));
        read.back().number = read.size() - 1;
        table.expect(std::ranges::count(read, read.back().kind, &ControllerDescription::kind) == 1, "kind",
                     "a kind that no other controller has");
    }
    if (!file.is_recording()) vehicle.controllers = read;
}

// `unit`: of its resolution and its noise, as keys end.
SensorDescription read_sensor(const TableReader& sensors, std::string_view name, const std::string& unit) {
    constexpr Range delay{"number from 0 to 0.1", 0, 0.1};
    const auto table = sensors.optional_table(name);
    SensorDescription out;
    if (!table) return out;
    if (table->has("rate_hz")) out.interval = 1 / table->number("rate_hz", rate);
    out.delay = table->number("delay_s", delay, 0);
    out.resolution = table->number("resolution_" + unit, not_negative, 0);
    out.noise = table->number("noise_" + unit, not_negative, 0);
    return out;
}

}  // namespace

void read_controllers(const TableReader& file, VehicleDescription& vehicle) {
    static_cast<void>(file.has("controller"));
    file.choose_flag("controllers", true, file, [&](bool wanted) {
        if (wanted) read_all_controllers(file, vehicle);
    });
}

SensorsDescription read_sensors(const std::optional<TableReader>& table) {
    constexpr Range whole{.words = "whole number from 0 to 1e15", .min = 0, .max = 1e15, .is_whole = true};
    SensorsDescription out;
    if (!table) return out;
    out.seed = static_cast<std::uint64_t>(table->number("seed", whole, 1));
    out.wheel_speed = read_sensor(*table, "wheel_speed", "rpm");
    out.angular_rate = read_sensor(*table, "angular_rate", "deg_per_s");
    out.acceleration = read_sensor(*table, "acceleration", "m_per_s2");
    out.pressure = read_sensor(*table, "pressure", "bar");
    out.steering_wheel = read_sensor(*table, "steering_wheel", "deg");
    out.travel = read_sensor(*table, "travel", "m");
    return out;
}

}  // namespace hamilcar::io
