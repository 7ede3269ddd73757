#include "hamilcar/analysis/freedom.hpp"

namespace hamilcar {

namespace {

std::string_view name_of(TreeJoint kind) {
    constexpr std::string_view names[] = {"revolute", "prismatic", "universal", "spherical", "free"};
    return names[static_cast<std::size_t>(kind)];
}
std::string_view name_of(CutJoint kind) {
    constexpr std::string_view names[] = {"distance", "plane", "line", "revolute-spherical", "spherical"};
    return names[static_cast<std::size_t>(kind)];
}

// "strut angle z", or "lower arm" where a part has one coordinate.
std::vector<std::string> coordinate_names(const LinkageDescription& linkage) {
    constexpr std::string_view own[5][6] = {{""},
                                            {""},
                                            {" angle 1", " angle 2"},
                                            {" angle z", " angle x", " angle y"},
                                            {" x", " y", " z", " angle z", " angle x", " angle y"}};
    std::vector<std::string> out;
    for (const TreeJointDescription& joint : linkage.joints) {
        for (int i = 0; i < freedoms(joint.kind); ++i) {
            out.push_back(joint.part + std::string(own[static_cast<std::size_t>(joint.kind)][i]));
        }
    }
    return out;
}

SuspensionStructure describe(const SuspensionDescription& d, const Linkage<double>& linkage) {
    SuspensionStructure out{.name = d.name, .suspension = d.keyword};
    for (const TreeJointDescription& joint : d.linkage.joints) {
        out.joints.push_back(joint.part + " (" + std::string(name_of(joint.kind)) + ")");
    }
    for (const CutJointDescription& cut : d.linkage.cuts) {
        out.cuts.push_back(cut.name + " (" + std::string(name_of(cut.kind)) + ")");
    }
    const std::vector<std::string> names = coordinate_names(d.linkage);
    for (const int i : linkage.independent) out.independent.push_back(names[static_cast<std::size_t>(i)]);
    for (const int i : linkage.dependent) out.dependent.push_back(names[static_cast<std::size_t>(i)]);
    out.cut_equations = d.linkage.equation_count();
    return out;
}

}  // namespace

Structure structure(const Vehicle<double>& vehicle, const VehicleDescription& description) {
    Structure out;
    for (std::size_t i = 0; i < vehicle.suspensions.size(); ++i) {
        out.suspensions.push_back(describe(description.suspensions[i], vehicle.suspensions[i].linkage));
        out.bodies += static_cast<int>(vehicle.suspensions[i].bodies.size());
        out.coordinates += vehicle.suspensions[i].linkage.nq();
        out.cut_equations += out.suspensions.back().cut_equations;
        out.degrees_of_freedom += vehicle.suspensions[i].linkage.nV();
        out.wheel_spins += static_cast<int>(vehicle.suspensions[i].wheels.size());
    }
    for (const Trailer<double>& trailer : vehicle.trailers) {
        out.bodies += 1;
        out.coordinates += trailer.freedoms(), out.degrees_of_freedom += trailer.freedoms();
        out.hitch_freedoms += trailer.freedoms();
    }
    return out;
}

std::vector<ConstraintRow> paper_table_2(const Structure& structure, bool with_driver) {
    std::vector<ConstraintRow> rows;
    constexpr int body_freedom = 6;
    for (const SuspensionStructure& suspension : structure.suspensions) {
        const int tree = static_cast<int>(suspension.independent.size() + suspension.dependent.size());
        rows.push_back({"tree joint of " + suspension.name, body_freedom - tree});
        for (const std::string& cut : suspension.cuts) {
            const bool two = cut.ends_with("(revolute-spherical)") || cut.ends_with("(line)");
            rows.push_back({cut + " of " + suspension.name, two ? 2 : cut.ends_with("(spherical)") ? 3 : 1});
        }
    }
    if (with_driver) rows.push_back({"driving constraint of the rack", 1});
    rows.push_back({"Euler parameter normalization", structure.bodies});
    return rows;
}

}  // namespace hamilcar
