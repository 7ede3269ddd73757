#include "hamilcar/engine/rhs_trace.hpp"

#include <algorithm>
#include <bit>

#include "hamilcar/engine/rhs_recorder.hpp"
#include "hamilcar/program/pass.hpp"

namespace hamilcar {

namespace {

struct Collect {
    ModelNumbers& to;
    double number(double value) {
        to.numbers.push_back(value);
        return value;
    }
    int whole(int value) {
        to.shape.push_back(value);
        return value;
    }
};

}  // namespace

ModelNumbers numbers_of(const Model<double>& model) {
    ModelNumbers out;
    Model<double> copy;
    transcribe_model(copy, model, Collect{out});
    for (const int mode : {static_cast<int>(model.chart), static_cast<int>(model.constraints),
                           static_cast<int>(model.energy_balance), static_cast<int>(model.surface != nullptr)}) {
        out.shape.push_back(mode);
    }
    return out;
}

CommonCar common_car(std::span<const Model<double>* const> cars, Model<double>& example) {
    ModelNumbers all = numbers_of(*cars[0]);
    CommonCar common{std::vector<bool>(all.numbers.size()), {}};
    example = *cars[0];
    for (const Model<double>* car : cars) {
        const ModelNumbers own = numbers_of(*car);
        for (std::size_t i = 0; i < own.numbers.size(); ++i) {
            const bool same =
                std::bit_cast<std::uint64_t>(own.numbers[i]) == std::bit_cast<std::uint64_t>(all.numbers[i]);
            common.differs[i] = common.differs[i] || !same;
        }
        for (std::size_t i = 0; i < own.shape.size(); ++i) all.shape[i] = std::max(all.shape[i], own.shape[i]);
        if (car->surface) example.surface = car->surface;
    }
    common.shape = all.shape;
    return common;
}

RhsTrace trace_rhs(const Model<double>& model, const CommonCar& common, program::Precision precision) {
    RhsTrace out{.graph = program::Graph(precision), .correction_indices = {}, .parameters = {}, .measured = 0};
    RhsRecorder(model, common, out).record();
    return out;
}

RhsTrace trace_sample(const Model<double>& example, const CommonCar& common, Precision precision,
                      const TracedReaders& readers) {
    RhsTrace out{.graph = program::Graph(precision), .correction_indices = {}, .parameters = {}, .measured = 0};
    RhsRecorder(example, common, out).record(readers);
    return out;
}

std::shared_ptr<const program::Executable> sample_program(const Model<double>& example, const CommonCar& common,
                                                          const Engine& engine, Precision precision,
                                                          const TracedReaders& readers) {
    const RhsTrace trace = trace_sample(example, common, precision, readers);
    return compiled(program::in_single_numbers(program::without_dead_code(trace.graph)), engine, true);
}

}  // namespace hamilcar
