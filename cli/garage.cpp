#include "garage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

// TOML files of a folder in the order of their names, a given one among them or in front.
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

// A file that cannot be read is no reason not to drive another.
template <class Read>
void add_choices(const std::vector<std::string>& files, const Read& name_of, std::vector<live::Choice>& choices) {
    for (const std::string& file : files) {
        try {
            choices.push_back({file, name_of(file)});
        } catch (const io::Error& error) {
            fmt::print(stderr, "hamilcar: left out of the menu: {}\n", error.what());
        }
    }
}

ScenarioDescription level_road() {
    ScenarioDescription scenario;
    scenario.name = level_ground;
    scenario.duration = 1;
    return scenario;
}

}  // namespace

live::Garage make_garage(const std::string& vehicle, const std::string& scenario) {
    live::Garage garage;
    const std::string vehicles = fs::path(shipped_file("vehicles/bmw_323i.toml")).parent_path().string();
    const std::string scenarios = fs::path(shipped_file("scenarios/paper.toml")).parent_path().string();
    add_choices(
        files_in(vehicles, vehicle), [](const std::string& file) { return io::read_vehicle(file).name; },
        garage.vehicles);
    garage.roads.push_back({level_ground, level_ground});
    add_choices(
        files_in(scenarios, scenario), [](const std::string& file) { return io::read_scenario(file).name; },
        garage.roads);
    garage.open = [](const live::Wish& wish) {
        ScenarioDescription road = wish.road == level_ground ? level_road() : io::read_scenario(wish.road);
        road.initial.velocity = road.initial.angular_velocity = {0, 0, 0};
        return std::pair(io::read_vehicle(wish.vehicle), road);
    };
    return garage;
}

std::string choice_of(const std::vector<live::Choice>& choices, const std::string& file) {
    for (const live::Choice& choice : choices) {
        if (fs::exists(choice.id) && fs::equivalent(choice.id, file)) return choice.id;
    }
    return file;
}

}  // namespace hamilcar::cli
