#include "hamilcar/batch/batch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "hamilcar/engine/library.hpp"

namespace hamilcar {

namespace {

std::vector<const Simulation*> pointers(const std::vector<Simulation>& cars) {
    std::vector<const Simulation*> out;
    for (const Simulation& car : cars) out.push_back(&car);
    return out;
}

std::string vehicle_difference(const Vehicle<double>& a, const Vehicle<double>& b) {
    if (a.spoke_count() != b.spoke_count()) return "number of corners";
    for (std::size_t i = 0; i < a.spokes.size(); ++i) {
        if (a.spokes[i].suspension.index() != b.spokes[i].suspension.index())
            return fmt::format("suspension of corner {}", i + 1);
        if (a.spokes[i].tire.index() != b.spokes[i].tire.index()) return fmt::format("tire model of corner {}", i + 1);
    }
    if (a.hull.points.size() != b.hull.points.size()) return "number of hull points";
    if (a.anti_roll_bars.size() != b.anti_roll_bars.size()) return "number of anti-roll bars";
    for (std::size_t i = 0; i < a.anti_roll_bars.size(); ++i) {
        if (a.anti_roll_bars[i].left != b.anti_roll_bars[i].left ||
            a.anti_roll_bars[i].right != b.anti_roll_bars[i].right)
            return fmt::format("corners of anti-roll bar {}", i + 1);
    }
    return {};
}

}  // namespace

std::string topology_difference(const Simulation& a, const Simulation& b) {
    const SolverDescription &x = a.scenario().solver, &y = b.scenario().solver;
    if (x.integrator != y.integrator) return "integrator";
    if (x.step != y.step) return "step";
    if (a.model().chart != b.model().chart) return "chart";
    if (a.model().constraints != b.model().constraints) return "constraint mode";
    if (a.model().energy_balance != b.model().energy_balance) return "energy balance";
    return vehicle_difference(a.model().vehicle, b.model().vehicle);
}

Batch::Batch(const std::vector<Simulation>& cars, const BatchOptions& options) : Batch(pointers(cars), options) {}

Batch::Batch(std::vector<const Simulation*> cars, const BatchOptions& options)
    : cars_(std::move(cars)),
      engine_(options.instruction_set.empty() ? &best_engine() : &engine(options.instruction_set)),
      lanes_(engine_->lanes(options.precision)),
      pool_(options.threads) {
    if (cars_.empty()) throw std::invalid_argument("a batch needs at least one car");
    const SolverDescription& solver = cars_[0]->scenario().solver;
    const Method* method = find_method(solver.integrator);
    if (method->family == MethodFamily::embedded_runge_kutta) {
        throw std::invalid_argument(
            fmt::format("{} chooses steps of its own; a batch expects a method with fixed steps", method->name));
    }
    std::vector<LaneCar> lane_cars;
    for (std::size_t i = 0; i < cars_.size(); ++i) {
        const std::string difference = topology_difference(*cars_[0], *cars_[i]);
        if (!difference.empty()) {
            throw std::invalid_argument(
                fmt::format("car {} cannot share a pack with the first one: they differ in {}", i + 1, difference));
        }
        if (cars_[i]->steps_taken() != 0)
            throw std::invalid_argument(fmt::format("car {} is already under way", i + 1));
        lane_cars.push_back({&cars_[i]->model(), &cars_[i]->state(), &cars_[i]->schedule()});
    }
    const ChunkSettings settings{.method = *method,
                                 .step = solver.step,
                                 .tilt_cosine = options.tilt_limit > 0 ? std::cos(options.tilt_limit) : -2.0};
    for (std::size_t first = 0; first < lane_cars.size(); first += static_cast<std::size_t>(lanes_)) {
        const std::size_t count = std::min(static_cast<std::size_t>(lanes_), lane_cars.size() - first);
        chunks_.emplace_back(
            engine_->make_chunk(options.precision, &lane_cars[first], static_cast<int>(count), settings));
    }
}

void Batch::advance(long steps) {
    pool_.run(static_cast<int>(chunks_.size()), [&](int i) { chunks_[static_cast<std::size_t>(i)]->advance(steps); });
}

}  // namespace hamilcar
