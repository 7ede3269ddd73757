// Drivers in whole cars: standing on slopes, decisions at any multiple of the step, and who cannot be driven.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/io/error.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

VehicleDescription truck() {
    return io::read_vehicle(test::source_path("vehicles/truck_semitrailer.toml"));
}

ScenarioDescription at_speed(double speed, double start, double duration) {
    ScenarioDescription s = test::scenario(duration, start);
    s.driver.speed.emplace();
    s.driver.speed->speed = {{0}, {speed}};
    return s;
}

struct Stand {
    double farthest = 0, last_speed = 0;  // over the last five seconds [m], [m/s]
};

Stand stand(const VehicleDescription& vehicle, ScenarioDescription s) {
    Simulation simulation(vehicle, std::move(s));
    Stand out;
    std::optional<Vec3<double>> from;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) {
            ADD_FAILURE() << end->message;
            break;
        }
        if (simulation.time() < simulation.scenario().duration - 5) continue;
        const Vec3<double> now = simulation.state().position();
        if (!from) from = now;
        out.farthest = std::max(out.farthest, (now - *from).norm());
    }
    out.last_speed = simulation.observation().speed;
    return out;
}

TEST(DrivenCar, StandsOnSlopes) {
    for (const bool loaded : {false, true}) {
        const VehicleDescription vehicle = loaded ? truck() : test::shipped_car();
        for (const double grade : {-0.2, 0.2}) {
            for (const double start : {0.0, 4.0}) {
                for (const bool powered : {false, true}) {
                    ScenarioDescription s = at_speed(0, start, 20);
                    s.road.grade = grade;
                    if (powered) s.driver.shifting.emplace();
                    const Stand found = stand(vehicle, s);
                    EXPECT_LT(found.farthest, 1e-3) << vehicle.name << grade << ' ' << start << powered;
                    EXPECT_NEAR(found.last_speed, 0, 1e-3) << vehicle.name << grade << ' ' << start << powered;
                }
            }
        }
    }
}

// The driver is asked at whole steps, whatever his interval: his controls never pass what they are led to.
TEST(DrivenCar, DecidesAtAnyMultipleOfTheStep) {
    for (const auto& [interval, step] : std::vector<std::pair<double, double>>{
             {0.001, 0.002}, {0.003, 0.002}, {0.005, 0.004}, {0.0025, 0.001}, {0.0034, 0.001}, {0.005, 0.001}}) {
        for (const bool powered : {false, true}) {
            if (powered && step > 0.002) continue;  // too long for a clutch that holds
            ScenarioDescription s = test::scenario(4, 10);
            s.driver.speed.emplace();
            s.driver.speed->speed = {{0, 2, 2.5, 4}, {10, 10, 7, 7}, Interpolation::linear};
            if (powered) s.driver.shifting = ShiftingDescription{.gear = 2};
            s.driver.interval = interval;
            s.solver.step = step;
            s.solver.integrator = "rk4";  // that takes the longest of them
            Simulation simulation(test::shipped_car(), s);
            int turns = 0;
            double before = 0, change_before = 0;
            while (!simulation.finished()) {
                ASSERT_FALSE(simulation.advance());
                const Input<double> input = simulation.schedule()(simulation.time());
                ASSERT_GE(input.brake, 0) << interval << ' ' << step << ' ' << simulation.time();
                ASSERT_GE(input.throttle, 0) << interval << ' ' << step << ' ' << simulation.time();
                ASSERT_GE(input.drive_torque, 0) << interval << ' ' << step << ' ' << simulation.time();
                const double now = powered ? input.throttle : input.drive_torque / 1e3, change = now - before;
                turns += change * change_before < 0 && std::abs(change) > 1e-4;
                if (change != 0) change_before = change;
                before = now;
            }
            EXPECT_LT(turns, 10) << interval << ' ' << step << ' ' << powered;
        }
    }
}

std::string refusal(const VehicleDescription& vehicle, const ScenarioDescription& s) {
    try {
        const Simulation simulation(vehicle, s);
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::bad_file);
        EXPECT_THAT(error.what(), testing::HasSubstr("'" + error.key() + "'"));
        return error.what();
    }
    return "none";
}

TEST(DrivenCar, IsRefusedWhereItCannotBeDriven) {
    const VehicleDescription car = test::shipped_car();
    ScenarioDescription s = at_speed(5, 0, 1);
    s.driver.shifting.emplace();
    s.driver.shifting->gear = 9;
    EXPECT_THAT(refusal(car, s), testing::StartsWith("key 'driver.gear.number' = 9: "));
    s.driver.shifting->gear = -1;
    EXPECT_THAT(refusal(car, s),
                testing::HasSubstr("'driver.gear.number' = -1: the reverse gear cannot reach the wanted speed"));
    s.driver.shifting->gear = 0;
    EXPECT_THAT(refusal(car, s), testing::HasSubstr("'driver.gear.number' = 0: neutral"));
    s.driver.speed->speed.value = {0};
    EXPECT_EQ(refusal(car, s), "none") << "standing in neutral";
    s.driver.shifting = ShiftingDescription{.first_gear = 9};
    EXPECT_THAT(refusal(car, s), testing::StartsWith("key 'driver.gear.first' = 9: "));
    s = at_speed(5, 0, 1);
    s.gear = {{0, 1}, {0, -1}, Interpolation::steps};
    EXPECT_THAT(refusal(car, s), testing::HasSubstr("'inputs.gear' = 0: neutral"));
    s.gear.value = {0, 2};
    EXPECT_EQ(refusal(car, s), "none");
}

TEST(DrivenCar, NeedsWheelsThatDriveAndThatSteer) {
    VehicleDescription car = test::shipped_car();
    for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].drive_share = 0;
    EXPECT_THAT(refusal(car, at_speed(5, 0, 1)), testing::HasSubstr("'driver.speed': no axle of " + car.name));
    EXPECT_EQ(refusal(car, at_speed(0, 5, 1)), "none");
    ScenarioDescription s = test::scenario(1, 5);
    s.driver.steering.emplace();
    s.driver.steering->path.points = {{0, 0}, {10, 0}};
    EXPECT_EQ(refusal(car, s), "none");
    car.steering.rack_per_revolution = 0;
    EXPECT_THAT(refusal(car, s), testing::HasSubstr("'driver.path': " + car.name + " has no [steering]"));
}

}  // namespace
}  // namespace hamilcar
