// What is seen on a drive, against kinematics written out here: where trailers' wheels are, what dual tires carry, how
// the motor vehicle of a combination accelerates.
#include "hamilcar/maneuver/drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/scenarios.hpp"
#include "hamilcar/maneuver/test_run.hpp"
#include "hamilcar/run/handling_channels.hpp"
#include "support/car.hpp"
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
Spot behind(const VehicleDescription& truck, const Recording& r, std::size_t row) {
    Spot sum;
    double count = 0;
    for_each_wheel(truck, [&](const auto& wheel, std::size_t unit) {
        if (unit == 0) return;
        sum.x += r[channel::contact_x(wheel.name)].values[row], sum.y += r[channel::contact_y(wheel.name)].values[row];
        ++count;
    });
    return {sum.x / count, sum.y / count};
}

// Where the tractor carries the trailer, by the path of its center of mass.
Spot hitch(const VehicleDescription& truck, const Recording& r, std::size_t row) {
    const Point &at = truck.trailers[0].hitch_point, &center = truck.chassis.center_of_mass;
    const double yaw = r[channel::heading].values[row] * degree;
    return {r[channel::x].values[row] + std::cos(yaw) * (at[0] - center[0]),
            r[channel::y].values[row] + std::sin(yaw) * (at[0] - center[0])};
}

TEST(Drive, ATrailersWheelsFollowItsHitch) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const Recording r = drive(truck, steered(truck, 8, 4, 9)).recording;
    const double length = 0.5 * (13.60 + 14.92) - 3.95;  // from the hitch to the middle of the trailer's axles [m]
    const std::vector<double> yaw = continued(r[channel::heading].values);
    double sharpest = 0;
    for (std::size_t i = 200; i + 20 < r.size(); i += 50) {
        const Spot wheels = behind(truck, r, i), pin = hitch(truck, r, i);
        const Spot before = behind(truck, r, i - 20), after = behind(truck, r, i + 20);
        EXPECT_NEAR(std::hypot(pin.x - wheels.x, pin.y - wheels.y), length, 0.05) << r.time()[i];
        // Its wheels roll where it points, but for their slip.
        const double heading = std::atan2(pin.y - wheels.y, pin.x - wheels.x);
        EXPECT_NEAR(std::atan2(after.y - before.y, after.x - before.x), heading, 2 * degree) << r.time()[i];
        sharpest = std::max(sharpest, std::abs(yaw[i] * degree - heading));
    }
    EXPECT_GT(sharpest, 15 * degree) << "the combination has to be bent for this to mean something";
}

TEST(Drive, RecordsWhereTheOuterOfTwoTiresStands) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const Recording r = drive(truck, steered(truck, 8, 0, 0.1)).recording;
    for_each_wheel(truck, [&](const auto& wheel, std::size_t) {
        const double middle = wheel.wheel.center[1];
        EXPECT_NEAR(r[channel::contact_y(wheel.name)].values[0],
                    middle + std::copysign(0.5 * wheel.dual_spacing, middle), 0.02)
            << wheel.name;
        EXPECT_NEAR(r[channel::contact_x(wheel.name)].values[0], wheel.wheel.center[0], 0.05) << wheel.name;
    });
}

TEST(Drive, WheelLoadsAddUpToTheWeight) {
    for (const char* name : {"truck_semitrailer", "bmw_323i"}) {
        const VehicleDescription vehicle = test::shipped(name);
        const Recording r = drive(vehicle, test::scenario(0.1)).recording;
        double load = 0;
        for (const std::string& wheel : wheel_names(vehicle)) load += r[channel::wheel_load(wheel)].values.front();
        EXPECT_NEAR(load / (total_mass(vehicle) * g), 1, 1e-3) << name;
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
TEST(Drive, TheAccelerationIsTheMotorVehiclesOwn) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const auto [back, below] = offset(truck);
    EXPECT_GT(back, 0.5);
    const Recording r = drive(truck, steered(truck, 20, 0.7, 3)).recording;
    const auto yaw_rate = scaled(r[channel::yaw_rate].values, degree), roll = scaled(r[channel::roll].values, degree),
               pitch = scaled(r[channel::pitch].values, degree);
    const auto speed = r[channel::speed].values, lateral = r[channel::lateral_speed].values;
    double largest = 0;
    for (std::size_t i = 1; i + 1 < r.size(); ++i) {
        const double apart = r.time()[i + 1] - r.time()[i], turn = yaw_rate[i];
        const auto rate = [&](std::span<const double> v) { return (v[i + 1] - v[i - 1]) / (2 * apart); };
        const auto bend = [&](std::span<const double> v) { return (v[i + 1] - 2 * v[i] + v[i - 1]) / (apart * apart); };
        const double across = rate(lateral) + turn * speed[i] - back * rate(yaw_rate) + below * bend(roll);
        const double along = rate(speed) - turn * lateral[i] + back * turn * turn - below * bend(pitch);
        EXPECT_NEAR(r[channel::lateral_acceleration].values[i], across, 0.02) << r.time()[i];
        EXPECT_NEAR(r[channel::longitudinal_acceleration].values[i], along, 0.02) << r.time()[i];
        largest = std::max(largest, std::abs(across));
    }
    EXPECT_GT(largest, 1);
}

TEST(Drive, AVehicleAloneMovesAsAllForcesOnItSay) {
    const VehicleDescription car = test::shipped_car();
    const ScenarioDescription scenario = steered(car, 20, 0.5, 1);
    const Recording r = drive(car, scenario).recording;
    Simulation simulation(car, scenario);
    test::run_to_end(simulation);
    const Sample s = simulation.sample();
    const double c = std::cos(simulation.observation().yaw), d = std::sin(simulation.observation().yaw);
    const Vec3<double> a = s.velocity.R_GC * Vec3<double>(s.momenta.external.head<3>()) / s.model.vehicle.total_mass;
    EXPECT_NEAR(r[channel::lateral_acceleration].values.back(), c * a[1] - d * a[0], 1e-13);
    EXPECT_NEAR(r[channel::longitudinal_acceleration].values.back(), c * a[0] + d * a[1], 1e-13);
}

// The channels along and across the heading against what the driver observes of the same state.
TEST(Drive, SideslipIsTheAngleOfTheObservedVelocity) {
    const VehicleDescription car = test::shipped_car();
    ScenarioDescription scenario = steered(car, 20, 2, 2);
    const Recording r = drive(car, scenario).recording;
    Simulation simulation(car, scenario);
    test::run_to_end(simulation);
    const Observation seen = simulation.observation();
    EXPECT_NEAR(r[channel::speed].values.back(), seen.speed, 1e-12);
    EXPECT_NEAR(r[channel::lateral_speed].values.back(), seen.lateral_velocity, 1e-12);
    EXPECT_NEAR(r[channel::yaw_rate].values.back() * degree, seen.yaw_rate, 1e-12);
    EXPECT_NEAR(r[channel::sideslip].values.back() * degree, std::atan2(seen.lateral_velocity, seen.speed), 1e-12);
    EXPECT_GT(std::abs(r[channel::sideslip].values.back()), 0.5);
    scenario = test::scenario(0.01);
    EXPECT_EQ(drive(car, scenario).recording[channel::sideslip].values.back(), 0) << "below 3 m/s there is none";
}

TEST(Series, AnAngleGoesOnBeyondHalfATurn) {
    EXPECT_EQ(continued(std::vector<double>{170, -175, -100, 10, 179, -179}),
              (std::vector<double>{170, 185, 260, 370, 539, 541}));
}

TEST(Drive, TellsALinkageWhoseLoopsOpenedFromAVehicleThatFellOver) {
    const VehicleDescription car = test::shipped("bmw_323i");
    ManeuverOptions coarse;
    coarse.solver.step = 0.1;
    const Drive apart = drive(car, driving_at(car, coarse, 20, 2));
    EXPECT_EQ(apart.stopped, Stopped::numerical);
    EXPECT_NE(apart.trouble.find("constraint violation"), std::string::npos) << apart.trouble;
    EXPECT_TRUE(apart.breaks_off());
    VehicleDescription tall = car;
    tall.chassis.center_of_mass[2] += 2;
    const Drive fallen = drive(tall, steered(tall, 20, 3, 10));
    EXPECT_EQ(fallen.stopped, Stopped::fell_over) << fallen.trouble;
    EXPECT_FALSE(fallen.breaks_off());
    const Drive whole = drive(car, driving_at(car, {}, 20, 0.1));
    EXPECT_EQ(whole.stopped, Stopped::no);
    EXPECT_EQ(whole.trouble, "");
}

// Wheels without inertia spin up and down within a step: the drive goes on, but with numbers that no vehicle has.
TEST(Drive, WhoseEnergyAccountIsWrongCountsAsNumericalEnd) {
    VehicleDescription car = test::shipped("bmw_323i");
    for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].wheel.spin_inertia = 1e-6;
    const Drive failed = drive(car, driving_at(car, {}, 20, 2));
    EXPECT_EQ(failed.stopped, Stopped::numerical);
    EXPECT_NE(failed.trouble.find("energy account is off by"), std::string::npos) << failed.trouble;
    ManeuverOptions without;
    without.solver.energy_balance = false;
    const Drive unaccounted = drive(test::shipped("bmw_323i"), driving_at(car, without, 20, 0.5));
    EXPECT_EQ(unaccounted.stopped, Stopped::no) << unaccounted.trouble;
    EXPECT_TRUE(std::isnan(unaccounted.energy.residual()));
}

TEST(Drive, ThatNeedsMoreRackThanThereIsNamesTheVehicleAndNoKey) {
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

// A sum over many drives would hide a bad one among them.
TEST(Outcome, JudgesTheEnergyAccountOfEachDriveByItself) {
    Drive good, doubtful, broken;
    good.energy = {.supplied = 0, .stored = -1e6, .dissipated = 1e6, .exchanged = 1e6};
    doubtful.energy = {.supplied = 0, .stored = -1e4, .dissipated = 0.98e4, .exchanged = 1e4};
    doubtful.validity = energy_warning(doubtful.energy.error(), doubtful.energy.exchanged, 1e-3, 5);
    doubtful.validity.push_back({.kind = "tire_load", .where = "front_left.tire", .worst = 2, .limit = 1});
    broken.stopped = Stopped::numerical, broken.trouble = "front_left constraint violation";
    TestRun test(coast_down(), test::shipped_car(), {}, {});
    const Outcome& outcome = test.outcome;
    EXPECT_TRUE(test.take_energy(good));
    EXPECT_TRUE(outcome.validity.empty());
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(test.take_energy(doubtful));
    ASSERT_EQ(outcome.validity.size(), 1u) << "told once, and of a drive on the way nothing of its models";
    EXPECT_EQ(outcome.validity[0].kind, "energy_balance");
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(test.take(doubtful));
    EXPECT_EQ(outcome.validity.size(), 2u) << "of a drive that counts all, once";
    EXPECT_FALSE(outcome.failed);
    EXPECT_FALSE(test.take_energy(broken));
    EXPECT_EQ(outcome.failed, "front_left constraint violation");
    EXPECT_EQ(outcome.stopped, Stopped::numerical);
}

}  // namespace
}  // namespace hamilcar
