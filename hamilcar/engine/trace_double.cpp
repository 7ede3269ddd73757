#include "hamilcar/engine/trace_turn.hpp"

namespace hamilcar {

void record_turn_in_doubles(const Model<double>& model, const CommonCar& common, TurnTrace& to) {
    TurnRecorder<double>(model, common, to).record();
}

}  // namespace hamilcar
