#include "hamilcar/analysis/loops.hpp"

#include <fmt/format.h>

namespace hamilcar {

std::string suspension_name(const VehicleDescription& vehicle, int suspension) {
    return vehicle.suspensions[static_cast<std::size_t>(suspension)].name;
}

std::string cut_name(const VehicleDescription& vehicle, const Model<double>& model, int suspension, int cut) {
    if (cut < 0) return "no joint";
    // equations are numbered, joints have names
    for (const CutJointDescription& joint : vehicle.suspensions[static_cast<std::size_t>(suspension)].linkage.cuts) {
        if (cut < equations(joint.kind)) return joint.name;
        cut -= equations(joint.kind);
    }
    return "no joint";
}

std::string assembly_problem(const VehicleDescription& vehicle, const Model<double>& model, const LoopReport& loop) {
    const std::string suspension = suspension_name(vehicle, loop.suspension);
    if (loop.mobility <= locked_mobility) {
        return fmt::format(
            "{}: the linkage is locked: its arms and rods cannot follow the wheel's travel from here "
            "(mobility {:.1e}, expected above {:.0e}); two of them may share a point or a line",
            suspension, loop.mobility, locked_mobility);
    }
    return fmt::format("{}: the hardpoints do not assemble: '{}' misses by {:.3f} mm (expected below {:.0e} mm)",
                       suspension, cut_name(vehicle, model, loop.suspension, loop.cut), 1e3 * loop.violation,
                       1e3 * assembly_tolerance);
}

}  // namespace hamilcar
