// Kinematics against the figures that the hardpoints were solved for, published (W2, W6, VDANL: sources in the vehicles'
// files) or derived, against textbook linkages, and against each other.
#include "hamilcar/analysis/kinematics.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "support/fleet.hpp"

namespace hamilcar {
namespace {

constexpr double degree = 180 / std::numbers::pi;
constexpr double foot = 0.3048;  // [m]

AxleReport axle(const VehicleDescription& car, const std::string& name) {
    for (const AxleReport& report : kinematics(car, SweepRange{})) {
        if (report.name == name) return report;
    }
    ADD_FAILURE() << name;
    return {};
}

// Per meter of bump, about design.
double gain(const AxleReport& report, double WheelFigures::*figure) {
    const std::vector<AxleFigures>& rows = report.sweeps[0].rows;
    const std::size_t middle = rows.size() / 2;
    return (rows[middle + 1].left.*figure - rows[middle - 1].left.*figure) /
           (rows[middle + 1].left.travel - rows[middle - 1].left.travel);
}

TEST(E30, FrontFiguresAreThoseItWasLaidOutFor) {
    const AxleReport front = axle(test::shipped("bmw_323i"), "front");
    const WheelFigures& f = front.design.left;
    EXPECT_NEAR(degree * f.caster, 8.94, 0.02);        // W6
    EXPECT_NEAR(degree * f.inclination, 13.94, 0.02);  // W6
    EXPECT_NEAR(f.scrub, 0.010, 2e-4);
    EXPECT_NEAR(f.trail, 0.020, 2e-4);
    EXPECT_NEAR(front.design.roll_center, 0.0945, 3e-4);
    EXPECT_NEAR(f.dive_slope, 0.0415, 3e-4);
    EXPECT_NEAR(degree * gain(front, &WheelFigures::camber), -22.56, 0.05);  // VDANL: -0.12 rad/ft
    EXPECT_NEAR(degree * gain(front, &WheelFigures::toe), -2.5, 0.15);
    EXPECT_NEAR(f.spring_ratio, 0.9238, 2e-4);
    EXPECT_NEAR(f.wheel_rate, 24453, 30);  // VDANL
    const AxleFigures& lock = front.sweeps[2].rows.back();
    EXPECT_NEAR(degree * (lock.left.steer - f.steer), 41.31, 0.03);  // W6: inner wheel at 73 mm of rack, toe aside
    EXPECT_NEAR(degree * (lock.right.steer - front.design.right.steer), 33.97, 0.03);  // outer
    EXPECT_NEAR(front.anti_brake, 12, 0.5);
}

TEST(E30, RearFiguresAreThoseItWasLaidOutFor) {
    const AxleReport rear = axle(test::shipped("bmw_323i"), "rear");
    EXPECT_NEAR(rear.design.roll_center, 0.1225, 3e-4);
    EXPECT_NEAR(degree * gain(rear, &WheelFigures::camber), -35.1, 0.05);  // W2: 0.9 degrees an inch
    EXPECT_NEAR(rear.design.left.dive_slope, -0.646, 0.02);
    EXPECT_NEAR(rear.anti_drive, 0, 0.5);
    EXPECT_NEAR(rear.design.left.spring_ratio, 0.6791, 2e-4);
    EXPECT_NEAR(rear.design.left.damper_ratio, 1.053, 5e-4);
    EXPECT_NEAR(rear.design.left.wheel_rate, 19636, 30);  // VDANL
}

TEST(E21, CamberGainsAreThoseOfVdanl) {
    const VehicleDescription car = test::shipped("bmw_e21_320i");
    const AxleReport front = axle(car, "front"), rear = axle(car, "rear");
    EXPECT_NEAR(gain(front, &WheelFigures::camber) * foot, -0.12, 1e-3);
    EXPECT_NEAR(gain(rear, &WheelFigures::camber) * foot, -0.276, 1e-3);
    EXPECT_NEAR(front.design.left.wheel_rate, 24453, 60);
    EXPECT_NEAR(rear.design.left.wheel_rate, 19636, 60);
    EXPECT_NEAR(rear.design.roll_center, 0.173, 3e-3);  // derived for a sweep of 20 degrees
}

// A Panhard rod holds its axle sideways: the roll center lies where the rod crosses the middle plane.
TEST(Kinematics, RollCenterOfAPanhardAxleLiesOnTheRod) {
    VehicleDescription car = test::shipped("offroader");
    for (const SuspensionDescription& suspension : car.suspensions) {
        if (suspension.keyword != "panhard_axle") continue;
        for (const CutJointDescription& cut : suspension.linkage.cuts) {
            if (cut.name != "Panhard rod") continue;
            const double share = cut.tip[1] / (cut.tip[1] - cut.foot[1]);
            const double height = cut.tip[2] + share * (cut.foot[2] - cut.tip[2]);
            EXPECT_NEAR(axle(car, suspension.name).design.roll_center, height, 0.02) << suspension.name;
        }
    }
}

TEST(Kinematics, EndsWithWheelTravelAndJointBeyondReach) {
    SweepRange far;
    far.travel = 0.6;
    bool ended = false;
    for (const AxleReport& report : kinematics(test::shipped("bmw_323i"), far)) {
        for (const Sweep& sweep : report.sweeps) {
            if (sweep.ended.empty()) continue;
            ended = true;
            EXPECT_NE(sweep.ended.find("mm left"), std::string::npos) << sweep.ended;
        }
    }
    EXPECT_TRUE(ended);
}

class EveryAxle : public testing::TestWithParam<std::string> {};

TEST_P(EveryAxle, GoesThroughItsSweepsSymmetrically) {
    for (const AxleReport& report :
         kinematics(test::shipped(GetParam()), SweepRange{.travel = 0.05, .roll = 0.04, .steps = 20})) {
        for (const Sweep& sweep : report.sweeps) {
            EXPECT_EQ(sweep.ended, "") << report.name << " " << sweep.name;
            EXPECT_EQ(sweep.rows.size(), 21u) << report.name << " " << sweep.name;
        }
        const bool has_a_side = GetParam() == "offroader" || GetParam() == "truck_semitrailer";
        for (const AxleFigures& row : report.sweeps[0].rows) {
            if (!has_a_side) {
                EXPECT_NEAR(row.left.camber, row.right.camber, 1e-9) << report.name;
            }
            EXPECT_GT(row.left.spring_ratio, 0.2) << report.name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Vehicles, EveryAxle, testing::ValuesIn(test::fleet()),
                         [](const auto& one) { return one.param; });

// Its toe link steers the rear axle, and comes to a dead center at 125 mm of rack: behind it lies another branch of the linkage,
// on which the wheel would stand the other way round.
TEST(Kinematics, SteerEndsBeforeADeadCenter) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("steered_" + std::to_string(getpid()) + ".toml");
    std::ofstream(file) << "base = '" << test::source_path("vehicles/bmw_e90_330i.toml")
                        << "'\n[steering]\nrack_travel_m = 0.2\n[[axle]]\nname = 'rear'\n[axle.hardpoints]\n"
                        << "steered = true\nrack_axis = [0, -1, 0]\n";
    const AxleReport rear = axle(io::read_vehicle(file.string()), "rear");
    std::filesystem::remove(file);
    const Sweep& steer = rear.sweeps.back();
    ASSERT_EQ(steer.name, "steer");
    EXPECT_NE(steer.ended.find("rack 130.0 mm"), std::string::npos) << steer.ended;
    EXPECT_NEAR(steer.rows.back().rack, 0.12, 1e-9);
    for (std::size_t i = 1; i < steer.rows.size(); ++i) {
        const double turned = steer.rows[i].left.steer - steer.rows[i - 1].left.steer;
        EXPECT_GT(turned, 0) << steer.rows[i].rack;
        EXPECT_LT(turned * degree, 15) << steer.rows[i].rack;
    }
}

}  // namespace
}  // namespace hamilcar
