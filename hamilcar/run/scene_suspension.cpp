#include "hamilcar/run/scene_suspension.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/math/convert.hpp"

namespace hamilcar {

namespace {

constexpr double half_bush = 0.03;      // how long a hinge with one known point is drawn, each way [m]
constexpr double tire_aspect = 0.65;    // width over unloaded radius: tire files need not know the width
constexpr double same_point = 1e-3;     // [m]
constexpr double dual_tire_room = 0.9;  // of the distance between dual tires

std::string as_name(std::string words) {
    std::ranges::replace(words, ' ', '_');
    return words;
}

Point along(const Point& from, const Point& direction, double length) {
    return {from[0] + length * direction[0], from[1] + length * direction[1], from[2] + length * direction[2]};
}

double distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

class SuspensionDrawing {
public:
    SuspensionDrawing(const SuspensionDescription& suspension, const PartPose& pose, Scene& scene)
        : suspension_(suspension),
          pose_(pose),
          scene_(scene),
          first_frame_(scene.frames.size()),
          points_(suspension.linkage.joints.size() + 1) {
        for (std::size_t i = 0; i < suspension.linkage.joints.size(); ++i) {
            scene_.frames.push_back({suspension.name + "." + as_name(suspension.linkage.joints[i].part),
                                     suspension.unit, [pose, i](const Sample& s) { return pose(s, i + 1); }});
        }
    }

    void draw() {
        for (std::size_t i = 0; i < suspension_.linkage.joints.size(); ++i) add_joint(i);
        for (const CutJointDescription& cut : suspension_.linkage.cuts) add_cut(cut);
        for (const SuspensionWheelDescription& wheel : suspension_.wheels) add_wheel(wheel);
        add_springs();
        for (std::size_t part = 1; part < points_.size(); ++part) outline(part);
    }

private:
    std::size_t frame(std::size_t part) const { return part == 0 ? suspension_.unit : first_frame_ + part - 1; }
    void know(std::size_t part, const Point& point) {
        const auto near = [&](const Point& other) { return distance(point, other) < same_point; };
        if (part > 0 && std::ranges::none_of(points_[part], near)) points_[part].push_back(point);
    }
    void add(LinkKind kind, const std::string& name, const FramePoint& a, const FramePoint& b) {
        scene_.links.push_back({kind, suspension_.name + "." + name, a, b});
    }
    // Along its axis, whole where both bushes are known.
    void add_hinge(const std::string& name, std::size_t base, const Point& bush, const Point& axis,
                   const std::optional<Point>& other) {
        const auto piece = [&](const Point& at) {
            add(LinkKind::hinge, name, {frame(base), along(at, axis, -half_bush)},
                {frame(base), along(at, axis, half_bush)});
        };
        piece(bush);
        if (other) piece(*other);
    }

    void add_joint(std::size_t i) {
        const TreeJointDescription& joint = suspension_.linkage.joints[i];
        if (joint.kind == TreeJoint::free || joint.kind == TreeJoint::prismatic) return;
        know(i + 1, joint.point), know(joint.parent, joint.point);
        if (joint.kind != TreeJoint::revolute) return;
        if (joint.other_bush) know(i + 1, *joint.other_bush);
        add_hinge(joint.part, joint.parent, joint.point, joint.axis, joint.other_bush);
    }

    void add_cut(const CutJointDescription& cut) {
        know(cut.part, cut.tip);
        const bool driven = cut.drive != Point{};
        FramePoint foot{frame(cut.base), cut.foot};
        if (driven) {
            foot.frame = scene_.frames.size();
            scene_.frames.push_back({suspension_.name + "." + as_name(cut.name) + "_rack", suspension_.unit,
                                     [pose = pose_, base = cut.base, drive = vec3(cut.drive),
                                      by = suspension_.steered_by](const Sample& s) {
                                         const Pose<double> on = pose(s, base);
                                         const RackMotion<double>& rack =
                                             by ? s.velocity.axle_racks[*by] : s.velocity.rack;
                                         return Pose<double>{on.R, on.p + on.direction(drive * rack.displacement)};
                                     }});
        } else {
            know(cut.base, cut.foot);
        }
        if (cut.kind == CutJoint::distance) {
            add(LinkKind::rod, cut.name, {frame(cut.part), cut.tip}, foot);
        } else if (cut.kind == CutJoint::revolute_spherical) {
            add(LinkKind::rod, cut.name, {frame(cut.part), cut.tip}, foot);
            if (cut.other_bush) add(LinkKind::rod, cut.name, {frame(cut.part), cut.tip}, {foot.frame, *cut.other_bush});
            add_hinge(cut.name, cut.base, cut.foot, cut.axis, cut.other_bush);
        }
    }

    void add_wheel(const SuspensionWheelDescription& wheel) {
        know(wheel.part, wheel.wheel.center);
        const double radius = casing_of(wheel.tire).radius, half = wheel.dual_spacing / 2;
        const bool two = wheel.dual_spacing > 0;
        const double width =
            two ? std::min(tire_aspect * radius, dual_tire_room * wheel.dual_spacing) : tire_aspect * radius;
        scene_.wheels.push_back({wheel.name, frame(wheel.part), wheel.wheel.center, wheel.wheel.spin_axis, radius,
                                 width, two ? std::vector<double>{half, -half} : std::vector<double>{0}});
        if (two) {
            scene_.tires.push_back(wheel.name + ".left_tire"), scene_.tires.push_back(wheel.name + ".right_tire");
        } else {
            scene_.tires.push_back(wheel.name + ".tire");
        }
    }

    // The ends of a spring or damper, none where it twists.
    std::optional<std::pair<FramePoint, FramePoint>> ends(const LineDescription& line) {
        if (!line.coordinate) {
            know(line.part, line.on_part), know(line.base, line.on_base);
            return {{{frame(line.base), line.on_base}, {frame(line.part), line.on_part}}};
        }
        int coordinate = *line.coordinate;
        for (std::size_t i = 0; i < suspension_.linkage.joints.size(); ++i) {
            const TreeJointDescription& joint = suspension_.linkage.joints[i];
            coordinate -= freedoms(joint.kind);
            if (coordinate >= 0) continue;
            if (joint.kind != TreeJoint::prismatic || joint.parent == 0) return {};
            know(i + 1, joint.point);
            const Point& seat = suspension_.linkage.joints[joint.parent - 1].point;
            return {{{frame(joint.parent), seat}, {frame(i + 1), joint.point}}};
        }
        return {};
    }
    static bool same(const FramePoint& a, const FramePoint& b) {
        return a.frame == b.frame && distance(a.point, b.point) < same_point;
    }

    // A damper inside a spring is a strut.
    void add_springs() {
        std::vector<std::pair<FramePoint, FramePoint>> dampers;
        for (const SuspensionDamperDescription& damper : suspension_.dampers) {
            if (const auto line = ends(damper.line)) dampers.push_back(*line);
        }
        for (const SuspensionSpringDescription& spring : suspension_.springs) {
            const auto line = ends(spring.line);
            if (!line) continue;
            const auto inside = std::erase_if(dampers, [&](const auto& damper) {
                return same(line->first, damper.first) && same(line->second, damper.second);
            });
            const LinkKind kind = inside > 0 ? LinkKind::strut : LinkKind::spring;
            add(kind, inside > 0 ? "strut" : "spring", line->first, line->second);
        }
        for (const auto& [a, b] : dampers) add(LinkKind::damper, "damper", a, b);
    }

    // From the wheel's center, or else from the middle, to every point of the part.
    void outline(std::size_t part) {
        const std::vector<Point>& points = points_[part];
        if (points.size() < 2) return;
        Point middle{};
        for (const Point& point : points) middle = along(middle, point, 1.0 / static_cast<double>(points.size()));
        std::vector<Point> centers;
        for (const SuspensionWheelDescription& wheel : suspension_.wheels) {
            if (wheel.part == part) centers.push_back(wheel.wheel.center);
        }
        if (centers.size() == 1) middle = centers[0];
        for (const Point& point : points) {
            if (distance(point, middle) > same_point) {
                add(LinkKind::body, suspension_.linkage.joints[part - 1].part, {frame(part), middle},
                    {frame(part), point});
            }
        }
    }

    const SuspensionDescription& suspension_;
    const PartPose& pose_;
    Scene& scene_;
    std::size_t first_frame_;
    std::vector<std::vector<Point>> points_;  // known of each part
};

}  // namespace

void add_suspension(const SuspensionDescription& suspension, const PartPose& pose, Scene& scene) {
    SuspensionDrawing(suspension, pose, scene).draw();
}

}  // namespace hamilcar
