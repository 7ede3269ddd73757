#include "hamilcar/run/joint_channels.hpp"

#include <fmt/format.h>

#include <functional>
#include <memory>

#include "hamilcar/suspension/attachments.hpp"

namespace hamilcar {

namespace {

std::string name_of(const std::string& suspension, const std::string& words) {
    return suspension + "." + link_key(words);
}

// All suspensions' at once, since what they share takes most of the time.
const JointForces& forces_of(const Sample& s, const VehicleDescription& vehicle, std::size_t suspension) {
    if (!s.joint_forces) {
        const Unbalanced unbalanced(s.model, s.state, s.input, s.velocity, s.momenta);
        joint_forces(unbalanced, vehicle, s.joint_forces.emplace());
    }
    return (*s.joint_forces)[suspension];
}

using ReadVector = std::function<const Vec3<double>&(const JointForces&)>;

}  // namespace

void add_joint_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    const auto shared = std::make_shared<const VehicleDescription>(vehicle);
    for (std::size_t n = 0; n < vehicle.suspensions.size(); ++n) {
        const SuspensionDescription& suspension = vehicle.suspensions[n];
        const auto add_vector = [&](const std::string& name, const std::string& what, const ReadVector& read) {
            for (int i = 0; i < 3; ++i) {
                list.push_back({{fmt::format("{}.{}", name, "xyz"[i]), "N", what},
                                [=](const Sample& s) { return read(forces_of(s, *shared, n))[i]; }});
            }
        };
        const auto add_bushes = [&](const std::string& name, auto bushes_of) {
            add_vector(name + ".bush_1", "on what turns in it, of its first bush, axes of its unit",
                       [=](const JointForces& f) -> const Vec3<double>& { return bushes_of(f).first; });
            add_vector(name + ".bush_2", "of its second bush",
                       [=](const JointForces& f) -> const Vec3<double>& { return bushes_of(f).second; });
        };
        const LinkageDescription& linkage = suspension.linkage;
        for (std::size_t i = 0; i < linkage.joints.size(); ++i) {
            if (linkage.joints[i].kind == TreeJoint::free) continue;
            add_vector(name_of(suspension.name, linkage.joints[i].part) + ".joint_force",
                       "on the part, of the joint that carries it, axes of its unit",
                       [i](const JointForces& f) -> const Vec3<double>& { return f.joints[i]; });
            if (!linkage.joints[i].other_bush) continue;
            add_bushes(name_of(suspension.name, linkage.joints[i].part),
                       [i](const JointForces& f) -> const BushForces& { return f.joint_bushes[i]; });
        }
        for (std::size_t i = 0; i < linkage.cuts.size(); ++i) {
            const std::string name = name_of(suspension.name, linkage.cuts[i].name) + ".force";
            if (linkage.cuts[i].kind != CutJoint::distance) {
                add_vector(name, "on what it holds, axes of its unit",
                           [i](const JointForces& f) -> const Vec3<double>& { return f.cuts[i]; });
                if (!linkage.cuts[i].other_bush) continue;
                add_bushes(name_of(suspension.name, linkage.cuts[i].name),
                           [i](const JointForces& f) -> const BushForces& { return f.cut_bushes[i]; });
                continue;
            }
            list.push_back({{name, "N", "of the link, tension positive"},
                            [=](const Sample& s) { return forces_of(s, *shared, n).tension[i]; }});
        }
    }
}

}  // namespace hamilcar
