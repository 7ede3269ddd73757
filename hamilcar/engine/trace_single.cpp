#include "hamilcar/engine/trace_turn.hpp"

namespace hamilcar {

void record_turn_in_singles(const Model<double>& model, const CommonCar& common, TurnTrace& to) {
    TurnRecorder<float>(model, common, to).record();
}

}  // namespace hamilcar
