#include "hamilcar/engine/rhs_recorder.hpp"

namespace hamilcar {

void record_rhs_in_singles(const Model<double>& model, const CommonCar& common, RhsTrace& to) {
    RhsRecorder<float>(model, common, to).record();
}

}  // namespace hamilcar
