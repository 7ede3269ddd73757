#include "hamilcar/run/motion_channels.hpp"

#include <fmt/format.h>

#include "hamilcar/run/scene.hpp"
#include "hamilcar/run/unit_pose_of.hpp"

namespace hamilcar {

namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};
constexpr std::array<const char*, 4> quaternion{"qw", "qx", "qy", "qz"};

std::array<double, 4> quaternion_of(const Mat3<double>& R) {
    const Eigen::Quaterniond q(R);
    return {q.w(), q.x(), q.y(), q.z()};
}

using io::ChannelRole;

// The roles of components follow each other.
ChannelRole component(ChannelRole first, std::size_t i) {
    return static_cast<ChannelRole>(static_cast<std::size_t>(first) + i);
}

template <class Read>
void add(std::vector<Channel>& list, io::Column column, Read read) {
    list.push_back({std::move(column), std::move(read)});
}

void add_pose(const SceneFrame& frame, bool on_ground, std::vector<Channel>& list) {
    for (std::size_t i = 0; i < 3; ++i) {
        add(list,
            {fmt::format("{}.pose.{}", frame.name, axes[i]), "m",
             on_ground ? "where the vehicle frame's origin is, ground axes" : "against design, axes of its unit",
             component(ChannelRole::pose_x, i), frame.name},
            [pose = frame.pose, i](const Sample& s) { return pose(s).p[static_cast<int>(i)]; });
    }
    for (std::size_t i = 0; i < 4; ++i) {
        add(list,
            {fmt::format("{}.pose.{}", frame.name, quaternion[i]), "1",
             on_ground ? "unit quaternion to ground axes" : "unit quaternion against design, to the axes of its unit",
             component(ChannelRole::pose_qw, i), frame.name},
            [pose = frame.pose, i](const Sample& s) { return quaternion_of(pose(s).R)[i]; });
    }
}

using ReadTire = std::function<const TireForces<double>&(const Sample&)>;

void add_tire(const std::string& name, std::size_t unit, const ReadTire& forces, std::vector<Channel>& list) {
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        add(list,
            {fmt::format("{}.contact.{}", name, axes[k]), "m", "the contact's middle, ground axes",
             component(ChannelRole::contact_x, k), name},
            [forces, unit, i](const Sample& s) {
                const UnitPose<double> place = unit_pose_of(s, unit);
                return place.position[i] + place.R.row(i).dot(forces(s).frame.point);
            });
    }
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        add(list,
            {fmt::format("{}.ground_force.{}", name, axes[k]), "N", "of the road on the tire, ground axes",
             component(ChannelRole::ground_force_x, k), name},
            [forces, unit, i](const Sample& s) {
                const TireForces<double>& f = forces(s);
                const Vec3<double> force =
                    f.tire.Fx * f.frame.longitudinal + f.tire.Fy * f.frame.lateral + f.tire.Fz * f.frame.normal;
                return unit_pose_of(s, unit).R.row(i).dot(force);
            });
    }
}

}  // namespace

void add_motion_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    const Scene scene = make_scene(vehicle);
    for (std::size_t i = 0; i < scene.frames.size(); ++i) {
        add_pose(scene.frames[i], i <= vehicle.trailers.size(), list);
    }
    for (std::size_t i = 0; i < vehicle.suspensions.size(); ++i) {
        const SuspensionDescription& suspension = vehicle.suspensions[i];
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            const auto tire = [i, w](std::size_t k) {
                return [i, w, k](const Sample& s) -> const TireForces<double>& {
                    return s.momenta.suspensions[i].wheels[w].tires[k];
                };
            };
            const std::string& name = suspension.wheels[w].name;
            if (suspension.wheels[w].dual_spacing > 0) {
                add_tire(name + ".left_tire", suspension.unit, tire(0), list);
                add_tire(name + ".right_tire", suspension.unit, tire(1), list);
            } else {
                add_tire(name + ".tire", suspension.unit, tire(0), list);
            }
        }
    }
}

}  // namespace hamilcar
