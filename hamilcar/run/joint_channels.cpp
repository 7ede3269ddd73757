#include "hamilcar/run/joint_channels.hpp"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <utility>

#include "hamilcar/suspension/attachments.hpp"

namespace hamilcar {

namespace {

// All suspensions' at once, since what they share takes most of the time.
const JointForces& forces_of(const Sample& s, const VehicleDescription& vehicle, std::size_t suspension) {
    if (!s.joint_forces) {
        const Unbalanced unbalanced(s.model, s.state, s.input, s.velocity, s.momenta);
        joint_forces(unbalanced, vehicle, s.joint_forces.emplace());
    }
    return (*s.joint_forces)[suspension];
}

using ReadVector = std::function<const Vec3<double>&(const JointForces&)>;
using ReadBushes = std::function<const BushForces&(const JointForces&)>;

// The channels of one suspension.
class JointChannels {
public:
    JointChannels(std::shared_ptr<const VehicleDescription> vehicle, std::size_t n, std::vector<Channel>& list)
        : vehicle_(std::move(vehicle)),
          n_(n),
          suspension_(vehicle_->suspensions[n]),
          axes_(suspension_.unit == 0 ? "vehicle axes" : "axes of the trailer"),
          list_(list) {}

    void add() {
        const LinkageDescription& linkage = suspension_.linkage;
        for (std::size_t i = 0; i < linkage.joints.size(); ++i) add_joint(linkage.joints[i], i);
        for (std::size_t i = 0; i < linkage.cuts.size(); ++i) add_cut(linkage.cuts[i], i);
    }

private:
    std::string name_of(const std::string& words) const { return suspension_.name + "." + link_key(words); }

    void add_vector(const std::string& name, const std::string& what, const ReadVector& read) {
        for (int i = 0; i < 3; ++i) {
            list_.push_back({{fmt::format("{}.{}", name, "xyz"[i]), "N", fmt::format("{}, {}", what, axes_)},
                             [read, i, vehicle = vehicle_, n = n_](const Sample& s) {
                                 return read(forces_of(s, *vehicle, n))[i];
                             }});
        }
    }
    // At `first` and `second` at design.
    void add_bushes(const std::string& words, const Point& first, const Point& second, const ReadBushes& read) {
        const auto what = [&](const Point& at) {
            return fmt::format("on the {}, of its bush at ({:.3f}, {:.3f}, {:.3f}) m", words, at[0], at[1], at[2]);
        };
        add_vector(name_of(words) + ".bush_1", what(first),
                   [read](const JointForces& f) -> const Vec3<double>& { return read(f).first; });
        add_vector(name_of(words) + ".bush_2", what(second),
                   [read](const JointForces& f) -> const Vec3<double>& { return read(f).second; });
    }
    void add_joint(const TreeJointDescription& joint, std::size_t i) {
        if (joint.kind == TreeJoint::free) return;
        add_vector(name_of(joint.part) + ".joint_force",
                   fmt::format("on the {}, of the joint that carries it", joint.part),
                   [i](const JointForces& f) -> const Vec3<double>& { return f.joints[i]; });
        if (!joint.other_bush) return;
        add_bushes(joint.part, joint.point, *joint.other_bush,
                   [i](const JointForces& f) -> const BushForces& { return f.joint_bushes[i]; });
    }
    void add_cut(const CutJointDescription& cut, std::size_t i) {
        const std::string name = name_of(cut.name) + ".force";
        if (cut.kind == CutJoint::distance) {
            list_.push_back(
                {{name, "N", "of the link, tension positive"},
                 [i, vehicle = vehicle_, n = n_](const Sample& s) { return forces_of(s, *vehicle, n).tension[i]; }});
            return;
        }
        const std::string held = cut.part == 0 ? "chassis" : suspension_.linkage.joints[cut.part - 1].part;
        add_vector(name, fmt::format("on the {}, of the {}", held, cut.name),
                   [i](const JointForces& f) -> const Vec3<double>& { return f.cuts[i]; });
        if (!cut.other_bush) return;
        add_bushes(cut.name, cut.foot, *cut.other_bush,
                   [i](const JointForces& f) -> const BushForces& { return f.cut_bushes[i]; });
    }

    std::shared_ptr<const VehicleDescription> vehicle_;
    std::size_t n_;
    const SuspensionDescription& suspension_;
    const char* axes_;
    std::vector<Channel>& list_;
};

}  // namespace

void add_joint_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    const auto shared = std::make_shared<const VehicleDescription>(vehicle);
    for (std::size_t n = 0; n < vehicle.suspensions.size(); ++n) JointChannels(shared, n, list).add();
}

}  // namespace hamilcar
