#include "hamilcar/analysis/freedom.hpp"

namespace hamilcar {

namespace {

template <class S>
SpokeStructure describe(const S& suspension, const std::string& corner) {
    using Linkage = typename S::Linkage;
    SpokeStructure out{.name = corner, .suspension = std::string(S::keyword)};
    std::apply([&](const auto&... joint) { (out.joints.emplace_back(joint.name), ...); }, suspension.linkage.joints);
    std::size_t cut = 0;
    suspension.linkage.visit_cuts([&](const auto& joint, int, int) {
        out.cuts.push_back(std::string(suspension.cut_names[cut++]) + " (" + std::string(joint.name) + ")");
    });
    for (int i : Linkage::independent_indices())
        out.independent.emplace_back(suspension.coordinate_names[static_cast<std::size_t>(i)]);
    for (int i : Linkage::dependent_indices())
        out.dependent.emplace_back(suspension.coordinate_names[static_cast<std::size_t>(i)]);
    out.cut_equations = Linkage::equations;
    return out;
}

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

SpokeStructure describe(const ComposedSpokeDescription& d, const ComposedLinkage<double>& linkage) {
    SpokeStructure out{.name = d.name, .suspension = d.suspension};
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
    std::vector<std::string> corner_names;
    for (const CornerDescription& corner : description.corners) corner_names.push_back(corner.name);
    for (std::size_t i = 0; i < vehicle.spokes.size(); ++i) {
        out.spokes.push_back(
            std::visit([&](const auto& s) { return describe(s, corner_names[i]); }, vehicle.spokes[i].suspension));
        const SpokeStructure& spoke = out.spokes.back();
        out.bodies += 1;
        out.coordinates += static_cast<int>(spoke.independent.size() + spoke.dependent.size());
        out.cut_equations += spoke.cut_equations;
        out.degrees_of_freedom += static_cast<int>(spoke.independent.size());
        out.wheel_spins += 1;
    }
    for (std::size_t i = 0; i < vehicle.composed.size(); ++i) {
        out.spokes.push_back(describe(description.composed[i], vehicle.composed[i].linkage));
        out.bodies += static_cast<int>(vehicle.composed[i].bodies.size());
        out.coordinates += vehicle.composed[i].linkage.nq();
        out.cut_equations += out.spokes.back().cut_equations;
        out.degrees_of_freedom += vehicle.composed[i].linkage.nV();
        out.wheel_spins += static_cast<int>(vehicle.composed[i].wheels.size());
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
    for (const SpokeStructure& spoke : structure.spokes) {
        const int tree = static_cast<int>(spoke.independent.size() + spoke.dependent.size());
        rows.push_back({"tree joint of " + spoke.name, body_freedom - tree});
        for (const std::string& cut : spoke.cuts) {
            const bool two = cut.ends_with("(revolute-spherical)") || cut.ends_with("(line)");
            rows.push_back({cut + " of " + spoke.name, two ? 2 : cut.ends_with("(spherical)") ? 3 : 1});
        }
    }
    if (with_driver) rows.push_back({"driving constraint of the rack", 1});
    rows.push_back({"Euler parameter normalization", structure.bodies});
    return rows;
}

}  // namespace hamilcar
