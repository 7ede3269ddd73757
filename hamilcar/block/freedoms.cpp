#include "hamilcar/block/freedoms.hpp"

namespace hamilcar {

std::vector<StateFreedom> state_freedoms(const Vehicle<double>& vehicle) {
    std::vector<StateFreedom> out;
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = vehicle.suspensions[s];
        for (int j = 0; j < suspension.linkage.nV(); ++j) {
            const int momentum = suspension.offset + suspension.linkage.nq() + j;
            out.push_back({suspension.offset + j, momentum, false, static_cast<int>(s)});
        }
    }
    for (const Trailer<double>& trailer : vehicle.trailers) {
        const int n = trailer.freedoms();
        for (int j = 0; j < n; ++j) out.push_back({trailer.offset + j, trailer.offset + n + j, j == trailer.yaw, -1});
    }
    return out;
}

}  // namespace hamilcar
