#include "hamilcar/engine/rhs_recorder.hpp"

namespace hamilcar {

void record_rhs_in_doubles(const Model<double>& model, const CommonCar& common, RhsTrace& to) {
    RhsRecorder<double>(model, common, to).record();
}

}  // namespace hamilcar
