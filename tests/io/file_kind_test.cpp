// Who gives a file of another kind is told what it is and what it is for.
#include "hamilcar/io/file_kind.hpp"

#include <gtest/gtest.h>

#include "files.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

TEST(FileKind, IsKnownFromWhatStandsInTheFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(kind_of_file(repository_path("vehicles/bmw_323i.toml")), FileKind::vehicle);
    EXPECT_EQ(kind_of_file(repository_path("scenarios/paper.toml")), FileKind::scenario);
    EXPECT_EQ(kind_of_file(repository_path("studies/front_bar.toml")), FileKind::study);
    EXPECT_EQ(kind_of_file(repository_path("vehicles/tires/pacejka_205_60_r15.tir")), FileKind::tire);
    EXPECT_EQ(kind_of_file(repository_path("vehicles")), FileKind::folder);
    EXPECT_EQ(kind_of_file(repository_path("README.md")), FileKind::other);
    EXPECT_EQ(kind_of_file(folder / "nothing"), FileKind::other);
    EXPECT_EQ(kind_of_file(folder.write("a", "CDF\x02 and so on")), FileKind::results);
    EXPECT_EQ(kind_of_file(folder.write("b", "$CT\n a comment\n$ROAD_CRG\n$\n")), FileKind::measured_road);
    EXPECT_EQ(kind_of_file(folder.write("c", "{\"maneuver\": \"cleat\"}")), FileKind::outcome);
}

TEST(FileKind, ThatIsNotTheExpectedOneIsTold) {
    const std::string car = repository_path("vehicles/bmw_323i.toml"), run = repository_path("scenarios/paper.toml"),
                      tire = repository_path("vehicles/tires/pacejka_205_60_r15.tir");
    expect_error([&] { read_vehicle(run); }, ExitCode::bad_file,
                 {run + ": this is a scenario, expected a vehicle; 'hamilcar run' drives it"});
    expect_error([&] { read_scenario(repository_path("studies/front_bar.toml")); }, ExitCode::bad_file,
                 {"this is a study, expected a scenario; 'hamilcar study'"});
    expect_error([&] { read_scenario(car); }, ExitCode::bad_file,
                 {car + ": this is a vehicle, expected a scenario; 'hamilcar check'"});
    expect_error([&] { read_vehicle(tire); }, ExitCode::bad_file,
                 {tire + ": this is a tire, expected a vehicle; 'hamilcar tire'"});
    expect_error([&] { read_vehicle(repository_path("vehicles")); }, ExitCode::input_output,
                 {"this is a folder, expected a vehicle"});
}

// A mistake in a file of the right kind stays what it is.
TEST(FileKind, DoesNotHideAMistake) {
    const TemporaryFolder folder;
    const std::string path = folder.write("car.toml", changed(shipped_car_text(), "mass_kg = 1002.0", "mass_kg = -3"));
    expect_error([&] { read_vehicle(path); }, ExitCode::bad_file, {"key 'chassis.mass_kg' = -3"});
}

}  // namespace
}  // namespace hamilcar::io
