// One function per table of the file, in the order of docs/files/scenario.md.
#include "hamilcar/io/scenario_file.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/base/text.hpp"
#include "hamilcar/control/kinds.hpp"
#include "hamilcar/integrator/stabilization.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/driver_file.hpp"
#include "hamilcar/io/every_mistake.hpp"
#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/road_file.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

namespace {

SolverDescription read_solver(const TableReader& table) {
    std::array<std::string_view, methods.size()> names;
    std::ranges::transform(methods, names.begin(), &Method::name);
    SolverDescription solver;
    const auto default_method = static_cast<std::size_t>(std::ranges::find(names, solver.integrator) - names.begin());
    solver.step = table.number("step_s", time_step, solver.step);
    solver.integrator = names[table.one_of("integrator", names, default_method)];
    solver.tolerance = table.number("tolerance", positive, solver.tolerance);
    solver.constraints = word<ConstraintMode>(
        table, "constraints", {{"exact", ConstraintMode::exact}, {"stabilized", ConstraintMode::stabilized}});
    solver.chart = word<ChassisChart>(table, "chart",
                                      {{"quaternion", ChassisChart::quaternion}, {"bryant", ChassisChart::bryant}});
    solver.energy_balance = table.boolean("energy_balance", solver.energy_balance);
    table.choose({{"stabilization"}, {"stabilization_gain_per_s"}}, [&](std::size_t group) {
        if (group == 0) {
            solver.stabilization = word<StabilizationRule>(
                table, "stabilization", {{"paper", StabilizationRule::paper}, {"limit", StabilizationRule::limit}});
        } else {
            solver.stabilization = StabilizationRule::value;
            solver.stabilization_gain = table.number("stabilization_gain_per_s", not_negative);
        }
    });
    const GainChoice choice = stabilization_gain(solver);
    const bool by_rule = solver.stabilization != StabilizationRule::value;
    const std::string_view key = !by_rule                     ? "stabilization_gain_per_s"
                                 : table.has("stabilization") ? "stabilization"
                                                              : "integrator";
    table.expect(choice.expectation.empty(), key, choice.expectation);
    return solver;
}

template <std::size_t N>
bool is_within(const std::array<double, N>& numbers, double max) {
    return std::ranges::all_of(numbers, [max](double number) { return std::abs(number) <= max; });
}

// A single number is a speed straight ahead.
std::array<double, 3> read_velocity(const TableReader& table) {
    constexpr std::string_view key = "velocity_m_per_s";
    std::array<double, 3> velocity{};
    table.choose_list(key, [&](bool is_list) {
        velocity = is_list ? table.array<3>(key) : std::array<double, 3>{table.number(key, any_number, 0), 0, 0};
    });
    return velocity;
}

InitialDescription read_initial(const TableReader& table) {
    constexpr Range height{"number from -1e5 to 1e5", -1e5, 1e5}, angle{"number from -36000 to 36000", -36000, 36000};
    constexpr double max_speed = 1000;    // [m/s], [rad/s]
    constexpr double max_distance = 1e7;  // from the origin: no run goes so far, and arithmetic does not suffer yet [m]
    const InitialDescription initial{.settle = table.boolean("settle", true),
                                     .position = table.array<2>("position_m", {0, 0}),
                                     .height = table.number("height_m", height, 0),
                                     .yaw = table.number("yaw_deg", angle, 0),
                                     .roll = table.number("roll_deg", angle, 0),
                                     .pitch = table.number("pitch_deg", angle, 0),
                                     .velocity = read_velocity(table),
                                     .angular_velocity = table.array<3>("angular_velocity_deg_per_s", {0, 0, 0})};
    table.expect(is_within(initial.position, max_distance), "position_m", "a place within 1e7 m of the origin");
    table.expect(is_within(initial.velocity, max_speed), "velocity_m_per_s", "a speed of 1000 m/s at most");
    table.expect(is_within(initial.angular_velocity, max_speed), "angular_velocity_deg_per_s", "57295 deg/s at most");
    for (const std::string_view key : {"height_m", "roll_deg", "pitch_deg"}) {
        table.expect(!initial.settle || !table.has(key), key, "'settle = false' beside it; settling finds this itself");
    }
    return initial;
}

SignalDescription read_optional_signal(const TableReader& inputs, std::string_view name, std::string_view key,
                                       const Range& range) {
    const auto table = inputs.optional_table(name);
    return table ? read_signal(*table, key, range) : SignalDescription{};
}

void read_inputs(const TableReader& inputs, ScenarioDescription& scenario) {
    scenario.drive = read_optional_signal(inputs, "drive", "torque_N_m", any_number);
    scenario.brake = read_optional_signal(inputs, "brake", "command", fraction);
    scenario.parking_brake = read_optional_signal(inputs, "parking_brake", "lever", fraction);
    scenario.throttle = read_optional_signal(inputs, "throttle", "pedal", fraction);
    scenario.clutch = read_optional_signal(inputs, "clutch", "pedal", fraction);
    scenario.gear = read_optional_signal(inputs, "gear", "number", any_number);
    scenario.gear.interpolation = Interpolation::steps;
    scenario.hands = read_optional_signal(inputs, "hands", "hold", fraction);
    scenario.steering_torque = read_optional_signal(inputs, "steering_torque", "torque_N_m", any_number);
    inputs.choose({{"steering_wheel"}, {"rack"}}, [&](std::size_t group) {
        if (group == 1) {
            scenario.steering_input = SteeringInput::rack;
            scenario.steering = read_signal(inputs.table("rack"), "displacement_m", any_number);
        } else if (const auto wheel = inputs.optional_table("steering_wheel")) {
            scenario.steering_input = SteeringInput::steering_wheel;
            scenario.steering = read_signal(*wheel, "angle_deg", any_number);
        }
    });
}

// Velocity of the air over the ground.
void read_wind(const TableReader& table, ScenarioDescription& scenario) {
    const double direction = table.number("toward_deg", any_number, 0);
    const SignalDescription speed = read_signal(table, "speed_m_per_s", any_number);
    scenario.wind_x = scenario.wind_y = speed;
    for (double& value : scenario.wind_x.value) value *= std::cos(direction);
    for (double& value : scenario.wind_y.value) value *= std::sin(direction);
}

ManeuverDescription read_maneuver(const TableReader& table) {
    ManeuverDescription maneuver{.name = table.text("name"), .settings = {}};
    if (const auto settings = table.optional_table("settings")) {
        maneuver.settings = settings->named_values();
    }
    return maneuver;
}

OutputDescription read_output(const TableReader& table) {
    constexpr Range interval{"number from 0 to 1e6", 0, 1e6};
    return {.interval = table.number("interval_s", interval, OutputDescription{}.interval),
            .channels = table.texts("channels"),
            .csv = table.boolean("csv", true),
            .netcdf = table.boolean("netcdf", true),
            .motion = table.boolean("motion", true),
            .report = table.boolean("report", true)};
}

constexpr double max_steps = 1e9;  // that can be counted, and waited for

// A key of two names at most, and the table that it stands in; null where one of them is not there.
struct Entry {
    Node *table, *node;
};
Entry entry_at(Node& document, std::string_view key) {
    const std::size_t dot = key.find('.');
    Node* table = dot == std::string_view::npos ? &document : document.find(key.substr(0, dot));
    return {table, table ? table->find(key.substr(dot + 1)) : nullptr};
}

// Who does the same in one file is one too many; a file's own choice overrides the one it inherits, but no maneuver.
void choose(Node& document, std::string_view key, std::string_view other_key) {
    const Entry one = entry_at(document, key), other = entry_at(document, other_key);
    if (!one.node || !other.node) return;
    const int own = one.node->file->generation, others = other.node->file->generation;
    if (own == others || (key == "maneuver" && others < own)) {
        fail_at(*other.node->file, other.node->begin,
                "key '" + std::string(other_key) + "' = " + other.node->written() + ": expected either this or '" +
                    std::string(key) + "', not both");
    }
    const Entry& lost = own < others ? other : one;
    const std::string name = lost.node->key;
    std::erase_if(std::get<TableValue>(lost.table->value).entries, [&](const Node& n) { return n.key == name; });
}

// Every control has one master.
void choose_masters(Node& document) {
    for (const char* other : {"driver", "inputs", "initial", "wind", "course", "output", "duration_s"}) {
        choose(document, "maneuver", other);
    }
    for (const char* other : {"inputs.steering_wheel", "inputs.rack"}) choose(document, "driver.path", other);
    for (const char* other : {"inputs.gear", "inputs.clutch"}) choose(document, "driver.gear", other);
    for (const char* other : {"inputs.drive", "inputs.throttle"}) choose(document, "driver.speed", other);
    Node* speed = entry_at(document, "driver.speed").node;
    Node* may_brake = speed ? speed->find("may_brake") : nullptr;
    const bool* brakes = may_brake ? std::get_if<bool>(&may_brake->value) : nullptr;
    if (!brakes || *brakes) choose(document, "driver.speed", "inputs.brake");
}

// Kinds of controllers that the run does without, whether the vehicle has them or not.
std::vector<std::string> read_controllers_off(const TableReader& file) {
    constexpr std::string_view key = "controllers_off";
    const std::vector<std::string> off = file.texts(key);
    file.note(key, "kinds of controllers that the run does without, or 'all'");
    std::vector<std::string_view> words;
    for (const ControllerKind* kind : controller_kinds()) words.push_back(kind->keyword);
    words.emplace_back("all");
    for (const std::string& word : off) {
        const std::string hint = did_you_mean(word, words);
        file.expect(
            std::ranges::find(words, word) != words.end(), key,
            "a list of " + quoted_list(words) + ", which '" + word + "' is not" + (hint.empty() ? "" : "; " + hint));
    }
    return off;
}

std::vector<std::array<double, 2>> read_cones(const TableReader& course) {
    std::vector<std::array<double, 2>> cones;
    for (const TableReader& cone : course.tables("cone")) cones.push_back(cone.array<2>("position_m"));
    return cones;
}

}  // namespace

bool is_scenario(const Node& document) {
    return document.find("vehicle") != nullptr;
}

ScenarioDescription read_scenario(const std::string& path) {
    ScenarioDescription scenario;
    expect_kind(path, FileKind::scenario, [&] {
        Node document = read_toml(path);
        scenario = read_scenario(document);
    });
    return scenario;
}

ScenarioDescription read_scenario(Node& document) {
    choose_masters(document);
    ScenarioDescription scenario;
    with_every_mistake(
        document, [](const TableReader& file) { read_scenario(file); },
        [&] { scenario = read_scenario(TableReader(document, "")); });
    scenario.places = places_of(document);
    return scenario;
}

ScenarioDescription read_scenario(const TableReader& file) {
    ScenarioDescription scenario;
    scenario.name = file.text("name");
    scenario.vehicle = file.path_to_file("vehicle");
    file.choose_presence("maneuver", [&](bool present) {
        scenario.duration = present ? file.number("duration_s", positive, 1) : file.number("duration_s", positive);
    });
    scenario.steering_mechanics = file.boolean("steering_mechanics", false);
    scenario.controllers_off = read_controllers_off(file);
    if (const auto table = file.optional_table("solver")) scenario.solver = read_solver(*table);
    if (const auto table = file.optional_table("initial")) scenario.initial = read_initial(*table);
    if (const auto table = file.optional_table("road")) scenario.road = read_road(*table);
    if (const auto table = file.optional_table("course")) scenario.cones = read_cones(*table);
    if (const auto table = file.optional_table("inputs")) read_inputs(*table, scenario);
    if (const auto table = file.optional_table("wind")) read_wind(*table, scenario);
    if (const auto table = file.optional_table("driver")) scenario.driver = read_driver(*table);
    if (const auto table = file.optional_table("maneuver")) scenario.maneuver = read_maneuver(*table);
    if (const auto table = file.optional_table("output")) scenario.output = read_output(*table);
    file.expect(scenario.solver.step <= scenario.duration, "duration_s",
                "at least one step of " + number_text(scenario.solver.step));
    if (!file.is_recording() && file.has("duration_s")) {  // a maneuver's own is known to be right
        file.expect(scenario.duration < max_steps * scenario.solver.step, "duration_s",
                    "fewer than 1e9 steps of " + number_text(scenario.solver.step));
    }
    file.finish();
    return scenario;
}

}  // namespace hamilcar::io
