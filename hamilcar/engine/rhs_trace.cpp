#include "hamilcar/engine/rhs_trace.hpp"

#include "hamilcar/engine/rhs_recorder.hpp"

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

RhsTrace trace_rhs(const Model<double>& model, const CommonCar& common, program::Precision precision) {
    RhsTrace out{.graph = program::Graph(precision), .correction_indices = {}, .parameters = {}};
    RhsRecorder(model, common, out).record();
    return out;
}

}  // namespace hamilcar
