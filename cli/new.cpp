// `hamilcar new FILE`: a vehicle to start from.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/template/vehicle_template.hpp"

namespace hamilcar::cli {

namespace {

struct NewOptions {
    std::string file, front, rear, like = "sedan", drive, name;
    std::vector<std::string> set;
    bool list = false;
};

void print_list() {
    fmt::print("Classes (--like), with their suspensions and driven wheels:\n\n");
    for (const VehicleClass& c : vehicle_classes()) {
        fmt::print("  {:<11} {}: {} in front, {} at the rear, {}\n", c.name, c.title, c.front, c.rear,
                   c.drive == DrivenWheels::all
                       ? "all wheels driven"
                       : fmt::format("{} wheels driven", drive_words[static_cast<int>(c.drive)]));
    }
    fmt::print("\nSuspensions (--front, --rear):\n\n");
    for (const Recipe* recipe : recipes()) {
        fmt::print("  {:<18} {}{}\n", recipe->keyword, recipe->title,
                   can_be_steered(*recipe) ? "" : " (at the rear: it cannot be steered)");
    }
    fmt::print("\nValues (--set KEY=VALUE), by class:\n\n  {:<24}", "");
    for (const VehicleClass& c : vehicle_classes()) fmt::print("{:>11}", c.name);
    for (const ClassSetting& setting : class_settings()) {
        fmt::print("\n  {:<24}", setting.key);
        for (const VehicleClass& c : vehicle_classes())
            fmt::print("{:>11.4g}", c.values.*setting.value / setting.to_si);
        if (!setting.meaning.empty()) fmt::print("   {}", setting.meaning);
    }
    fmt::print("\n");
}

// What the command line says of one value; `assignment` is "KEY=VALUE".
void set_value(const std::string& assignment, ClassValues& values) {
    const std::size_t equals = assignment.find('=');
    const std::string key = assignment.substr(0, equals);
    const auto settings = class_settings();
    const auto setting = std::ranges::find(settings, key, &ClassSetting::key);
    if (setting == settings.end()) {
        std::vector<std::string_view> keys;
        for (const ClassSetting& s : settings) keys.push_back(s.key);
        const std::string hint = io::did_you_mean(key, keys);
        throw io::Error(io::ExitCode::usage, fmt::format("--set '{}': expected one of {}{}", assignment,
                                                         io::quoted_list(keys), hint.empty() ? "" : "; " + hint));
    }
    const auto number = equals == std::string::npos ? std::nullopt : number_in(assignment.substr(equals + 1));
    if (!number || *number < setting->min || *number > setting->max) {
        throw io::Error(io::ExitCode::usage, fmt::format("--set '{}': expected a number from {} to {}", assignment,
                                                         number_text(setting->min), number_text(setting->max)));
    }
    values.*setting->value = *number * setting->to_si;
}

const Recipe* suspension(const std::string& word, std::string_view by_class, bool steered) {
    const Recipe* recipe = find_recipe(word.empty() ? by_class : std::string_view(word));
    if (steered && !can_be_steered(*recipe)) {
        std::vector<std::string_view> steerable;
        for (const Recipe* other : recipes()) {
            if (can_be_steered(*other)) steerable.push_back(other->keyword);
        }
        throw io::Error(io::ExitCode::usage, fmt::format("--front '{}': expected a suspension that can be steered, {}",
                                                         word, io::quoted_list(steerable)));
    }
    return recipe;
}

io::ExitCode new_vehicle(const NewOptions& options) {
    if (options.list) return print_list(), io::ExitCode::ok;
    if (options.file.empty()) throw io::Error(io::ExitCode::usage, "expected a file to write, or --list");
    const std::filesystem::path path(options.file);
    if (path.extension() != ".toml") {
        throw io::Error(io::ExitCode::usage, options.file + ": expected a name that ends in .toml");
    }
    if (std::filesystem::exists(path)) {
        throw io::Error(io::ExitCode::usage, options.file + ": is there already, and stays: expected a new name");
    }
    const auto& like = *std::ranges::find(vehicle_classes(), options.like, &VehicleClass::name);
    TemplateRequest request{.name = options.name.empty() ? path.stem().string() : options.name,
                            .front = suspension(options.front, like.front, true),
                            .rear = suspension(options.rear, like.rear, false),
                            .like = &like,
                            .drive = like.drive,
                            .values = like.values};
    if (!options.drive.empty()) {
        request.drive = static_cast<DrivenWheels>(std::ranges::find(drive_words, options.drive) - drive_words.begin());
    }
    for (const std::string& assignment : options.set) set_value(assignment, request.values);
    write_file(options.file, vehicle_template(request));
    tell_written(false, options.file);
    fmt::print("next: hamilcar check {0}\n      hamilcar run --maneuver step_steer --vehicle {0}\n", options.file);
    return io::ExitCode::ok;
}

template <class Range, class Member>
std::vector<std::string> words_of(const Range& range, Member member) {
    std::vector<std::string> words;
    for (const auto& item : range) words.emplace_back(std::invoke(member, item));
    return words;
}

}  // namespace

void add_new(CommandList& list) {
    auto [command, o] =
        list.add<NewOptions>("new", "write a commented vehicle file to start from, which runs", new_vehicle);
    const auto keyword = [](const Recipe* recipe) { return recipe->keyword; };
    command.add("file", o.file, "vehicle file to write (TOML)");
    command.add("--like", o.like, "class of vehicle").one_of(words_of(vehicle_classes(), &VehicleClass::name));
    command.add("--front", o.front, "front suspension [the class's]").one_of(words_of(recipes(), keyword));
    command.add("--rear", o.rear, "rear suspension [the class's]").one_of(words_of(recipes(), keyword));
    command.add("--drive", o.drive, "driven wheels [the class's]").one_of({"front", "rear", "all"});
    command.add("--name", o.name, "the vehicle's name [the file's]");
    command.add("--set", o.set, "a value of the class, KEY=VALUE; may be repeated");
    command.add("--list", o.list, "list classes, suspensions and values");
}

}  // namespace hamilcar::cli
