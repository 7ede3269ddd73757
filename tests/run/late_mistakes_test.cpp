// Mistakes that are found when a scenario meets its vehicle are told with the place of the key, though the files are gone by then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/simulation.hpp"
#include "io/files.hpp"

namespace hamilcar {
namespace {

using io::repository_path;
using io::TemporaryFolder;

// A scenario that was read from a file which is not there any more; `name` is its path.
ScenarioDescription read_and_remove(const std::string& text, std::string& name) {
    const TemporaryFolder folder;
    name = folder.write("scenario.toml", "name = 'x'\nvehicle = 'v.toml'\nduration_s = 1\n" + text);
    return io::read_scenario(name);
}

void expect_place(const std::string& text, const std::string& line_and_column, const std::string& key) {
    const VehicleDescription vehicle = io::read_vehicle(repository_path("vehicles/bmw_323i.toml"));
    std::string name;
    const ScenarioDescription scenario = read_and_remove(text, name);
    try {
        select_channels(all_channels(vehicle), scenario.output.channels, scenario.places);
        const Simulation simulation(vehicle, scenario);
        ADD_FAILURE() << "took\n" << text;
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::bad_file);
        EXPECT_THAT(error.what(), testing::StartsWith(name + ":" + line_and_column + ": key '" + key + "'"));
    }
}

TEST(LateMistakes, AreToldWithThePlaceOfTheirKey) {
    expect_place("\n[inputs.rack]\ndisplacement_m = 3\n", "5:1", "inputs.rack");
    expect_place("inputs.gear.number = 77\n", "4:8", "inputs.gear");
    expect_place("[output]\nchannels = ['nonesuch']\n", "5:12", "output.channels");
    expect_place("[driver.gear]\nchoice = 'automatic'\nfirst = 20\n", "6:9", "driver.gear.first");
}

TEST(LateMistakes, OfTheCarNameItsFile) {
    const std::string path = repository_path("vehicles/bmw_323i.toml");
    VehicleDescription vehicle = io::read_vehicle(path);
    for (SuspensionDescription& suspension : vehicle.suspensions) suspension.springs.clear();
    ScenarioDescription scenario;
    scenario.duration = 1;
    try {
        const Simulation simulation(vehicle, scenario);
        ADD_FAILURE() << "a car without springs stands";
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::numerical);
        EXPECT_THAT(error.what(), testing::StartsWith(path + ": "));
    }
}

TEST(LateMistakes, OfADescriptionFromNoFileNameItsKeyAlone) {
    const VehicleDescription vehicle = io::read_vehicle(repository_path("vehicles/bmw_323i.toml"));
    ScenarioDescription scenario;
    scenario.duration = 1;
    scenario.solver.integrator = "nonesuch";
    try {
        const Simulation simulation(vehicle, scenario);
        ADD_FAILURE() << "took an integrator that there is not";
    } catch (const io::Error& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("key 'solver.integrator' = \"nonesuch\""));
    }
}

}  // namespace
}  // namespace hamilcar
