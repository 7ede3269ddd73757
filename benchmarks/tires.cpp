// What a step of the BMW 323i costs on Magic Formula tires over the same step on the paper's tire, and on a rough road over
// the same tires on a plane: one car by every engine, and batches of both precisions, all in turn in one run.
#include <fmt/format.h>

#include <deque>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/bench/interleave.hpp"
#include "hamilcar/bench/scenes.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace {

using namespace hamilcar;

constexpr double turn = 0.03;  // [s]
constexpr int rounds = 41;

VehicleDescription car(const char* name) {
    return io::read_vehicle(fmt::format("{}/vehicles/{}.toml", HAMILCAR_SOURCE_DIR, name));
}

void print(std::string_view engine, const char* what, const InterleavedTimes& result) {
    fmt::print("  {:<10}{:<26}{:>8.0f} ns{:>8.0f} ns{:>7.2f}", engine, what, 1e9 * result.time(0), 1e9 * result.time(1),
               result.ratio(1, 0));
    fmt::print("{:>9.0f} ns{:>7.2f}\n", 1e9 * result.time(2), result.ratio(2, 1));
}

void one_car(const std::vector<Simulation>& simulations) {
    for (const Engine* engine : engines()) {
        for (const bool balance : {false, true}) {
            std::vector<EngineCar> cars;
            for (const Simulation& simulation : simulations) {
                cars.emplace_back(*engine, simulation, balance);
            }
            std::vector<BenchmarkCase> cases;
            for (EngineCar& one : cars) cases.push_back({"", [&one](long steps) { one.advance(steps); }});
            print(engine->name, balance ? "one car, with balance" : "one car", interleave(cases, turn, rounds));
        }
    }
}

void batches(const std::vector<Simulation>& simulations) {
    for (const Engine* engine : engines()) {
        for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
            const auto lanes = static_cast<std::size_t>(engine->lanes(precision));
            std::deque<Batch> all;  // batches do not move
            for (const Simulation& simulation : simulations) {
                all.emplace_back(
                    std::vector<const Simulation*>(2 * lanes, &simulation),
                    BatchOptions{.threads = 1, .precision = precision, .engine = std::string(engine->name)});
            }
            std::vector<BenchmarkCase> cases;
            for (Batch& batch : all) {
                cases.push_back({"", [&batch, lanes](long car_steps) {
                                     batch.advance(std::max<long>(1, car_steps / static_cast<long>(2 * lanes)));
                                 }});
            }
            print(engine->name, precision == Precision::double_precision ? "batch, double" : "batch, single",
                  interleave(cases, turn, rounds));
        }
    }
}

}  // namespace

int main() {
    ScenarioDescription on_plane = bend(), on_rough = bend();
    on_plane.solver.energy_balance = on_rough.solver.energy_balance = false;
    on_rough.road.random = {{.road_class = 'C', .start = -100}};
    const std::vector<Simulation> single{cornering(car("bmw_323i_paper"), on_plane),
                                         cornering(car("bmw_323i"), on_plane), cornering(car("bmw_323i"), on_rough)};
    fmt::print("a 1 ms step of the BMW 323i in a bend\n  {:<36}{:>11}{:>11}{:>7}{:>12}{:>7}\n", "", "paper's tire",
               "Magic F.", "ratio", "rough road", "ratio");
    one_car(single);
    std::vector<Simulation> fresh;  // a batch wants cars that have not been advanced
    fresh.emplace_back(car("bmw_323i_paper"), on_plane), fresh.emplace_back(car("bmw_323i"), on_plane);
    fresh.emplace_back(car("bmw_323i"), on_rough);
    batches(fresh);
}
