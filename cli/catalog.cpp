#include "catalog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

// TOML files of a folder, sorted; `given` comes first if it is not among them.
std::vector<std::string> files_in(const std::string& folder, const std::string& given) {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    }
    std::ranges::sort(files);
    const auto same = [&](const std::string& file) { return fs::equivalent(file, given); };
    if (!given.empty() && std::ranges::none_of(files, same)) files.insert(files.begin(), given);
    return files;
}

// A file that cannot be read is reported and left out; the others remain available.
template <class Read>
void add_choices(const std::vector<std::string>& files, const Read& name_of, std::vector<live::Selectable>& choices) {
    for (const std::string& file : files) {
        try {
            choices.push_back({file, name_of(file)});
        } catch (const io::Error& error) {
            fmt::print(stderr, "hamilcar: not offered in the menu: {}\n", error.what());
        }
    }
}

constexpr std::string_view course_road = "maneuver:";  // prefix of the id of a road that is a maneuver's course

const Maneuver* maneuver_of(const std::string& road) {
    return road.starts_with(course_road) ? find_maneuver(road.substr(course_road.size())) : nullptr;
}

Course default_course(const Maneuver& maneuver, const VehicleDescription& vehicle) {
    return maneuver.course(vehicle, complete_settings(maneuver, vehicle, {}));
}

// Adds the maneuvers whose courses have cones, boundaries or a line; `vehicle` must support all maneuvers.
void add_courses(const VehicleDescription& vehicle, std::vector<live::Selectable>& roads) {
    for (const Maneuver& maneuver : maneuvers()) {
        const Course course = default_course(maneuver, vehicle);
        if (course.cones.empty() && course.boundaries.empty() && course.line.empty()) continue;
        const std::string standard = maneuver.standard.empty() ? "" : " (" + maneuver.standard + ")";
        roads.push_back({std::string(course_road) + maneuver.name, maneuver.title + standard, true});
    }
}

// A road that needs no file: level ground, with or without a course.
std::optional<ScenarioDescription> level_road(const std::string& road) {
    const Maneuver* maneuver = maneuver_of(road);
    if (!maneuver && road != level_ground) return std::nullopt;
    ScenarioDescription scenario;
    scenario.name = maneuver ? maneuver->title : level_ground;
    scenario.duration = 1;
    return scenario;
}

std::optional<live::TestCourse> course_on(const std::string& road, const VehicleDescription& vehicle) {
    const Maneuver* maneuver = maneuver_of(road);
    if (!maneuver) return std::nullopt;
    if (const std::string reason = maneuver->unsupported_reason(vehicle); !reason.empty()) {
        throw io::Error(io::ExitCode::bad_file,
                        fmt::format("{} is not available for {}: {}", maneuver->title, vehicle.name, reason));
    }
    return live::TestCourse{.id = maneuver->name,
                            .name = maneuver->standard.empty() ? maneuver->title : maneuver->standard,
                            .title = maneuver->title,
                            .course = default_course(*maneuver, vehicle)};
}

}  // namespace

live::Catalog make_catalog(const VehicleChoice& vehicle, const std::string& scenario) {
    live::Catalog catalog;
    const std::string default_vehicle = shipped_file("vehicles/bmw_323i.toml");
    const std::string vehicles = fs::path(default_vehicle).parent_path().string();
    const std::string scenarios = fs::path(shipped_file("scenarios/paper.toml")).parent_path().string();
    add_choices(
        files_in(vehicles, vehicle.file), [](const std::string& file) { return io::read_vehicle(file).name; },
        catalog.vehicles);
    catalog.roads.push_back({level_ground, level_ground});
    add_choices(
        files_in(scenarios, scenario), [](const std::string& file) { return io::read_scenario(file).name; },
        catalog.roads);
    add_courses(io::read_vehicle(default_vehicle), catalog.roads);
    catalog.course = course_on;
    catalog.open = [vehicle](const live::LoadRequest& request) {
        const std::optional<ScenarioDescription> level = level_road(request.road);
        ScenarioDescription road = level ? *level : io::read_scenario(request.road);
        road.initial.velocity = road.initial.angular_velocity = {0, 0, 0};
        const bool is_named = fs::exists(request.vehicle) && fs::equivalent(request.vehicle, vehicle.file);
        return std::pair(read_vehicle({request.vehicle, is_named ? vehicle.set : std::vector<std::string>{}}), road);
    };
    return catalog;
}

std::string choice_of(const std::vector<live::Selectable>& choices, const std::string& file) {
    for (const live::Selectable& choice : choices) {
        if (fs::exists(choice.id) && fs::equivalent(choice.id, file)) return choice.id;
    }
    return file;
}

}  // namespace hamilcar::cli
