// The shipped vehicles in an independent engine: Simbody builds trees, cut joints, dual wheels, live axles and trailers
// from the same description. Driven, steered and braked for 3 s, chassis and trailers take the same path within 2e-9 m.
// Both engines take steps of 1 ms, so that a kink of a force law costs both the same.
//
// The engine knows linear tires, plane roads and torques at the wheels: the 323i comes on the paper's tire, alone in
// simbody_test.cpp, with its digressive dampers here, and no engine or motor runs.
#include <gtest/gtest.h>

#include "oracle/side_by_side.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

constexpr double path_tolerance = 2e-9;  // [m]

struct Drive {
    const char* vehicle;
    double speed;   // [m/s]
    double rack;    // to either side [m]
    double torque;  // [N m]
    RoadDescription road{};
};

// So that a failure is reported with the vehicle's name.
void PrintTo(const Drive& drive, std::ostream* to) {
    *to << drive.vehicle;
}

VehicleDescription shipped(const std::string& name) {
    VehicleDescription car = io::read_vehicle(test::source_path("vehicles/" + name + ".toml"));
    car.brakes = {}, car.controllers.clear();  // which the other engine has not: its torques follow the pedal at once
    return car;
}

ScenarioDescription scenario_of(const Drive& drive) {
    ScenarioDescription s = test::scenario(3, drive.speed);
    s.solver.integrator = "rk4";
    s.solver.step = 1e-3;
    s.road = drive.road;
    s.drive = test::table({0, 0.3, 1.2, 1.5}, {0, drive.torque, drive.torque, 0});
    s.brake = test::table({1.8, 2.2}, {0, 0.15});
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0.2, 0.8, 1.6, 2.4}, {0, drive.rack, -drive.rack, 0.5 * drive.rack});
    return s;
}

void expect_same_path(const VehicleDescription& vehicle, const Drive& drive) {
    oracle::SideBySide both(vehicle, scenario_of(drive));
    const double gap = both.largest_gap();
    testing::Test::RecordProperty("largest_path_gap_m", std::to_string(gap));
    std::printf("largest gap: %.2e m\n", gap);
    EXPECT_LT(gap, path_tolerance);
    EXPECT_GT(std::abs(both.simulation.sample().velocity.chassis[5]), 0.01) << "a car that does not turn shows little";
}

class SimbodyVehicles : public testing::TestWithParam<Drive> {};

TEST_P(SimbodyVehicles, TakeTheSamePath) {
    expect_same_path(shipped(GetParam().vehicle), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shipped, SimbodyVehicles,
                         testing::Values(Drive{"bmw_e21_320i", 15, 0.005, 500}, Drive{"bmw_e90_330i", 15, 0.005, 600},
                                         Drive{"hatchback", 15, 0.005, 500},
                                         Drive{"electric_hatchback", 15, 0.005, 600}, Drive{"formula", 15, 0.005, 300},
                                         Drive{"pickup", 15, 0.005, 800},
                                         Drive{"offroader", 12, 0.008, 800, {.grade = 0.05, .bank = 0.03}},
                                         Drive{"truck_semitrailer", 12, 0.015, 6000}),
                         [](const auto& drive) { return std::string(drive.param.vehicle); });

TEST(SimbodyDampers, TakeTheSamePathWithAKnee) {
    VehicleDescription car = test::paper_car();
    const VehicleDescription digressive = shipped("bmw_323i_digressive");
    for (std::size_t i = 0; i < car.suspensions.size(); ++i)
        car.suspensions[i].dampers[0].damper = digressive.suspensions[i].dampers[0].damper;
    ASSERT_EQ(car.suspensions[0].dampers[0].damper.velocity.size(), 5u);
    expect_same_path(car, {"bmw_323i_digressive", 15, 0.005, 500});
}

const Drive truck_drive{"truck_semitrailer", 12, 0.015, 6000, {.bank = 0.01}};

TEST(SimbodyTrailers, TakeTheSamePathOnABall) {
    VehicleDescription truck = shipped("truck_semitrailer");
    truck.trailers[0].hitch = Hitch::ball;
    truck.trailers[0].yaw_damping = 2e4;
    expect_same_path(truck, truck_drive);
}

Point behind(Point point, double distance) {
    point[0] -= distance;
    return point;
}

// A copy of the last trailer with its axles, that much further back and pulled by it.
void append_trailer(VehicleDescription& truck, double distance) {
    const std::size_t last = truck.trailers.size();
    TrailerDescription trailer = truck.trailers.back();
    trailer.name += "_again";
    trailer.tow = last;
    trailer.hitch_point = behind(trailer.hitch_point, distance);
    trailer.chassis.center_of_mass = behind(trailer.chassis.center_of_mass, distance);
    truck.trailers.push_back(trailer);
    const std::vector<SuspensionDescription> as_they_were = truck.suspensions;
    for (SuspensionDescription suspension : as_they_were) {
        if (suspension.unit != last) continue;
        suspension.unit = last + 1;
        for (auto& joint : suspension.linkage.joints) joint.point = behind(joint.point, distance);
        for (auto& cut : suspension.linkage.cuts)
            cut.tip = behind(cut.tip, distance), cut.foot = behind(cut.foot, distance);
        for (auto& body : suspension.bodies) body.body.center_of_mass = behind(body.body.center_of_mass, distance);
        for (auto& wheel : suspension.wheels) wheel.wheel.center = behind(wheel.wheel.center, distance);
        const auto move_line = [&](auto& element) {
            element.line.on_part = behind(element.line.on_part, distance);
            element.line.on_base = behind(element.line.on_base, distance);
        };
        for (auto& spring : suspension.springs) move_line(spring);
        for (auto& damper : suspension.dampers) move_line(damper);
        truck.suspensions.push_back(suspension);
    }
}

TEST(SimbodyTrailers, TakeTheSamePathOneBehindTheOther) {
    VehicleDescription train = shipped("truck_semitrailer");
    append_trailer(train, 10.5);
    train.trailers.back().yaw_damping = 5e3;
    expect_same_path(train, truck_drive);
}

TEST(SimbodyBodies, WithoutMassAtTheEndOfATreeAreRefused) {
    VehicleDescription car = shipped("formula");
    ASSERT_EQ(car.suspensions[0].linkage.joints.back().part, "rocker");
    std::erase_if(car.suspensions[0].bodies,
                  [&](const auto& body) { return body.part == car.suspensions[0].linkage.joints.size(); });
    EXPECT_THROW(oracle::SimbodyCar(car, {}), std::invalid_argument);
}

}  // namespace
}  // namespace hamilcar
