#include "hamilcar/block/freedoms.hpp"

namespace hamilcar {

std::vector<StateFreedom> state_freedoms(const Vehicle<double>& vehicle) {
    std::vector<StateFreedom> out;
    for (const Suspension<double>& suspension : vehicle.suspensions) {
        for (int j = 0; j < suspension.linkage.nV(); ++j) {
            out.push_back({suspension.offset + j, suspension.offset + suspension.linkage.nq() + j, false});
        }
    }
    for (const Trailer<double>& trailer : vehicle.trailers) {
        const int n = trailer.freedoms();
        for (int j = 0; j < n; ++j) out.push_back({trailer.offset + j, trailer.offset + n + j, j == trailer.yaw});
    }
    return out;
}

}  // namespace hamilcar
