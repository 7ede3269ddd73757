#include "hamilcar/suspension/moved_parts.hpp"

#include "hamilcar/math/convert.hpp"

namespace hamilcar {

namespace {

Point as_point(const Vec3<double>& v) {
    return {v[0], v[1], v[2]};
}

void move(BodyDescription& body, const Pose<double>& pose) {
    body.center_of_mass = as_point(pose.point(vec3(body.center_of_mass)));
    const auto& [xy, yz, xz] = body.products;
    Mat3<double> inertia;
    inertia << body.inertia[0], xy, xz, xy, body.inertia[1], yz, xz, yz, body.inertia[2];
    inertia = pose.R * inertia * pose.R.transpose();
    body.inertia = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
    body.products = {inertia(0, 1), inertia(1, 2), inertia(0, 2)};
}

void move(LinkageDescription& linkage, const std::vector<Pose<double>>& poses) {
    const auto point = [&](std::size_t part, Point& p) { p = as_point(poses[part].point(vec3(p))); };
    const auto direction = [&](std::size_t part, Point& u) { u = as_point(poses[part].direction(vec3(u))); };
    for (std::size_t i = 0; i < linkage.joints.size(); ++i) {
        TreeJointDescription& joint = linkage.joints[i];
        point(i + 1, joint.point), direction(joint.parent, joint.axis), direction(i + 1, joint.second_axis);
        if (joint.other_bush) point(i + 1, *joint.other_bush);
    }
    for (CutJointDescription& cut : linkage.cuts) {
        point(cut.part, cut.tip), point(cut.base, cut.foot);
        direction(cut.base, cut.axis), direction(cut.base, cut.drive);
        if (cut.other_bush) point(cut.base, *cut.other_bush);
    }
}

}  // namespace

SuspensionDescription with_parts_moved(SuspensionDescription suspension, const std::vector<Pose<double>>& poses) {
    const auto point = [&](std::size_t part, Point& p) { p = as_point(poses[part].point(vec3(p))); };
    const auto line = [&](LineDescription& l) {
        if (!l.coordinate) point(l.part, l.on_part), point(l.base, l.on_base);
    };
    move(suspension.linkage, poses);
    for (SuspensionBodyDescription& body : suspension.bodies) move(body.body, poses[body.part]);
    for (SuspensionWheelDescription& wheel : suspension.wheels) {
        point(wheel.part, wheel.wheel.center);
        wheel.wheel.spin_axis = as_point(poses[wheel.part].direction(vec3(wheel.wheel.spin_axis)));
    }
    for (SuspensionSpringDescription& spring : suspension.springs) line(spring.line);
    for (SuspensionDamperDescription& damper : suspension.dampers) line(damper.line);
    return suspension;
}

std::vector<Pose<double>> shifted(const LinkageDescription& linkage, std::size_t part, const Vec3<double>& by) {
    std::vector<Pose<double>> poses(linkage.joints.size() + 1, {Mat3<double>::Identity(), Vec3<double>::Zero()});
    poses[part].p = by;
    for (std::size_t i = part; i < linkage.joints.size(); ++i) {
        if (linkage.joints[i].parent != 0) poses[i + 1].p = poses[linkage.joints[i].parent].p;
    }
    return poses;
}

}  // namespace hamilcar
