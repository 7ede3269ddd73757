// What controllers know of shipped cars, by other routes: statics, sums over a file's bodies, the steering's geometry on the road.
#include "hamilcar/run/controlled_car.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/run/driven_car.hpp"
#include "hamilcar/run/simulation.hpp"
#include "support/active_chassis.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

ControlledCar known(const std::string& name) {
    const Simulation run(test::shipped(name), [] {
        ScenarioDescription s = test::scenario(1);
        s.throttle = test::table({0}, {0});
        s.gear = {{0}, {0}, Interpolation::steps};
        return s;
    }());
    return controlled_car(run.vehicle(), run.model(), run.driven_car(), run.state(), run.schedule()(0));
}

class KnownCar : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, KnownCar,
                         testing::Values("bmw_e90_330i", "hatchback", "electric_hatchback", "offroader", "pickup",
                                         "truck_semitrailer"),
                         [](const auto& vehicle) { return vehicle.param; });

TEST_P(KnownCar, StandsOnItsWheels) {
    const VehicleDescription file = test::shipped(GetParam());
    const ControlledCar car = known(GetParam());
    EXPECT_NEAR(car.mass, total_mass(file), 1e-9 * car.mass);
    ASSERT_EQ(car.wheels.size(), wheel_count(file));
    double load = 0, left = 0, right = 0;
    for (const ControlledWheel& wheel : car.wheels) {
        EXPECT_GT(wheel.static_load, 0) << wheel.name;
        load += wheel.static_load;
        (wheel.y > 0 ? left : right) += wheel.static_load;
    }
    EXPECT_NEAR(load, car.mass * file.gravity, 1e-4 * load);
    EXPECT_NEAR(left, right, 0.02 * load);
}

TEST_P(KnownCar, KnowsItsWheelsAsTheFileSays) {
    const VehicleDescription file = test::shipped(GetParam());
    const ControlledCar car = known(GetParam());
    std::size_t i = 0;
    for_each_wheel(file, [&](const SuspensionWheelDescription& wheel, std::size_t unit) {
        const ControlledWheel& one = car.wheels[i++];
        EXPECT_EQ(one.name, wheel.name);
        EXPECT_EQ(one.unit, static_cast<int>(unit));
        EXPECT_EQ(one.brake_torque, wheel.brake.max_torque);
        EXPECT_EQ(one.radius, casing_of(wheel.tire).rolling_radius);
        EXPECT_EQ(one.spin_inertia, wheel.wheel.spin_inertia);
        EXPECT_EQ(one.y > 0, wheel.name.find("left") != std::string::npos) << wheel.name;
        const bool front = unit == 0 && wheel.name.starts_with("front");
        EXPECT_EQ(one.steered, front) << wheel.name;
        EXPECT_EQ(one.x > 0, front) << wheel.name;
        const std::string name = GetParam();
        const bool all = name == "offroader" || name == "electric_hatchback",
                   driven = all || front == (name == "hatchback");
        EXPECT_EQ(one.driven, driven && unit == 0) << wheel.name;
    });
    EXPECT_EQ(car.full_pressure, file.brakes.full_pressure);
    ASSERT_EQ(car.units.size(), file.power_units.size());
    EXPECT_EQ(car.units[0].name, file.power_units[0].name);
}

// As the steered wheels turn when the steering wheel does, read off a car that stands.
TEST_P(KnownCar, KnowsItsSteering) {
    const VehicleDescription file = test::shipped(GetParam());
    const ControlledCar car = known(GetParam());
    constexpr double angle = 0.2;  // of the steering wheel [rad]
    const auto heading = [&](double turned) {
        ScenarioDescription s = test::scenario(1);
        s.steering_input = SteeringInput::steering_wheel;
        s.steering = test::table({0}, {turned});
        const Simulation run(file, s);
        const Sample sample = run.sample();
        double sum = 0;
        for (int w = 0; w < 2; ++w) {  // across the axis
            const auto [suspension, wheel] = locate_wheel(sample.model.vehicle, w);
            const Vec3<double> axis = sample.velocity.suspensions[suspension].axis[wheel];
            sum += std::atan2(-axis[0], axis[1]);
        }
        return sum / 2;
    };
    EXPECT_NEAR(car.wheels_per_angle, (heading(angle) - heading(-angle)) / (2 * angle),
                0.01 * std::abs(car.wheels_per_angle));
    EXPECT_GT(car.wheels_per_angle, 0.02);
}

TEST_P(KnownCar, KnowsItsMeasures) {
    const VehicleDescription file = test::shipped(GetParam());
    const ControlledCar car = known(GetParam());
    double front = 0, rear = 0, front_load = 0, rear_load = 0;
    for (const ControlledWheel& wheel : car.wheels) {
        if (wheel.unit != 0) continue;
        const bool is_front = wheel.x > 0;
        (is_front ? front : rear) += wheel.x * wheel.static_load;
        (is_front ? front_load : rear_load) += wheel.static_load;
    }
    const double wheelbase = front / front_load - rear / rear_load;
    EXPECT_NEAR(car.wheelbase, wheelbase, 0.02 * wheelbase);
    EXPECT_NEAR(car.center_behind, front / front_load, 0.01 * wheelbase) << "of the chassis, as the wheels' places";
    // A bar of the wheelbase's length would have a twelfth, two points at the axles a quarter.
    const double inertia = (front_load + rear_load) / file.gravity * wheelbase * wheelbase;
    EXPECT_GT(car.yaw_inertia, inertia / 12);
    EXPECT_LT(car.yaw_inertia, inertia / 3);
}

// Beside one that is as it stands, another one that is adjustable, in this order and in the other one.
TEST(KnownDampers, AreThoseThatCommandsSet) {
    for (const bool adjustable_first : {true, false}) {
        VehicleDescription car = test::shipped("bmw_e90_330i");
        for (SuspensionDescription& suspension : car.suspensions) {
            SuspensionDamperDescription& first = suspension.dampers[0];
            for (double& force : first.damper.force) force /= 2;
            SuspensionDamperDescription second = first;
            second.name += "_2";
            (adjustable_first ? first : second).damper.soft = 0.5;
            (adjustable_first ? first : second).damper.firm = 3;
            suspension.dampers.push_back(second);
        }
        Simulation run(test::controlled_by(car, {test::controller("skyhook")}), test::scenario(0.2));
        const ControlledCar known =
            controlled_car(run.vehicle(), run.model(), run.driven_car(), run.state(), run.schedule()(0));
        for (const ControlledWheel& wheel : known.wheels) {
            EXPECT_EQ(wheel.damper_soft, 0.5) << wheel.name;
            EXPECT_EQ(wheel.damper_firm, 3) << wheel.name;
        }
        while (run.time() < 0.2) ASSERT_FALSE(run.advance());
        for (const double command : run.schedule().commands()) {
            EXPECT_GE(command, 0) << "not less, and a number";
            EXPECT_LE(command, 1);
        }
    }
}

}  // namespace
}  // namespace hamilcar
