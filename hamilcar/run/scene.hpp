// What a vehicle looks like: which parts move, and what is seen of them, from its own hardpoints. The page draws it; the poses of
// the parts are channels like all others (motion_channels.hpp), so a result file with both is a replay.
//
// Everything is in the vehicle frame at design, where every pose is the identity.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// A moving part, or the chassis of a unit: those come first, the motor vehicle's and the trailers' in order.
struct SceneFrame {
    std::string name;      // "front_left.carrier"
    std::size_t unit = 0;  // whose axes the pose is in; of a chassis it is in ground axes
    std::function<Pose<double>(const Sample&)> pose;
};

struct FramePoint {
    std::size_t frame;
    Point point;  // [m]
};

// What two points are connected by. body: outlines a part; hinge: a bush, along its axis.
enum class LinkKind { rod, spring, damper, strut, hinge, body };

struct SceneLink {
    LinkKind kind;
    std::string name;
    FramePoint a, b;
};

struct SceneWheel {
    std::string name;
    std::size_t frame;  // its carrier
    Point center, axis;
    double radius, width;       // of one tire [m]
    std::vector<double> tires;  // offsets along the axis [m]
};

// The box around the bodywork of a unit, and its style if the vehicle's file states one.
struct SceneBody {
    std::size_t unit;
    Point low, high;  // [m]
    std::optional<BodyStyle> style = {};
};

struct Scene {
    std::vector<SceneFrame> frames;
    std::vector<SceneLink> links;
    std::vector<SceneWheel> wheels;
    std::vector<std::string> tires;  // "front_left.tire", in the order of the wheels
    std::vector<SceneBody> bodies;
};

Scene make_scene(const VehicleDescription& vehicle);

// A scene and its road as the JSON that the page reads (schemas/page.schema.json, "scene").
std::string scene_json(const VehicleDescription& vehicle, const ScenarioDescription& scenario);

}  // namespace hamilcar
