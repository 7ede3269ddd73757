// Suspensions in Simbody: every joint of the tree is one or two mobilizers, with a massless body in between, so that each
// coordinate's value is the description's; every cut joint is one or two of Simbody's constraints.

#include "tests/oracle/simbody_parts.hpp"

#include <stdexcept>

namespace hamilcar::oracle {

using SimTK::Body;
using SimTK::MobilizedBody;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

namespace {

// The bodies and wheels attached to each part, and the part as a body.
class Tree {
public:
    Tree(Parts& parts, const SuspensionDescription& description) : parts_(parts), description_(description) {
        bodies_.push_back(description.unit);  // units are the first bodies of all
        const auto& joints = description.linkage.joints;
        // From the tips inward: a part may go without mass if it carries one that has mass.
        carries_.assign(joints.size() + 1, false);
        for (std::size_t part = joints.size(); part > 0; --part) {
            carries_[joints[part - 1].parent] = carries_[joints[part - 1].parent] || carries_[part] || has_body(part);
        }
        tree_.first_wheel = parts.wheels.size();
        for (std::size_t i = 0; i < joints.size(); ++i) add_part(i + 1, joints[i]);
        for (const CutJointDescription& cut : description.linkage.cuts) add_cut(cut);
        for (const SuspensionWheelDescription& wheel : description.wheels) {
            const std::size_t carrier = bodies_.at(wheel.part);
            double mass = 0;
            for (const BodyDescription& body : bodies_on(wheel.part)) mass += body.mass;
            add_wheel(parts, wheel, description.unit, carrier, bodies_.at(wheel.drive_reaction),
                      wheel_mass_of(mass, wheels_on(wheel.part).size()));
        }
        for (const auto& spring : description.springs) add_element(spring.line, spring.spring, {});
        for (const auto& damper : description.dampers) add_element(damper.line, {}, damper.damper);
        parts.suspensions.push_back(tree_);
    }

private:
    std::vector<BodyDescription> bodies_on(std::size_t part) const {
        std::vector<BodyDescription> found;
        for (const SuspensionBodyDescription& body : description_.bodies) {
            if (body.part == part) found.push_back(body.body);
        }
        return found;
    }
    std::vector<WheelDescription> wheels_on(std::size_t part) const {
        std::vector<WheelDescription> found;
        for (const SuspensionWheelDescription& wheel : description_.wheels) {
            if (wheel.part == part) found.push_back(wheel.wheel);
        }
        return found;
    }
    bool has_body(std::size_t part) const { return !bodies_on(part).empty(); }

    Body body_of(std::size_t part, const TreeJointDescription& joint) const {
        const std::vector<WheelDescription> wheels = wheels_on(part);
        const std::string name = description_.name + ": '" + joint.part + "'";
        if (has_body(part) || !wheels.empty())
            return Body::Rigid(carrier_mass(name, bodies_on(part), wheels, to_vec3(joint.point)));
        if (!carries_[part])
            throw std::invalid_argument(name + " has no mass and carries none, which Simbody cannot move");
        return Body::Massless();
    }

    void add_part(std::size_t part, const TreeJointDescription& joint) {
        const Body own = body_of(part, joint), none = Body::Massless();
        const Placed& parent = parts_.bodies[bodies_.at(joint.parent)];
        const auto axis = [](const Point& a) { return UnitVec3(to_vec3(a)); };
        MobilizedBody last = parent.body;
        Vec3 station = parent.station(joint.point);
        const auto add = [&](const MobilizedBody& mobilizer, int coordinates) {
            tree_.add(mobilizer, coordinates);
            last = mobilizer;
            station = Vec3(0);
        };
        switch (joint.kind) {
            case TreeJoint::revolute: add(add_coordinate(last, station, false, axis(joint.axis), own), 1); break;
            case TreeJoint::prismatic: add(add_coordinate(last, station, true, axis(joint.axis), own), 1); break;
            case TreeJoint::universal:
                add(add_coordinate(last, station, false, axis(joint.axis), none), 1);
                add(add_coordinate(last, station, false, axis(joint.second_axis), own), 1);
                break;
            case TreeJoint::free:
                add(MobilizedBody::Translation(last, Transform(station), none, Transform()), 3);
                [[fallthrough]];
            case TreeJoint::spherical: add(add_ball(last, station, own), 3); break;
        }
        bodies_.push_back(parts_.place(last, to_vec3(joint.point)));
    }

    void add_cut(const CutJointDescription& cut) {
        Placed base = parts_.bodies[bodies_.at(cut.base)];
        Placed part = parts_.bodies[bodies_.at(cut.part)];
        const Vec3 drive = to_vec3(cut.drive);
        if (drive.norm() > 0) base = {add_rack(parts_, base.body, base.station(cut.foot), drive), to_vec3(cut.foot)};
        const Vec3 tip = part.station(cut.tip);
        const auto rod_from = [&](const Vec3& foot) {
            const double length = (to_vec3(cut.tip) - base.origin - foot).norm();
            SimTK::Constraint::Rod(base.body, foot, part.body, tip, cut.length.value_or(length));
        };
        const auto plane_through = [&](const Vec3& foot, const UnitVec3& normal) {
            SimTK::Constraint::PointInPlane(base.body, normal, ~normal * foot, part.body, tip);
        };
        const Vec3 foot = base.station(cut.foot);
        switch (cut.kind) {
            case CutJoint::distance: return rod_from(foot);
            case CutJoint::spherical: SimTK::Constraint::Ball(base.body, foot, part.body, tip); return;
            case CutJoint::plane: return plane_through(foot, UnitVec3(to_vec3(cut.axis)));
            case CutJoint::line:
                SimTK::Constraint::PointOnLine(base.body, UnitVec3(to_vec3(cut.axis)), foot, part.body, tip);
                return;
            case CutJoint::revolute_spherical: {
                const UnitVec3 axis(to_vec3(cut.axis));
                const Vec3 nearest = foot + (~axis * (to_vec3(cut.tip) - to_vec3(cut.foot))) * Vec3(axis);
                plane_through(nearest, axis);
                return rod_from(nearest);
            }
        }
    }

    void add_element(const LineDescription& line, const SpringDescription& spring, const DamperDescription& damper) {
        AxialElement element{bodies_.at(line.part), bodies_.at(line.base), {}, {}, {}, spring, damper};
        if (line.coordinate) {
            element.coordinate = tree_.coordinates.at(static_cast<std::size_t>(*line.coordinate));
        } else {
            element.on_part = parts_.bodies[element.part].station(line.on_part);
            element.on_base = parts_.bodies[element.base].station(line.on_base);
            element.design_length = (to_vec3(line.on_part) - to_vec3(line.on_base)).norm();
        }
        parts_.axial.push_back(element);
    }

    Parts& parts_;
    const SuspensionDescription& description_;
    TreeParts tree_;
    std::vector<std::size_t> bodies_;  // of the parts, among all
    std::vector<bool> carries_;        // whether anything outward of the part has a mass
};

}  // namespace

void add_suspensions(Parts& parts) {
    bool any_strut = false;
    for (const SuspensionDescription& suspension : parts.description.suspensions) {
        Tree(parts, modelled(suspension, parts.spindle_model));
        any_strut = any_strut || is_strut(suspension);
    }
    if (any_strut && parts.spindle_model == SpindleModel::strut_one_constraint) add_arms_and_tie_rods(parts);
}

}  // namespace hamilcar::oracle
