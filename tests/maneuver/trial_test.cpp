// What is seen on a drive, against kinematics written out here: where trailers' wheels are, what dual tires carry, how
// the motor vehicle of a combination accelerates.
#include "hamilcar/maneuver/trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/common.hpp"
#include "hamilcar/maneuver/straight.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

constexpr double g = standard_gravity;

ScenarioDescription steered(const VehicleDescription& vehicle, double speed, double angle, double duration) {
    ScenarioDescription s = driving_at(vehicle, {}, speed, duration);
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0.5, 1.5}, {0, angle});
    return s;
}

struct Spot {
    double x = 0, y = 0;
};

// The middle of the trailer's wheels in a row.
Spot behind(const VehicleDescription& truck, const History& h, std::size_t row) {
    Spot sum;
    std::size_t number = 0;
    double count = 0;
    for_each_wheel(truck, [&](const auto&, std::size_t unit) {
        if (unit > 0) sum.x += h.wheel_x[number][row], sum.y += h.wheel_y[number][row], ++count;
        ++number;
    });
    return {sum.x / count, sum.y / count};
}

// Where the tractor carries the trailer, by the path of its center of mass.
Spot hitch(const VehicleDescription& truck, const History& h, std::size_t row) {
    const Point &at = truck.trailers[0].hitch_point, &center = truck.chassis.center_of_mass;
    return {h.x[row] + std::cos(h.yaw[row]) * (at[0] - center[0]),
            h.y[row] + std::sin(h.yaw[row]) * (at[0] - center[0])};
}

TEST(Trial, ATrailersWheelsFollowItsHitch) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const History h = drive(truck, steered(truck, 8, 4, 9)).history;
    const double length = 0.5 * (13.60 + 14.92) - 3.95;  // from the hitch to the middle of the trailer's axles [m]
    double sharpest = 0;
    for (std::size_t i = 200; i + 20 < h.size(); i += 50) {
        const Spot wheels = behind(truck, h, i), pin = hitch(truck, h, i);
        const Spot before = behind(truck, h, i - 20), after = behind(truck, h, i + 20);
        EXPECT_NEAR(std::hypot(pin.x - wheels.x, pin.y - wheels.y), length, 0.05) << h.time[i];
        // Its wheels roll where it points, but for their slip.
        const double heading = std::atan2(pin.y - wheels.y, pin.x - wheels.x);
        EXPECT_NEAR(std::atan2(after.y - before.y, after.x - before.x), heading, 2 * degree) << h.time[i];
        sharpest = std::max(sharpest, std::abs(h.yaw[i] - heading));
    }
    EXPECT_GT(sharpest, 15 * degree) << "the combination has to be bent for this to mean something";
}

TEST(Trial, TheOuterOfTwoTiresIsSeen) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const History h = drive(truck, steered(truck, 8, 0, 0.1)).history;
    std::size_t number = 0;
    for_each_wheel(truck, [&](const auto& wheel, std::size_t) {
        const double middle = wheel.wheel.center[1];
        EXPECT_NEAR(h.wheel_y[number][0], middle + std::copysign(0.5 * wheel.dual_spacing, middle), 0.02) << wheel.name;
        EXPECT_NEAR(h.wheel_x[number][0], wheel.wheel.center[0], 0.05) << wheel.name;
        ++number;
    });
}

TEST(Trial, WheelsCarryTheWholeWeight) {
    for (const char* name : {"truck_semitrailer", "bmw_323i"}) {
        const VehicleDescription vehicle = test::shipped(name);
        ScenarioDescription standing = test::scenario(0.1);
        const History h = drive(vehicle, standing).history;
        double load = 0;
        for (const auto& wheel : h.wheel_load) load += wheel.front();
        EXPECT_NEAR(load / (straight::total_mass(vehicle) * g), 1, 1e-3) << name;
    }
}

// What the tractor is made of, without the trailer: its center of mass behind and below the chassis's [m].
struct Offset {
    double back, below;
};
Offset offset(const VehicleDescription& truck) {
    const Point& center = truck.chassis.center_of_mass;
    double mass = truck.chassis.mass, back = 0, below = 0;
    for (const SuspensionDescription& suspension : truck.suspensions) {
        if (suspension.unit > 0) continue;
        for (const auto& [part, body] : suspension.bodies) {
            mass += body.mass;
            back += body.mass * (center[0] - body.center_of_mass[0]);
            below += body.mass * (center[2] - body.center_of_mass[2]);
        }
    }
    return {back / mass, below / mass};
}

// Of the chassis's center of mass v_y' + r v_x across the heading and v_x' - r v_y along it; what turns adds to that at the
// whole tractor's center of mass.
TEST(Trial, TheAccelerationIsTheMotorVehiclesOwn) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const auto [back, below] = offset(truck);
    EXPECT_GT(back, 0.5);
    const History h = drive(truck, steered(truck, 20, 0.7, 3)).history;
    double largest = 0;
    for (std::size_t i = 1; i + 1 < h.size(); ++i) {
        const double apart = h.time[i + 1] - h.time[i], r = h.yaw_rate[i];
        const auto rate = [&](const std::vector<double>& v) { return (v[i + 1] - v[i - 1]) / (2 * apart); };
        const auto bend = [&](const std::vector<double>& v) {
            return (v[i + 1] - 2 * v[i] + v[i - 1]) / (apart * apart);
        };
        const double across =
            rate(h.lateral_velocity) + r * h.speed[i] - back * rate(h.yaw_rate) + below * bend(h.roll);
        const double along = rate(h.speed) - r * h.lateral_velocity[i] + back * r * r - below * bend(h.pitch);
        EXPECT_NEAR(h.lateral_acceleration[i], across, 0.02) << h.time[i];
        EXPECT_NEAR(h.longitudinal_acceleration[i], along, 0.02) << h.time[i];
        largest = std::max(largest, std::abs(across));
    }
    EXPECT_GT(largest, 1);
}

TEST(Trial, AVehicleAloneMovesAsAllForcesOnItSay) {
    const VehicleDescription car = test::shipped_car();
    const ScenarioDescription scenario = steered(car, 20, 0.5, 1);
    const History h = drive(car, scenario).history;
    Simulation simulation(car, scenario);
    test::run_to_end(simulation);
    const Sample s = simulation.sample();
    const double c = std::cos(simulation.observation().yaw), d = std::sin(simulation.observation().yaw);
    const Vec3<double> a = s.velocity.R_GC * Vec3<double>(s.momenta.external.head<3>()) / s.model.vehicle.total_mass;
    EXPECT_EQ(h.lateral_acceleration.back(), c * a[1] - d * a[0]);
    EXPECT_EQ(h.longitudinal_acceleration.back(), c * a[0] + d * a[1]);
}

TEST(History, SideslipGoesAllAround) {
    History h;
    const auto slipping = [&](double speed, double angle) {
        h.speed.push_back(speed * std::cos(angle)), h.lateral_velocity.push_back(speed * std::sin(angle));
        return h.sideslip(h.speed.size() - 1);
    };
    for (const double angle : {-170.0, -100.0, -90.0, -20.0, 0.0, 5.0, 89.0, 91.0, 135.0, 180.0}) {
        EXPECT_NEAR(slipping(10, angle * degree), angle * degree, 1e-12);
    }
    EXPECT_EQ(slipping(2.9, 1), 0);
    EXPECT_NEAR(slipping(3.1, 1), 1, 1e-12);
}

TEST(Trial, TellsALinkageThatCameApartFromAVehicleThatFellOver) {
    const VehicleDescription car = test::shipped("bmw_323i");
    ManeuverOptions coarse;
    coarse.solver.step = 0.1;
    const Trial apart = drive(car, driving_at(car, coarse, 20, 2));
    EXPECT_EQ(apart.stopped, Stopped::numerical);
    EXPECT_NE(apart.trouble.find("came apart"), std::string::npos) << apart.trouble;
    EXPECT_TRUE(apart.breaks_off());
    VehicleDescription tall = car;
    tall.chassis.center_of_mass[2] += 2;
    const Trial fallen = drive(tall, steered(tall, 20, 3, 10));
    EXPECT_EQ(fallen.stopped, Stopped::fell_over) << fallen.trouble;
    EXPECT_FALSE(fallen.breaks_off());
    const Trial whole = drive(car, driving_at(car, {}, 20, 0.1));
    EXPECT_EQ(whole.stopped, Stopped::no);
    EXPECT_EQ(whole.trouble, "");
}

// Wheels without inertia spin up and down within a step: the drive goes on, but with numbers that no vehicle has.
TEST(Trial, WhoseEnergyAccountIsWrongCountsAsNumericalEnd) {
    VehicleDescription car = test::shipped("bmw_323i");
    for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].wheel.spin_inertia = 1e-6;
    const Trial trial = drive(car, driving_at(car, {}, 20, 2));
    EXPECT_EQ(trial.stopped, Stopped::numerical);
    EXPECT_NE(trial.trouble.find("energy account is off by"), std::string::npos) << trial.trouble;
    ManeuverOptions without;
    without.solver.energy_balance = false;
    const Trial unaccounted = drive(test::shipped("bmw_323i"), driving_at(car, without, 20, 0.5));
    EXPECT_EQ(unaccounted.stopped, Stopped::no) << unaccounted.trouble;
    EXPECT_TRUE(std::isnan(unaccounted.energy.gap()));
}

TEST(Trial, ThatNeedsMoreRackThanThereIsNamesTheVehicleAndNoKey) {
    VehicleDescription car = test::shipped("bmw_323i");
    car.steering.rack_travel = 0.01;
    try {
        drive(car, steered(car, 10, 6, 3));
        ADD_FAILURE() << "the rack went through its stops";
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::numerical);
        EXPECT_EQ(error.key(), "");
        EXPECT_NE(std::string(error.what()).find("more steering than"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace hamilcar
