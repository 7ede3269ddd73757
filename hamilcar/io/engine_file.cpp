// Combustion engines.
#include <algorithm>
#include <limits>

#include "hamilcar/base/text.hpp"
#include "hamilcar/driveline/source.hpp"
#include "hamilcar/io/default_values.hpp"
#include "hamilcar/io/vehicle_tables.hpp"

namespace hamilcar::io {

namespace {

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

}  // namespace

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

}  // namespace hamilcar::io
