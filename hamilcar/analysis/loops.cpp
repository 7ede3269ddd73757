#include "hamilcar/analysis/loops.hpp"

#include <fmt/format.h>

namespace hamilcar {

std::string spoke_name(const VehicleDescription& vehicle, int spoke) {
    const auto i = static_cast<std::size_t>(spoke);
    return i < vehicle.corners.size() ? vehicle.corners[i].name : vehicle.composed[i - vehicle.corners.size()].name;
}

std::string cut_name(const VehicleDescription& vehicle, const Model<double>& model, int spoke, int cut) {
    if (cut < 0) return "no joint";
    const auto i = static_cast<std::size_t>(spoke);
    if (i < vehicle.corners.size()) {
        return std::visit([&](const auto& s) { return std::string(s.cut_names[static_cast<std::size_t>(cut)]); },
                          model.vehicle.spokes[i].suspension);
    }
    // of a composed suspension the equations are numbered
    for (const CutJointDescription& joint : vehicle.composed[i - vehicle.corners.size()].linkage.cuts) {
        if (cut < equations(joint.kind)) return joint.name;
        cut -= equations(joint.kind);
    }
    return "no joint";
}

std::string assembly_problem(const VehicleDescription& vehicle, const Model<double>& model, const LoopReport& loop) {
    const std::string spoke = spoke_name(vehicle, loop.spoke);
    if (loop.mobility <= locked_mobility) {
        return fmt::format(
            "{}: the linkage is locked: its arms and rods cannot follow the wheel's travel from here "
            "(mobility {:.1e}, expected above {:.0e}); two of them may share a point or a line",
            spoke, loop.mobility, locked_mobility);
    }
    return fmt::format("{}: the hardpoints do not assemble: '{}' misses by {:.3f} mm (expected below {:.0e} mm)", spoke,
                       cut_name(vehicle, model, loop.spoke, loop.cut), 1e3 * loop.opening, 1e3 * assembly_tolerance);
}

}  // namespace hamilcar
