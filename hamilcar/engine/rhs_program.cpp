#include "hamilcar/engine/rhs_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <list>
#include <mutex>
#include <stdexcept>

#include "hamilcar/base/event_log.hpp"
#include "hamilcar/program/pass.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

namespace {

// Everything that a program depends on.
struct Key {
    const Engine* engine;
    Precision precision;
    bool car_in_each_lane;
    std::vector<int> shape;
    std::vector<std::uint64_t> numbers;  // the bits of constants; 0 for a parameter
    std::vector<bool> differs;
    bool operator==(const Key&) const = default;
};

Key key_of(const ModelNumbers& model, const CommonCar& common, const Engine& engine, Precision precision,
           bool car_in_each_lane) {
    Key key{&engine, precision, car_in_each_lane, model.shape, {}, common.differs};
    for (std::size_t i = 0; i < model.numbers.size(); ++i) {
        const bool constant = common.differs.empty() || !common.differs[i];
        key.numbers.push_back(constant ? std::bit_cast<std::uint64_t>(model.numbers[i]) : 0);
    }
    return key;
}

// The most recently used programs, newest first. One takes some 100 kB; maneuvers and sweeps return to few vehicles.
class Cache {
public:
    template <class Make>
    std::shared_ptr<const RhsProgram> find_or_make(Key key, const Make& make) {
        if (auto found = find(key)) return found;
        std::shared_ptr<const RhsProgram> made = make();  // not locked, so that other threads can continue
        const std::lock_guard lock(mutex_);
        entries_.emplace_front(std::move(key), made);
        if (entries_.size() > max_entries) entries_.pop_back();
        return made;
    }

private:
    static constexpr std::size_t max_entries = 32;

    std::shared_ptr<const RhsProgram> find(const Key& key) {
        const std::lock_guard lock(mutex_);
        const auto found =
            std::ranges::find(entries_, key, [](const auto& entry) -> const Key& { return entry.first; });
        if (found == entries_.end()) return nullptr;
        entries_.splice(entries_.begin(), entries_, found);
        return found->second;
    }

    std::mutex mutex_;
    std::list<std::pair<Key, std::shared_ptr<const RhsProgram>>> entries_;
};

Cache& cache() {
    static Cache one;
    return one;
}

std::shared_ptr<const RhsProgram> make_program(const Model<double>& model, const CommonCar& common,
                                               const Engine& engine, Precision precision, bool car_in_each_lane) {
    const auto begin = std::chrono::steady_clock::now();
    RhsTrace trace = trace_rhs(model, common, precision);
    program::Graph graph = program::without_dead_code(trace.graph);
    if (car_in_each_lane) graph = program::in_single_numbers(graph);
    auto made = std::make_shared<RhsProgram>();
    made->executable = compiled(graph, engine, car_in_each_lane);
    made->correction_indices = std::move(trace.correction_indices);
    made->parameters = std::move(trace.parameters);
    made->state_size = model.vehicle.state_size;
    made->commands = model.vehicle.commands, made->measured = trace.measured;
    made->chart = model.chart;
    if (events_are_logged()) {
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
        log_event(fmt::format("compiled a right-hand side of {} operations for {}{} in {:.0f} ms", graph.nodes().size(),
                              engine.name, car_in_each_lane ? ", a car in each lane," : "", spent.count()));
    }
    return made;
}

}  // namespace

std::unique_ptr<const program::Executable> compiled(const program::Graph& graph, const Engine& engine,
                                                    bool car_in_each_lane) {
    try {
        return engine.compile(graph, car_in_each_lane);
    } catch (const std::runtime_error&) {
        return program::backends().back().compile(graph, car_in_each_lane);
    }
}

void expect_lanes(const program::Executable& executable, int lanes) {
    if (executable.lanes() == lanes) return;
    throw std::runtime_error("the system grants no more executable memory: expected some, or the engine portable");
}

RhsTrace rhs_trace_without_dead_code(const Model<double>& model) {
    RhsTrace trace = trace_rhs(model, {}, Precision::double_precision);
    trace.graph = program::without_dead_code(trace.graph);
    return trace;
}

std::shared_ptr<const RhsProgram> rhs_program(const Model<double>& model, const Engine& engine) {
    constexpr Precision precision = Precision::double_precision;
    return cache().find_or_make(key_of(numbers_of(model), {}, engine, precision, false),
                                [&] { return make_program(model, CommonCar{}, engine, precision, false); });
}

std::shared_ptr<const RhsProgram> rhs_program(std::span<const Model<double>* const> cars, const Engine& engine,
                                              Precision precision) {
    Model<double> example;
    const CommonCar common = common_car(cars, example);
    ModelNumbers all = numbers_of(*cars[0]);
    all.shape = common.shape;
    return cache().find_or_make(key_of(all, common, engine, precision, true),
                                [&] { return make_program(example, common, engine, precision, true); });
}

const program::CallFunction* rhs_functions(Precision precision) {
    static constexpr program::CallFunction in_doubles[] = {look_up_ground<double>, ground_tangents, ground_adjoints};
    static constexpr program::CallFunction in_singles[] = {look_up_ground<float>};  // derivatives are of doubles
    return precision == Precision::double_precision ? in_doubles : in_singles;
}

}  // namespace hamilcar
