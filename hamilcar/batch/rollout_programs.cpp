#include "hamilcar/batch/rollout_programs.hpp"

#include "hamilcar/program/pass.hpp"

namespace hamilcar {

RolloutPrograms::RolloutPrograms(std::span<const Model<double>* const> cars, const TracedReaders& readers,
                                 const Engine& engine)
    : engine_(&engine), channel_count_(readers.size()) {
    Model<double> example;
    const CommonCar common = common_car(cars, example);
    rhs_ = trace_rhs(example, common, Precision::double_precision);
    sample_ = trace_sample(example, common, Precision::double_precision, readers);
    state_size_ = static_cast<std::size_t>(example.vehicle.state_size);
    chart_ = example.chart;
    const auto in_lanes = [](const RhsTrace& trace) {
        return program::in_single_numbers(program::without_dead_code(trace.graph));
    };
    plain_.rhs = made(in_lanes(rhs_));
    if (plain_.rhs->lanes() != engine.lanes(Precision::double_precision)) engine_ = &program::backends().back();
    plain_.sample = made(in_lanes(sample_));
}

std::vector<double> RolloutPrograms::parameters_of(const Model<double>& car) const {
    const std::vector<double> numbers = numbers_of(car).numbers;
    std::vector<double> out;
    for (const int i : rhs_.parameters) out.push_back(numbers[static_cast<std::size_t>(i)]);
    return out;
}

std::unique_ptr<const program::Executable> RolloutPrograms::made(const program::Graph& graph) const {
    auto out = compiled(graph, *engine_, true);
    if (plain_.rhs) expect_lanes(*out, lanes());
    return out;
}

const RolloutPrograms::Pair& RolloutPrograms::with_tangents() {
    if (!with_tangents_.rhs) {
        const auto passed = [this](const program::Graph& graph, std::size_t results) {
            program::DerivativeOptions options{.call_offset = RhsCall::tangents};
            options.places[rhs_state] = {rhs_state, static_cast<int>(state_size_)};
            options.places[rhs_input] = {rhs_input, RhsInput::size};
            options.places[rhs_parameters] = {rhs_parameters, static_cast<int>(rhs_.parameters.size())};
            options.places[rhs_rate] = {rhs_rate, static_cast<int>(results)};
            options.places[rhs_report] = {rhs_report, static_cast<int>(report_size())};
            return made(program::with_tangents(graph, options));
        };
        with_tangents_ = {passed(rhs_.graph, state_size_), passed(sample_.graph, channel_count_)};
    }
    return with_tangents_;
}

const RolloutPrograms::Pair& RolloutPrograms::adjoint() {
    if (!adjoint_.rhs) {
        const auto passed = [this](const program::Graph& graph) {
            program::DerivativeOptions options{.call_offset = RhsCall::adjoints};
            options.places[rhs_state] = {rollout_state_adjoint, 0};
            options.places[rhs_input] = {rollout_input_adjoint, 0};
            options.places[rhs_parameters] = {rollout_parameter_adjoint, 0};
            options.places[rhs_rate] = {rhs_rate, 0};
            options.places[rhs_report] = {rhs_report, 0};
            return made(program::adjoint(graph, options));
        };
        adjoint_ = {passed(rhs_.graph), passed(sample_.graph)};
    }
    return adjoint_;
}

}  // namespace hamilcar
