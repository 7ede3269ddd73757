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

}  // namespace

Structure structure(const Vehicle<double>& vehicle, const std::vector<std::string>& corner_names) {
    Structure out;
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
    return out;
}

std::vector<ConstraintRow> paper_table_2(const Structure& structure, bool with_driver) {
    std::vector<ConstraintRow> rows;
    constexpr int body_freedom = 6;
    for (const SpokeStructure& spoke : structure.spokes) {
        const int tree = static_cast<int>(spoke.independent.size() + spoke.dependent.size());
        rows.push_back({"tree joint of " + spoke.name, body_freedom - tree});
        for (const std::string& cut : spoke.cuts) {
            const bool arm = cut.find("revolute-spherical") != std::string::npos;
            rows.push_back({cut + " of " + spoke.name, arm ? 2 : 1});
        }
    }
    if (with_driver) rows.push_back({"driving constraint of the rack", 1});
    rows.push_back({"Euler parameter normalization", structure.bodies});
    return rows;
}

}  // namespace hamilcar
