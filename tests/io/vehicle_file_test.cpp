// The shipped car reads to the numbers of its data sheet; optional parts, bases and unreadable files behave.
#include "hamilcar/io/vehicle_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files.hpp"
#include "support/hardpoints.hpp"

namespace hamilcar::io {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

VehicleDescription shipped_car() {
    return read_vehicle(repository_path("vehicles/bmw_323i.toml"));
}

VehicleDescription paper_car() {
    return read_vehicle(repository_path("vehicles/bmw_323i_paper.toml"));
}

void expect_point(const Point& actual, const Point& expected, double tolerance = 0) {
    EXPECT_THAT(actual, Pointwise(DoubleNear(tolerance), expected));
}

TEST(ShippedCar, ChassisIsThatOfTheDataSheet) {
    const VehicleDescription car = shipped_car();
    EXPECT_EQ(car.name, "BMW 323i (E30)");
    EXPECT_EQ(car.chassis.mass, 1002.0);
    expect_point(car.chassis.center_of_mass, {-1.1524, 0, 0.6137});
    expect_point(car.chassis.inertia, {215.1, 1624.6, 1573.9});
    expect_point(car.chassis.products, {0, 0, 0});
    EXPECT_NEAR(car.aerodynamics.drag_area, 0.703, 1e-12);
    EXPECT_EQ(car.aerodynamics.air_density, 1.2);
    EXPECT_EQ(car.steering.rack_per_revolution, 0.0365);
    EXPECT_EQ(car.steering.rack_travel, 0.073);
    EXPECT_EQ(car.gravity, 9.80665);
    double mass = car.chassis.mass, driven = 0;
    for (const auto& corner : car.suspensions)
        mass += corner.bodies[0].body.mass, driven += corner.wheels[0].drive_share;
    EXPECT_EQ(mass, 1150.0);
    EXPECT_EQ(driven, 1.0);
}

TEST(ShippedCar, CornersAreInOrder) {
    std::vector<std::string> names;
    for (const auto& corner : paper_car().suspensions) names.push_back(corner.name);
    EXPECT_THAT(names, ElementsAre("front_left", "front_right", "rear_left", "rear_right"));
}

TEST(ShippedCar, FrontLeftIsThatOfTheDataSheet) {
    const SuspensionDescription corner = paper_car().suspensions[0];
    const test::MacPhersonPoints strut = test::strut_points(corner);
    expect_point(strut.strut_top, {-0.1051, 0.4962, 0.7950});
    expect_point(strut.slide_point, {-0.0240, 0.6013, 0.2800});
    expect_point(strut.arm_front, {0, 0.3180, 0.1886});
    expect_point(strut.arm_rear, {-0.2950, 0.3350, 0.1886});
    expect_point(strut.ball_joint, {-0.0060, 0.6525, 0.1650});
    expect_point(strut.rack_end, {0.1069, 0.3247, 0.2132});
    expect_point(strut.tie_rod_outer, {0.1115, 0.6969, 0.1900});
    expect_point(strut.rack_axis, {0, 1, 0});
    EXPECT_FALSE(strut.arm_length || strut.tie_rod_length);
    EXPECT_EQ(corner.bodies[0].body.mass, 35.0);
    expect_point(corner.bodies[0].body.center_of_mass, {-0.01, 0.6601, 0.31});
    expect_point(corner.wheels[0].wheel.center, {0, 0.7001, 0.28});
    expect_point(corner.wheels[0].wheel.spin_axis, {0.002705, 0.999924, 0.012042}, 1e-6);  // printed with six digits
    EXPECT_EQ(corner.springs[0].spring.rate, 26200.0);
    EXPECT_EQ(corner.springs[0].spring.force_at_design, 2951.0);
    EXPECT_THAT(corner.dampers[0].damper.velocity, ElementsAre(-1, 1));
    EXPECT_THAT(corner.dampers[0].damper.force, ElementsAre(-2093, 2093));
    EXPECT_EQ(corner.wheels[0].bump.gap, 0.060);
    EXPECT_EQ(corner.wheels[0].bump.progression, 1e6);
    EXPECT_EQ(corner.wheels[0].rebound.rate, 100e3);
    EXPECT_EQ(corner.wheels[0].brake.max_torque, 1650.0);
    EXPECT_EQ(corner.wheels[0].brake.valve_command, 1) << "no valve in front";
    EXPECT_EQ(paper_car().suspensions[2].wheels[0].brake.valve_command, 0.267);
    EXPECT_EQ(paper_car().suspensions[2].wheels[0].brake.valve_slope, 0.21);
    EXPECT_EQ(corner.wheels[0].drive_share, 0.0);
}

TEST(ShippedCar, RearLeftIsThatOfTheDataSheet) {
    const SuspensionDescription corner = paper_car().suspensions[2];
    const test::SemiTrailingArmPoints arm = test::arm_points(corner);
    expect_point(arm.inner_bush, {-2.2770, 0.1753, 0.2800});
    expect_point(arm.outer_bush, {-2.1735, 0.5617, 0.2800});
    expect_point(arm.spring_arm, {-2.4924, 0.480, 0.235});
    expect_point(arm.spring_body, {-2.480, 0.480, 0.470});
    expect_point(arm.damper_arm, {-2.640, 0.545, 0.240});
    expect_point(arm.damper_body, {-2.600, 0.530, 0.700});
    expect_point(corner.bodies[0].body.inertia, {0.85, 0.40, 1.05});
    expect_point(corner.wheels[0].wheel.spin_axis, {0.002705, 0.999530, 0.030539}, 2e-6);
    EXPECT_EQ(corner.springs[0].spring.rate, 40700.0);
    EXPECT_EQ(corner.wheels[0].drive_share, 0.5);
}

TEST(ShippedCar, TireHasTheCorneringStiffnessOfItsSource) {
    const auto tire = std::get<LinearTireDescription>(paper_car().suspensions[0].wheels[0].tire);
    const auto newton_per_degree = [&](double load) {
        const double x = load / tire.cornering_load;
        return 2 * tire.cornering_reference * x / (1 + x * x) * M_PI / 180;
    };
    EXPECT_NEAR(newton_per_degree(3059), 664, 0.5);
    EXPECT_NEAR(newton_per_degree(2581), 579, 0.5);
    EXPECT_EQ(tire.radius, 0.2948);
    EXPECT_EQ(tire.rolling_radius, 0.288);
    EXPECT_EQ(tire.relaxation_lateral, 0.30);
}

TEST(ShippedCar, AntiRollBarsCoupleTheirAxle) {
    const auto bars = paper_car().anti_roll_bars;
    ASSERT_EQ(bars.size(), 2u);
    EXPECT_EQ(bars[0].left, 0u);
    EXPECT_EQ(bars[0].right, 1u);
    EXPECT_EQ(bars[0].rate, 3493.0);
    EXPECT_EQ(bars[1].left, 2u);
    EXPECT_EQ(bars[1].right, 3u);
    EXPECT_EQ(bars[1].rate, 1320.0);
}

TEST(MirroredCorner, IsTheLeftOneSeenInAMirror) {
    const TemporaryFolder folder;
    const std::string text = changed(changed(shipped_car_text(), "inertia_kg_m2 = [0.90, 0.38, 0.62]",
                                             "inertia_kg_m2 = [0.90, 0.38, 0.62]\nproducts_kg_m2 = [0.01, 0.02, 0.03]"),
                                     "rack_axis = [0.0, 1.0, 0.0]", "rack_axis = [0.0, 0.6, 0.8]");
    const auto car = read_vehicle(folder.write("car.toml", text));
    const SuspensionDescription &left = car.suspensions[0], &right = car.suspensions[1];
    const test::MacPhersonPoints strut = test::strut_points(right);
    expect_point(strut.ball_joint, {-0.0060, -0.6525, 0.1650});
    expect_point(strut.rack_end, {0.1069, -0.3247, 0.2132});
    expect_point(strut.rack_axis, {0, 0.6, 0.8}, 1e-15);
    expect_point(right.bodies[0].body.center_of_mass, {-0.01, -0.6601, 0.31});
    expect_point(right.bodies[0].body.inertia, left.bodies[0].body.inertia);
    expect_point(right.bodies[0].body.products, {-0.01, -0.02, 0.03});
    expect_point(right.wheels[0].wheel.center, {0, -0.7001, 0.28});
    // Camber leans the other wheel the other way, toe-in turns it the other way, and both still spin about +y.
    const Point axis = left.wheels[0].wheel.spin_axis;
    expect_point(right.wheels[0].wheel.spin_axis, {-axis[0], axis[1], -axis[2]});
    EXPECT_GT(right.wheels[0].wheel.spin_axis[1], 0);
}

// The shipped car's file with what the air does across left out.
std::string without_side_wind(std::string text) {
    for (const std::string key : {"side_force_coefficient", "yaw_moment_coefficient", "reference_length_m"}) {
        text = changed(text, "\n" + key, "\n# " + key);
    }
    return text;
}

TEST(VehicleFile, OtherWaysToSayTheSame) {
    const TemporaryFolder folder;
    std::string text = without_side_wind(shipped_car_text());
    text = changed(text, "camber_deg = -0.69", "spin_axis = [0.02705, 9.99924, 0.12042] # ");
    text = changed(text, "toe_in_deg = 0.155", "#");
    text = changed(text, "drag_coefficient = 0.38", "drag_area_m2 = 0.7");
    text = changed(text, "frontal_area_m2 = 1.85", "#");
    text = changed(text, "name = ", "gravity_m_per_s2 = 1.62\nname = ");
    const auto car = read_vehicle(folder.write("car.toml", text));
    expect_point(car.suspensions[0].wheels[0].wheel.spin_axis, {0.002705, 0.999924, 0.012042}, 1e-6);
    EXPECT_EQ(car.aerodynamics.drag_area, 0.7);
    EXPECT_EQ(car.gravity, 1.62);
}

TEST(VehicleFile, AirMayLiftPushAndTurn) {
    const TemporaryFolder folder;
    const std::string coefficients =
        changed(without_side_wind(shipped_car_text()), "frontal_area_m2 = 1.85",
                "lift_coefficient_front = 0.1\nlift_coefficient_rear = -0.2\nside_force_coefficient = 2\n"
                "yaw_moment_coefficient = 0.5\nreference_length_m = 3\nfrontal_area_m2 = 2 #");
    const AerodynamicsDescription air = read_vehicle(folder.write("car.toml", coefficients)).aerodynamics;
    EXPECT_DOUBLE_EQ(air.drag_area, 0.76);
    EXPECT_THAT(air.lift_area, ElementsAre(0.2, -0.4));
    EXPECT_EQ(air.side_area, 4);
    EXPECT_EQ(air.yaw_volume, 3);
    EXPECT_THAT(air.lift_place, ElementsAre(0, -2.57));  // the axles
    const std::string areas =
        "base = 'car.toml'\n[aerodynamics]\ndrag_area_m2 = 0.7\nlift_area_rear_m2 = 0.3\n"
        "side_force_area_m2 = 5\nyaw_moment_volume_m3 = 6\nlift_places_m = [0.5, -3]\n";
    const AerodynamicsDescription other = read_vehicle(folder.write("other.toml", areas)).aerodynamics;
    EXPECT_EQ(other.drag_area, 0.7);
    EXPECT_THAT(other.lift_area, ElementsAre(0, 0.3));
    EXPECT_EQ(other.side_area, 5);
    EXPECT_EQ(other.yaw_volume, 6);
    EXPECT_THAT(other.lift_place, ElementsAre(0.5, -3));
    const AerodynamicsDescription plain =
        read_vehicle(folder.write("plain.toml", without_side_wind(shipped_car_text()))).aerodynamics;
    EXPECT_THAT(plain.lift_area, ElementsAre(0, 0));
    EXPECT_FALSE(plain.side_area);
    EXPECT_EQ(plain.yaw_volume, 0);
}

TEST(VehicleFile, SteeringRatioMayVary) {
    const TemporaryFolder folder;
    const auto car = read_vehicle(
        folder.write("car.toml", changed(shipped_car_text(), "rack_m_per_revolution = 0.0365",
                                         "angle_deg = [0, 90, 360, 720]\nrack_m = [0, 0.01, 0.045, 0.1]")));
    EXPECT_DOUBLE_EQ(car.steering.rack_per_revolution, 0.04);
    EXPECT_THAT(car.steering.rack, ElementsAre(0, 0.01, 0.045, 0.1));
    ASSERT_EQ(car.steering.angle.size(), 4u);
    EXPECT_DOUBLE_EQ(car.steering.angle[1], M_PI / 2);
    EXPECT_EQ(car.steering.rack_travel, 0.073);
    EXPECT_TRUE(shipped_car().steering.angle.empty());
}

TEST(VehicleFile, AStrutMayBeUnsteered) {
    const TemporaryFolder folder;
    const auto car = read_vehicle(folder.write("car.toml", changed(shipped_car_text(), "rack_axis = [0.0, 1.0, 0.0]",
                                                                   "steered = false\nrack_axis = [0.0, 1.0, 0.0]")));
    const Point no_drive{};
    for (int i = 0; i < 2; ++i) EXPECT_EQ(test::strut_points(car.suspensions[i]).rack_axis, no_drive);
    EXPECT_NE(test::strut_points(paper_car().suspensions[0]).rack_axis, no_drive);
}

TEST(VehicleFile, OptionalPartsMayBeLeftOut) {
    const TemporaryFolder folder;
    std::string text = shipped_car_text();
    for (const std::string table : {"[aerodynamics]", "[steering]", "[steering.rack]", "[steering.column]",
                                    "[steering.assist]", "[axle.bump_stop]", "[axle.brake]", "[axle.anti_roll_bar]"}) {
        const auto from = text.find(table), to = text.find("\n[", from + 1);
        text.erase(from, to - from);
    }
    const auto car = read_vehicle(folder.write("car.toml", text));
    EXPECT_EQ(car.aerodynamics.drag_area, 0);
    EXPECT_EQ(car.steering.rack_travel, 0);
    EXPECT_EQ(car.suspensions[0].wheels[0].bump.rate, 0);
    EXPECT_EQ(car.suspensions[0].wheels[0].brake.max_torque, 0);
    EXPECT_EQ(car.anti_roll_bars.size(), 1u);
}

TEST(Base, OnlyTheOverriddenKeysDiffer) {
    const auto base = paper_car(), car = read_vehicle(repository_path("vehicles/bmw_323i_digressive.toml"));
    EXPECT_EQ(car.name, "BMW 323i (E30), digressive dampers");
    ASSERT_EQ(car.suspensions.size(), 4u);
    EXPECT_EQ(car.chassis.mass, base.chassis.mass);
    EXPECT_EQ(car.suspensions[3].springs[0].spring.rate, base.suspensions[3].springs[0].spring.rate);
    EXPECT_EQ(car.suspensions[3].name, "rear_right");
    const DamperDescription& front = car.suspensions[1].dampers[0].damper;
    EXPECT_THAT(front.velocity, ElementsAre(-1, -0.15, 0, 0.15, 1));
    EXPECT_DOUBLE_EQ(front.force[3] / front.velocity[3], 2826);
    EXPECT_DOUBLE_EQ(front.force[1] / front.velocity[1], 1360);
    EXPECT_NEAR((front.force[4] - front.force[3]) / 0.85, 2826 / 2., 1e-9);
    const DamperDescription& rear = car.suspensions[2].dampers[0].damper;
    EXPECT_DOUBLE_EQ(rear.force[3] / rear.velocity[3], 2007);
    EXPECT_DOUBLE_EQ(rear.force[1] / rear.velocity[1], 967);
    EXPECT_NEAR((rear.force[1] - rear.force[0]) / 0.85, 967 / 2., 1e-9);
}

TEST(Base, MistakesAreReportedInTheFileThatHoldsThem) {
    const TemporaryFolder folder;
    folder.write("base.toml", changed(shipped_car_text(), "mass_kg = 1002.0", "mass_kg = -1"));
    const auto top =
        folder.write("top.toml", "base = 'base.toml'\n[[axle]]\nname = 'rear'\nspring.rate_N_per_m = 'soft'\n");
    expect_error([&] { read_vehicle(top); }, ExitCode::bad_file, {folder / "base.toml:", "chassis.mass_kg' = -1"});
    folder.write("base.toml", shipped_car_text());
    expect_error([&] { read_vehicle(top); }, ExitCode::bad_file,
                 {folder / "top.toml:4:23: ", "'axle[rear].spring.rate_N_per_m' = 'soft'", "positive number [N/m]"});
}

TEST(Base, MustExistAndNotLeadBack) {
    const TemporaryFolder folder;
    const auto missing = folder.write("a.toml", "base = 'nonesuch.toml'");
    expect_error([&] { read_vehicle(missing); }, ExitCode::input_output,
                 {missing + ":1:8: key 'base' = 'nonesuch.toml'", folder / "nonesuch.toml", "No such file"});
    const auto circle = folder.write("b.toml", "base = 'c.toml'");
    folder.write("c.toml", "\nbase = './b.toml'");
    expect_error([&] { read_vehicle(circle); }, ExitCode::bad_file,
                 {folder / "c.toml:2:8: ", "'./b.toml'", "does not lead back"});
}

TEST(VehicleFile, UnreadablePathsAreInputOutputErrors) {
    const TemporaryFolder folder;
    expect_error([&] { read_vehicle(folder / "nonesuch.toml"); }, ExitCode::input_output,
                 {folder / "nonesuch.toml: cannot read: No such file or directory"});
    expect_error([&] { read_vehicle(folder / ""); }, ExitCode::input_output, {"this is a folder, expected a vehicle"});
}

TEST(VehicleFile, AnEmptyFileMissesItsTables) {
    const TemporaryFolder folder;
    const auto path = folder.write("empty.toml", "");
    expect_error([&] { read_vehicle(path); }, ExitCode::bad_file,
                 {"4 mistakes\n", path + ":1:1: key 'chassis' is missing",
                  "key 'axle' is missing: expected at least one [[axle]]"});
}

TEST(VehicleFile, ColumnsCountCharacters) {
    const TemporaryFolder folder;
    const auto path = folder.write("car.toml", "chassis = { \"µµ\" = 'ü', mass_kg = -1 }\n");
    expect_error([&] { read_vehicle(path); }, ExitCode::bad_file, {path + ":1:35: key 'chassis.mass_kg' = -1: "});
}

}  // namespace
}  // namespace hamilcar::io
