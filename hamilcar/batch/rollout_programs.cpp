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
}

const RolloutPrograms::Pair& RolloutPrograms::plain() {
    if (!plain_.rhs) {
        const auto made = [this](const program::Graph& graph) {
            return compiled(program::in_single_numbers(program::without_dead_code(graph)), *engine_, true);
        };
        plain_ = {made(rhs_.graph), made(sample_.graph)};
    }
    return plain_;
}

const RolloutPrograms::Pair& RolloutPrograms::with_tangents() {
    if (!with_tangents_.rhs) {
        const auto made = [this](const program::Graph& graph, std::size_t results) {
            program::DerivativeOptions options{.call_offset = RhsCall::tangents};
            options.places[rhs_state] = {rhs_state, static_cast<int>(state_size_)};
            options.places[rhs_input] = {rhs_input, RhsInput::size};
            options.places[rhs_parameters] = {rhs_parameters, static_cast<int>(rhs_.parameters.size())};
            options.places[rhs_rate] = {rhs_rate, static_cast<int>(results)};
            options.places[rhs_report] = {rhs_report, static_cast<int>(report_size())};
            return compiled(program::with_tangents(graph, options), *engine_, true);
        };
        with_tangents_ = {made(rhs_.graph, state_size_), made(sample_.graph, channel_count_)};
    }
    return with_tangents_;
}

const RolloutPrograms::Pair& RolloutPrograms::adjoint() {
    if (!adjoint_.rhs) {
        const auto made = [this](const program::Graph& graph) {
            program::DerivativeOptions options{.call_offset = RhsCall::adjoints};
            options.places[rhs_state] = {rollout_state_adjoint, 0};
            options.places[rhs_input] = {rollout_input_adjoint, 0};
            options.places[rhs_parameters] = {rollout_parameter_adjoint, 0};
            options.places[rhs_rate] = {rhs_rate, 0};
            options.places[rhs_report] = {rhs_report, 0};
            return compiled(program::adjoint(graph, options), *engine_, true);
        };
        adjoint_ = {made(rhs_.graph), made(sample_.graph)};
    }
    return adjoint_;
}

}  // namespace hamilcar
