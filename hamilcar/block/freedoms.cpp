#include "hamilcar/block/freedoms.hpp"

namespace hamilcar {

std::vector<StateFreedom> state_freedoms(const Vehicle<double>& vehicle) {
    std::vector<StateFreedom> out;
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        const int first = hub_size + i * spoke_size;
        const int count = dispatch(vehicle.spokes[static_cast<std::size_t>(i)].suspension,
                                   [](const auto& s) { return std::decay_t<decltype(s)>::Linkage::nV; });
        for (int j = 0; j < count; ++j) out.push_back({first + j, first + max_independent + max_dependent + j, false});
    }
    for (const ComposedSpoke<double>& spoke : vehicle.composed) {
        for (int j = 0; j < spoke.linkage.nV(); ++j) {
            out.push_back({spoke.offset + j, spoke.offset + spoke.linkage.nq() + j, false});
        }
    }
    for (const Trailer<double>& trailer : vehicle.trailers) {
        const int n = trailer.freedoms();
        for (int j = 0; j < n; ++j) out.push_back({trailer.offset + j, trailer.offset + n + j, j == trailer.yaw});
    }
    return out;
}

}  // namespace hamilcar
