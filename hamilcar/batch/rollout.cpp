#include "hamilcar/batch/rollout.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "hamilcar/batch/lane_rollout.hpp"
#include "hamilcar/batch/topology.hpp"
#include "hamilcar/engine/flush_denormals.hpp"

namespace hamilcar {

namespace {

std::vector<const Model<double>*> models(const Simulation& first, const std::vector<const Simulation*>& variants) {
    std::vector<const Model<double>*> out{&first.model()};
    for (const Simulation* variant : variants) {
        const std::string difference = program_difference(first, *variant);
        if (!difference.empty()) throw std::invalid_argument("a variant differs in " + difference);
        out.push_back(&variant->model());
    }
    return out;
}

const Engine& chosen_engine(const RolloutOptions& options) {
    return options.engine.empty() ? default_engine() : engine(options.engine);
}

}  // namespace

Rollout::Rollout(const RolloutCar& car, const TracedReaders& readers, const RolloutOptions& options)
    : first_(car),
      steps_(options.steps),
      programs_(models(*car.simulation, options.variants), readers, chosen_engine(options)),
      pool_(options.threads) {
    const std::string problem = obstacle(car);
    if (!problem.empty()) throw std::invalid_argument(problem);
}

std::string Rollout::obstacle(const RolloutCar& of) const {
    const Simulation& car = *of.simulation;
    const Simulation& first = *first_.simulation;
    const std::string& integrator = car.scenario().solver.integrator;
    if (find_method(integrator)->family != MethodFamily::runge_kutta) {
        return fmt::format("{} remembers or chooses: expected rk4, whose step is a map of the state", integrator);
    }
    if (car.driver()) return "a driver's decisions have no derivatives: expected a scenario without one";
    if (car.control()) return "controllers' decisions have no derivatives: expected controllers_off = [\"all\"]";
    if (&car == &first) return "";
    if (!of.controls->has_same_list(*first_.controls)) return "they differ in their controls";
    const std::string difference = program_difference(first, car, programs_.parameters());
    return difference.empty() ? difference : "they differ in " + difference;
}

namespace {

RolloutResults new_results(std::size_t runs, std::size_t rows, const RolloutPrograms& programs) {
    return {std::vector<double>(runs * rows * programs.channel_count()),
            std::vector<double>(runs * programs.state_size())};
}

// Calls f(first run) for each group of lanes.
template <class F>
void for_each_group(std::size_t runs, int lanes, WorkerPool& pool, const F& f) {
    const auto width = static_cast<std::size_t>(lanes);
    pool.run(static_cast<int>((runs + width - 1) / width), [&](int group) {
        const FlushDenormals flush;
        f(static_cast<std::size_t>(group) * width);
    });
}

}  // namespace

RolloutResults Rollout::run(std::span<const RolloutCar> cars, const RolloutNumbers& runs, std::size_t rows) {
    RolloutResults out = new_results(cars.size(), rows, programs_);
    for_each_group(cars.size(), programs_.lanes(), pool_, [&](std::size_t first) {
        LaneRollout(programs_, {cars, &runs, rows, first, steps_, stop_}).run(out, nullptr);
    });
    return out;
}

RolloutResults Rollout::tangents(std::span<const RolloutCar> cars, const RolloutNumbers& runs,
                                 const RolloutNumbers& along, std::size_t rows, RolloutResults& changes) {
    programs_.with_tangents();
    RolloutResults out = new_results(cars.size(), rows, programs_);
    changes = out;
    for_each_group(cars.size(), programs_.lanes(), pool_, [&](std::size_t first) {
        LaneRollout(programs_, {cars, &runs, rows, first, steps_, stop_}, &along).run(out, &changes);
    });
    return out;
}

RolloutNumbers Rollout::gradient(std::span<const RolloutCar> cars, const RolloutNumbers& runs,
                                 const RolloutResults& weights, std::size_t rows) {
    programs_.adjoint();
    RolloutNumbers out{.controls = std::vector<double>(runs.controls.size()),
                       .states = std::vector<double>(runs.states.size()),
                       .parameters = std::vector<double>(cars.size() * parameter_count())};
    for_each_group(cars.size(), programs_.lanes(), pool_, [&](std::size_t first) {
        LaneRollout(programs_, {cars, &runs, rows, first, steps_, stop_}).gradient(weights, out);
    });
    return out;
}

std::vector<double> Rollout::closed(std::span<const RolloutCar> cars, const RolloutNumbers& runs,
                                    const RolloutNumbers& along) {
    programs_.with_tangents();
    std::vector<double> out = along.states;
    constexpr std::size_t rows = 1;
    for_each_group(cars.size(), programs_.lanes(), pool_, [&](std::size_t first) {
        LaneRollout(programs_, {cars, &runs, rows, first, steps_, stop_}, &along).close(out);
    });
    return out;
}

}  // namespace hamilcar
