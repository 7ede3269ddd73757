#include <nlohmann/json.hpp>

#include "hamilcar/run/scene.hpp"

namespace hamilcar {

namespace {

using nlohmann::json;

constexpr double far_away = 1e4;  // stands for "everywhere": JSON has no infinity [m]

json to_json(const FramePoint& point) {
    return {{"frame", point.frame}, {"point", point.point}};
}

const char* word(LinkKind kind) {
    switch (kind) {
        case LinkKind::rod: return "rod";
        case LinkKind::spring: return "spring";
        case LinkKind::damper: return "damper";
        case LinkKind::strut: return "strut";
        case LinkKind::hinge: return "hinge";
        case LinkKind::body: return "body";
    }
    return "body";
}

json road_json(const ScenarioDescription& scenario) {
    const RoadDescription& road = scenario.road;
    json patches = json::array(), cones = json::array();
    const auto range = [](double from, double to) {
        return json::array({std::max(from, -far_away), std::min(to, far_away)});
    };
    for (const FrictionPatchDescription& patch : road.patches) {
        patches.push_back({{"x", range(patch.start, patch.end)},
                           {"y", range(patch.right, patch.left)},
                           {"friction", patch.friction}});
    }
    for (const std::array<double, 2>& cone : scenario.cones) cones.push_back(cone);
    return {{"name", scenario.name},      {"grade", road.grade}, {"bank", road.bank}, {"friction", road.friction},
            {"uneven", road.is_uneven()}, {"patches", patches},  {"cones", cones}};
}

}  // namespace

std::string scene_json(const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    const Scene scene = make_scene(vehicle);
    json frames = json::array(), links = json::array(), wheels = json::array(), tires = json::array(),
         bodies = json::array();
    for (const SceneFrame& frame : scene.frames) frames.push_back({{"name", frame.name}, {"unit", frame.unit}});
    for (const SceneLink& link : scene.links) {
        links.push_back(
            {{"kind", word(link.kind)}, {"name", link.name}, {"a", to_json(link.a)}, {"b", to_json(link.b)}});
    }
    for (const SceneWheel& wheel : scene.wheels) {
        wheels.push_back({{"name", wheel.name},
                          {"frame", wheel.frame},
                          {"center", wheel.center},
                          {"axis", wheel.axis},
                          {"radius", wheel.radius},
                          {"width", wheel.width},
                          {"tires", wheel.tires}});
    }
    for (const std::string& tire : scene.tires) tires.push_back({{"name", tire}});
    for (const SceneBody& body : scene.bodies) {
        json box{{"unit", body.unit}, {"low", body.low}, {"high", body.high}};
        if (body.style) box["style"] = body_style_names[static_cast<std::size_t>(*body.style)];
        bodies.push_back(std::move(box));
    }
    return json{{"vehicle", vehicle.name}, {"units", 1 + vehicle.trailers.size()},
                {"frames", frames},        {"links", links},
                {"wheels", wheels},        {"tires", tires},
                {"bodies", bodies},        {"road", road_json(scenario)}}
        .dump();
}

}  // namespace hamilcar
