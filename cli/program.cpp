// `hamilcar program VEHICLE`: what a step of a vehicle comes to once it is recorded and compiled, and the step as C.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/bench/operations.hpp"
#include "hamilcar/engine/casadi_text.hpp"
#include "hamilcar/engine/rhs_program.hpp"
#include "hamilcar/program/c_text.hpp"
#include "hamilcar/program/pass.hpp"

namespace hamilcar::cli {

namespace {

using program::Block;

struct ProgramOptions {
    VehicleChoice vehicle;
    std::string c_file, casadi_file;
    bool json = false;
};

struct BlockCount {
    const char* name;
    Block block;
    OperationCount operations;
};

struct EngineReport {
    std::string_view engine;
    const char* cars;
    program::CompileReport compiled;
};

std::vector<BlockCount> count_blocks(const program::Graph& graph) {
    std::vector<BlockCount> out{
        {"velocity", Block::velocity, {}}, {"momenta", Block::momenta, {}}, {"integration", Block::integration, {}}};
    for (BlockCount& one : out) one.operations = operations_of(graph, one.block);
    return out;
}

std::vector<EngineReport> compile_everywhere(const program::Graph& graph) {
    const program::Graph single = program::in_single_numbers(graph);
    std::vector<EngineReport> out;
    for (const Engine* engine : engines()) {
        out.push_back({engine->name, "one car", engine->compile(graph, false)->report()});
        out.push_back({engine->name, "a car in each lane", engine->compile(single, true)->report()});
    }
    return out;
}

nlohmann::json json_of(const OperationCount& count) {
    return {{"additions", count.additions},
            {"multiplications", count.multiplications},
            {"divisions", count.divisions},
            {"roots", count.roots},
            {"choices", count.choices}};
}

void print_json(const std::string& vehicle, double seconds, const std::vector<BlockCount>& blocks,
                const std::vector<EngineReport>& compiled) {
    nlohmann::json of_blocks, of_engines;
    for (const BlockCount& one : blocks) of_blocks[one.name] = json_of(one.operations);
    for (const EngineReport& one : compiled) {
        of_engines.push_back({{"engine", one.engine},
                              {"cars", one.cars},
                              {"instructions", one.compiled.instructions},
                              {"code_bytes", one.compiled.code_bytes},
                              {"constant_bytes", one.compiled.constant_bytes},
                              {"spills", one.compiled.spills},
                              {"reloads", one.compiled.reloads},
                              {"scratch_bytes", one.compiled.scratch_bytes},
                              {"compile_s", one.compiled.seconds}});
    }
    const nlohmann::json facts{
        {"vehicle", vehicle}, {"record_s", seconds}, {"operations", of_blocks}, {"engines", of_engines}};
    fmt::print("{}\n", facts.dump(2));
}

void print_text(const std::string& vehicle, double seconds, const std::vector<BlockCount>& blocks,
                const std::vector<EngineReport>& compiled) {
    fmt::print("{}: right-hand side, recorded in {:.1f} ms\n\n", vehicle, 1e3 * seconds);
    fmt::print("  {:<14}{:>10}{:>17}{:>11}{:>7}{:>9}\n", "block", "additions", "multiplications", "divisions", "roots",
               "choices");
    OperationCount sum;
    const auto row = [](const char* name, const OperationCount& n) {
        fmt::print("  {:<14}{:>10}{:>17}{:>11}{:>7}{:>9}\n", name, n.additions, n.multiplications, n.divisions, n.roots,
                   n.choices);
    };
    for (const BlockCount& one : blocks) row(one.name, one.operations), sum += one.operations;
    row("together", sum);
    fmt::print("\n  {:<10}{:<20}{:>13}{:>10}{:>13}{:>8}{:>9}{:>13}\n", "engine", "", "instructions", "code",
               "constants", "spills", "reloads", "compiled in");
    for (const EngineReport& one : compiled) {
        const program::CompileReport& c = one.compiled;
        fmt::print("  {:<10}{:<20}{:>13}{:>7.0f} kB{:>10.1f} kB{:>8}{:>9}{:>10.1f} ms\n", one.engine, one.cars,
                   c.instructions, 1e-3 * static_cast<double>(c.code_bytes),
                   1e-3 * static_cast<double>(c.constant_bytes), c.spills, c.reloads, 1e3 * c.seconds);
    }
}

// What stands where in the arrays of the C function.
std::string explanation(const VehicleDescription& vehicle, const RhsTrace& trace, const Model<double>& model) {
    std::string places;
    for (const int place : trace.correction_indices) places += fmt::format(" {}", place);
    return fmt::format(
        "/* The right-hand side (rates of the state) of \"{}\", by hamilcar {}. SI units; ISO 8855 axes.\n"
        "   arrays[0], read: the state, {} numbers as in hamilcar/vehicle/state.hpp\n"
        "   arrays[1], read: rack displacement [m], rate [m/s], acceleration [m/s^2], drive torque [N m], brake [0 to "
        "1],\n"
        "     throttle [0 to 1], clutch pedal [0 to 1], gear, wind x and y [m/s],\n"
        "     hold of the hands [0 to 1] and their torque [N m], of a rack that moves on its own; parking brake [0 to "
        "1]\n"
        "   arrays[3], written: the rate of each number of the state [1/s]\n"
        "   arrays[4], written: largest violation of a cut joint [m], smallest mobility of a linkage [1], then what to "
        "add\n"
        "     after a step to these numbers of the state:{}\n"
        "   A step is any explicit method on these rates; afterwards a quaternion (numbers 3 to 6) is to be "
        "normalized. */\n",
        vehicle.name, HAMILCAR_VERSION, model.vehicle.state_size, places);
}

io::ExitCode program(const ProgramOptions& options) {
    for (const std::string& file : {options.c_file, options.casadi_file}) {
        if (!file.empty()) check_output(file);
    }
    VehicleDescription vehicle = read_vehicle(options.vehicle);
    vehicle.controllers.clear();  // without decisions all actuators are at rest
    const Model<double> model{
        .vehicle = Vehicle<double>(vehicle), .road = PlaneRoad<double>(0, 0, 1), .energy_balance = false};
    const auto start = std::chrono::steady_clock::now();
    const RhsTrace trace = rhs_trace_without_dead_code(model);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto print = options.json ? print_json : print_text;
    print(vehicle.name, seconds, count_blocks(trace.graph), compile_everywhere(trace.graph));
    if (!options.c_file.empty()) {
        write_file(options.c_file, explanation(vehicle, trace, model) + program::c_text(trace.graph, "hamilcar_turn"));
    }
    if (!options.casadi_file.empty()) {
        write_file(options.casadi_file,
                   explanation(vehicle, trace, model) + casadi_text(trace, model.vehicle.state_size));
    }
    return io::ExitCode::ok;
}

}  // namespace

void add_program(CommandList& list) {
    auto [command, o] =
        list.add<ProgramOptions>("program", "what a vehicle's step comes to once it is recorded and compiled", program);
    command.add("vehicle", o.vehicle.file, "vehicle file (TOML)").required();
    add_vehicle_set(command, o.vehicle);
    command.add("--c", o.c_file, "file for the step as one C function");
    command.add("--casadi", o.casadi_file, "file for the right-hand side and its Jacobian as C for casadi.external");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
