// Mistakes in vehicles that are composed of parts: linkages with too few or too many cuts, parts that do not exist, trailers
// that hang on nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "files.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

std::string text_of(const std::string& vehicle) {
    return read_file(repository_path("vehicles/" + vehicle + ".toml"));
}

void expect_told(const std::string& vehicle, const BadInput& bad) {
    SCOPED_TRACE(bad.name);
    expect_refused(text_of(vehicle), bad, [](const std::string& path) { read_vehicle(path); });
}

TEST(ComposedMistakes, PartsThatDoNotExist) {
    expect_told("formula", {"SpringOnNothing",
                            "on = \"rocker\"",
                            "on = \"roker\"",
                            "\"roker\"",
                            {"expected one of 'carrier', 'lower_arm', 'rocker', 'upper_arm' or 'push_rod'",
                             "did you mean 'rocker'?"}});
    expect_told("formula",
                {"RodOnNothing", "rod_on = \"", "rod_on = \"x", "\"x", {"expected one of 'lower_arm' or 'carrier'"}});
}

TEST(ComposedMistakes, Hardpoints) {
    expect_told("pickup", {"Missing", "seat_m", "seet_m", "seet_m", {"did you mean 'seat_m'"}});
    expect_told(
        "offroader",
        {"KeyOfAnotherKind", "panhard_body_m", "watt_pivot_m", "[axle.hardpoints]", {"panhard_body_m' is missing"}});
}

TEST(ComposedMistakes, Trailers) {
    expect_told("truck_semitrailer", {"Hitch",
                                      "\"fifth_wheel\"",
                                      "\"fith_wheel\"",
                                      "\"fith_wheel\"",
                                      {"one of 'ball' or 'fifth_wheel'; did you mean 'fifth_wheel'?"}});
    expect_told("truck_semitrailer", {"NameTwice",
                                      "name = \"trailer_1\"",
                                      "name = \"rear_1\"",
                                      "\"rear_1\"\nsuspension = \"leaf_axle\"\ntire = \"truck\"\n\n[trailer",
                                      {"no other axle or trailer has"}});
}

// An arm, a carrier that is free on a ball, and links in between: right with three cuts.
constexpr const char* own_linkage = R"(
name = "own"
[chassis]
mass_kg = 800
center_of_mass_m = [0, 0, 0.5]
inertia_kg_m2 = [300, 1000, 1100]
[tire.road]
model = "spring"
radius_m = 0.3
rolling_radius_m = 0.29
vertical_stiffness_N_per_m = 200e3
[[axle]]
name = "front"
suspension = "linkage"
tire = "road"
carrier_part = "carrier"
[[axle.joint]]
kind = "revolute"
part = "arm"
point_m = [0, 0.3, 0.2]
axis = [1, 0, 0]
[[axle.joint]]
kind = "spherical"
part = "carrier"
parent = "arm"
point_m = [0, 0.68, 0.18]
[[axle.cut]]
kind = "revolute_spherical"
name = "upper arm"
part = "carrier"
tip_m = [0, 0.64, 0.5]
foot_m = [0, 0.4, 0.48]
axis = [1, 0, 0]
[[axle.cut]]
kind = "distance"
name = "toe link"
part = "carrier"
tip_m = [0.14, 0.68, 0.24]
foot_m = [0.13, 0.33, 0.25]
[axle.carrier]
mass_kg = 30
center_of_mass_m = [0, 0.7, 0.3]
inertia_kg_m2 = [0.8, 0.5, 0.6]
[axle.wheel]
center_m = [0, 0.72, 0.29]
camber_deg = 0
toe_in_deg = 0
spin_inertia_kg_m2 = 0.8
[axle.spring]
rate_N_per_m = 30e3
force_at_design_N = 3000
on = "arm"
at_m = [0, 0.6, 0.19]
body_m = [0, 0.5, 0.6]
)";

void expect_own(const BadInput& bad) {
    SCOPED_TRACE(bad.name);
    expect_refused(own_linkage, bad, [](const std::string& path) { read_vehicle(path); });
}

TEST(OwnLinkage, IsReadOnBothSides) {
    const TemporaryFolder folder;
    const VehicleDescription car = read_vehicle(folder.write("own.toml", own_linkage));
    ASSERT_EQ(car.suspensions.size(), 2u);
    EXPECT_EQ(car.suspensions[1].name, "front_right");
    EXPECT_EQ(car.suspensions[1].linkage.cuts[0].tip[1], -0.64);
    EXPECT_EQ(car.suspensions[0].linkage.independent.size(), 1u);
}

TEST(OwnLinkage, TakesSpringsAlongJointsAndBetweenAnyParts) {
    const std::string more =
        "\n[[axle.further_spring]]\nalong = \"arm\"\nrate_N_m_per_rad = 2000\nmoment_at_design_N_m = 300\n"
        "[[axle.further_spring]]\nto = \"arm\"\nat_m = [0, 0.66, 0.4]\nbody_m = [0, 0.5, 0.2]\n"
        "rate_N_per_m = 1e3\nforce_at_design_N = 10\n";
    const TemporaryFolder folder;
    const VehicleDescription car = read_vehicle(folder.write("own.toml", own_linkage + more));
    const std::vector<SuspensionSpringDescription>&left = car.suspensions[0].springs,
          &right = car.suspensions[1].springs;
    ASSERT_EQ(left.size(), 3u);
    ASSERT_EQ(right.size(), 3u);
    EXPECT_EQ(left[1].line.coordinate, 0);
    EXPECT_EQ(left[1].spring.force_at_design, 300);
    EXPECT_EQ(right[1].spring.force_at_design, -300) << "a mirrored rotation turns the other way";
    EXPECT_EQ(left[2].line.base, 1u);
    EXPECT_EQ(left[2].name, "front_left_3");
    EXPECT_EQ(right[2].line.on_base[1], -0.5);
    EXPECT_EQ(right[1].name, "front_right_2");
}

TEST(OwnLinkage, LacksCutsAndSaysWhichPartIsLoose) {
    const std::string toe =
        "[[axle.cut]]\nkind = \"distance\"\nname = \"toe link\"\npart = \"carrier\"\n"
        "tip_m = [0.14, 0.68, 0.24]\nfoot_m = [0.13, 0.33, 0.25]\n";
    expect_own({"NoToeLink", toe, "", "[[axle.joint]]", {"1 cut equation(s) too few", "'carrier' is loose"}});
}

TEST(OwnLinkage, HasTooManyCutsOrTheSameTwice) {
    const std::string toe = "[[axle.cut]]\nkind = \"distance\"\nname = \"toe link\"";
    const std::string again =
        "[[axle.cut]]\nkind = \"distance\"\nname = \"second link\"\npart = \"carrier\"\n"
        "tip_m = [0.14, 0.68, 0.24]\nfoot_m = [0.13, 0.33, 0.25]\n";
    expect_own(
        {"SameTwice", toe, again + toe, "[[axle.joint]]", {"redundant cut joints", "'second link'", "'toe link'"}});
    const std::string holding =
        "[[axle.cut]]\nkind = \"distance\"\nname = \"prop\"\npart = \"carrier\"\n"
        "tip_m = [0.0, 0.7, 0.3]\nfoot_m = [0.1, 0.5, 0.9]\n";
    expect_own({"Held", toe, holding + toe, "[[axle.joint]]", {"1 cut equation(s) too many", "cannot move"}});
}

TEST(OwnLinkage, PartsAndEnds) {
    expect_own({"UnknownParent", "parent = \"arm\"", "parent = \"amr\"", "\"amr\"", {"one of 'chassis' or 'arm'"}});
    expect_own({"NoSuchCarrier",
                "carrier_part = \"carrier\"",
                "carrier_part = \"carier\"",
                "\"carier\"",
                {"did you mean 'carrier'?"}});
    expect_own({"TakenName",
                "part = \"arm\"",
                "part = \"spring\"",
                "\"spring\"\npoint_m",
                {"a name that no other table of an axle has"}});
    expect_own({"NoLength",
                "foot_m = [0.13, 0.33, 0.25]",
                "foot_m = [0.14, 0.68, 0.24]",
                "[0.14, 0.68, 0.24]\n[axle.carrier]",
                {"a point apart from 'tip_m'"}});
}

// Names are keys of tables and beginnings of channels.
TEST(OwnLinkage, HasNamesThatNothingElseHas) {
    expect_own(
        {"CutAsTable", "name = \"toe link\"", "name = \"Brake\"", "\"Brake\"", {"no other table of an axle has"}});
    expect_own({"CutAsPart", "name = \"toe link\"", "name = \"Arm\"", "\"Arm\"", {"no other part or cut has"}});
    expect_own({"PartAsChassis", "part = \"arm\"", "part = \"chassis\"", "\"chassis\"", {"no other part or cut has"}});
    expect_own({"PartAsPart",
                "part = \"carrier\"\nparent",
                "part = \"ARM\"\nparent",
                "\"ARM\"",
                {"a name that no other part or cut has"}});
    expect_own({"CutAsCut",
                "name = \"toe link\"",
                "name = \"upper_arm\"",
                "\"upper_arm\"",
                {"a name that no other part or cut has, however it is spelled"}});
}

TEST(OwnLinkage, SetsAnAngleByOneCutForEachWheel) {
    const std::string sets = "name = \"toe link\"", both = sets + "\nsets = \"toe\"";
    const TemporaryFolder folder;
    const VehicleDescription car = read_vehicle(
        folder.write("sets.toml", changed(own_linkage, sets, both) + "[axle.alignment]\ntoe_in_deg = 1.5\n"));
    for (const SuspensionDescription& side : car.suspensions) {
        const Point& axis = side.wheels[0].wheel.spin_axis;
        EXPECT_NEAR(std::abs(std::atan2(axis[0], axis[1])), 1.5 * std::numbers::pi / 180, 1e-9);
    }
    const std::string second =
        "[[axle.cut]]\nkind = \"distance\"\nname = \"prop\"\npart = \"carrier\"\nsets = \"toe\"\n"
        "tip_m = [0.0, 0.7, 0.3]\nfoot_m = [0.1, 0.5, 0.9]\n[[axle.cut]]\nkind = \"distance\"\n";
    expect_own({"Two",
                "[[axle.cut]]\nkind = \"distance\"\n" + sets,
                second + both,
                "[[axle.cut]]",
                {"as many that set toe as the linkage has wheels, or none"}});
    expect_own({"Plane",
                "axis = [1, 0, 0]\n[[axle.cut]]",
                "axis = [1, 0, 0]\nsets = \"camber\"\n[[axle.cut]]",
                "\"camber\"",
                {".sets' = \"camber\"", "of kind 'distance'"}});
}

// A part's name has to mean the same on both sides.
TEST(OwnLinkage, HasTheSameJointsOnBothSides) {
    const std::string right =
        "[[axle.right.joint]]\nkind = \"revolute\"\npart = \"lever\"\npoint_m = [0, 0.3, 0.2]\naxis = [1, 0, 0]\n"
        "[[axle.right.joint]]\nkind = \"spherical\"\npart = \"carrier\"\nparent = \"lever\"\npoint_m = [0, 0.68, "
        "0.18]\n";
    const TemporaryFolder folder;
    const auto read = [&](const std::string& joints) {
        return read_vehicle(folder.write("r.toml", own_linkage + joints));
    };
    expect_error([&] { read(right + "[axle.right.spring]\non = \"lever\"\n"); }, ExitCode::bad_file,
                 {"'axle[front].right'", "the joints and cuts of the left side, in their order"});
    std::string same = right;
    for (std::size_t at = same.find("lever"); at != std::string::npos; at = same.find("lever"))
        same.replace(at, 5, "arm");
    same.replace(same.find("0.3, 0.2"), 8, "0.31, 0.2");
    const VehicleDescription car = read(same);
    EXPECT_EQ(car.suspensions[0].linkage.joints[0].point[1], 0.3);
    EXPECT_EQ(car.suspensions[1].linkage.joints[0].point[1], -0.31);
}

}  // namespace
}  // namespace hamilcar::io
