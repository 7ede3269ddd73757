#include "hamilcar/run/scene.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hamilcar/math/convert.hpp"
#include "hamilcar/run/scene_suspension.hpp"
#include "hamilcar/run/unit_pose_of.hpp"

namespace hamilcar {

namespace {

PartPose pose_of_part(const SuspensionDescription& suspension, std::size_t i) {
    std::vector<std::size_t> frames;
    for (std::size_t part = 0; part <= suspension.linkage.joints.size(); ++part) {
        frames.push_back(static_cast<std::size_t>(frame_of_part(suspension.linkage, part)));
    }
    return [i, frames](const Sample& s, std::size_t part) {
        return s.velocity.suspensions[i].at.pose[frames[part]].pose();
    };
}

// The uniform box that has the body's mass and inertia.
SceneBody box_of_inertia(const BodyDescription& body, std::size_t unit) {
    SceneBody box{unit, body.center_of_mass, body.center_of_mass};
    const double sum = body.inertia[0] + body.inertia[1] + body.inertia[2];
    for (std::size_t i = 0; i < 3; ++i) {
        const double half = std::sqrt(std::max(6 * (sum - 2 * body.inertia[i]) / body.mass, 0.0)) / 2;
        box.low[i] -= half, box.high[i] += half;
    }
    return box;
}

SceneBody box_of_bodywork(const BodyworkDescription& body, std::size_t unit) {
    return {unit,
            {body.front - body.length, -body.width / 2, body.bottom},
            {body.front, body.width / 2, body.top},
            body.style};
}

SceneBody bodywork(const VehicleDescription& vehicle) {
    if (vehicle.bodywork) return box_of_bodywork(*vehicle.bodywork, 0);
    if (vehicle.hull.points.empty()) return box_of_inertia(vehicle.chassis, 0);
    SceneBody box{0, vehicle.hull.points[0], vehicle.hull.points[0]};
    for (const Point& point : vehicle.hull.points) {
        for (std::size_t i = 0; i < 3; ++i) {
            box.low[i] = std::min(box.low[i], point[i]), box.high[i] = std::max(box.high[i], point[i]);
        }
    }
    return box;
}

// Where the arm of a bar turns at a wheel, on its unit; nothing where the bar has no arms.
std::optional<FramePoint> bush_of_bar(const VehicleDescription& vehicle, std::size_t wheel) {
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        if (wheel >= suspension.wheels.size()) {
            wheel -= suspension.wheels.size();
            continue;
        }
        int coordinate = suspension.wheels[wheel].bar_arm.value_or(-1);
        if (coordinate < 0) return {};
        for (const TreeJointDescription& joint : suspension.linkage.joints) {
            if (coordinate == 0) return FramePoint{suspension.unit, joint.point};
            coordinate -= freedoms(joint.kind);
        }
    }
    return {};
}

}  // namespace

Scene make_scene(const VehicleDescription& vehicle) {
    Scene scene;
    for (std::size_t unit = 0; unit <= vehicle.trailers.size(); ++unit) {
        scene.frames.push_back({unit == 0 ? "chassis" : vehicle.trailers[unit - 1].name, unit, [unit](const Sample& s) {
                                    const UnitPose<double> place = unit_pose_of(s, unit);
                                    return Pose<double>{place.R, place.position};
                                }});
    }
    for (std::size_t i = 0; i < vehicle.suspensions.size(); ++i) {
        add_suspension(vehicle.suspensions[i], pose_of_part(vehicle.suspensions[i], i), scene);
    }
    for (const AntiRollBarDescription& bar : vehicle.anti_roll_bars) {
        const auto left = bush_of_bar(vehicle, bar.left), right = bush_of_bar(vehicle, bar.right);
        if (left && right) scene.links.push_back({LinkKind::body, "anti-roll bar", *left, *right});
    }
    scene.bodies.push_back(bodywork(vehicle));
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const TrailerDescription& trailer = vehicle.trailers[i];
        scene.bodies.push_back(trailer.bodywork ? box_of_bodywork(*trailer.bodywork, i + 1)
                                                : box_of_inertia(trailer.chassis, i + 1));
    }
    return scene;
}

}  // namespace hamilcar
