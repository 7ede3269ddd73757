// Cars with power units under interactive control: gear changes, clutch actuation, and a reproducible reset.
#include "hamilcar/live/gear_lever.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "hamilcar/live/live_simulation.hpp"
#include "support/allocation_guard.hpp"
#include "support/fleet.hpp"

namespace hamilcar::live {
namespace {

class DrivenSimulation {
public:
    explicit DrivenSimulation(const VehicleDescription& vehicle)
        : simulation(1, {"car", "flat"}, vehicle, test::scenario(1)) {}

    // Calls `see` every 10 ms.
    template <class F>
    void drive(double seconds, const Controls& controls, const F& see) {
        for (double t = 0; t < seconds && !ended; t += 0.01) {
            for (int i = 0; i < 10; ++i) {
                const auto end = simulation.advance({.controls = controls});
                ended = end.has_value();
                ASSERT_FALSE(end) << end->message;
            }
            see();
        }
    }
    void drive(double seconds, const Controls& controls) {
        drive(seconds, controls, [] {});
    }
    double operator[](const std::string& name) {
        const std::span<const double> values = simulation.channel_values();
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (simulation.channels()[i].column.name == name) return values[i];
        }
        ADD_FAILURE() << "there is no channel " << name;
        return 0;
    }
    double speed() { return (*this)["chassis.longitudinal_velocity"]; }

    LiveSimulation simulation;
    bool ended = false;
};

TEST(GearLever, ShiftsAutomatically) {
    DrivenSimulation car(test::shipped_car());
    double highest = 0, slowest = 1e9, fastest = 0;
    const auto see = [&] {
        highest = std::max(highest, car["engine.gear"]);
        slowest = std::min(slowest, car["engine.speed"]), fastest = std::max(fastest, car["engine.speed"]);
    };
    car.drive(9, {.throttle = 1}, see);
    EXPECT_GE(highest, 2);
    EXPECT_GT(car.speed(), 17);
    EXPECT_GT(slowest, 600);
    EXPECT_LT(fastest, 6700);
    car.drive(8, {.brake = 0.4}, see);
    EXPECT_NEAR(car.speed(), 0, 0.1);
    EXPECT_EQ(car["engine.gear"], 1);
    EXPECT_GT(slowest, 600);
}

TEST(GearLever, EngagesRequestedGear) {
    DrivenSimulation car(test::shipped_car());
    car.drive(4, {.throttle = 0.6, .selector = Selector::manual, .gear = 1});
    EXPECT_EQ(car["engine.gear"], 1);
    const double first = car["engine.speed"];
    double pressed = 0, between = 1;
    car.drive(1, {.throttle = 0.6, .selector = Selector::manual, .gear = 2}, [&] {
        pressed = std::max(pressed, car["input.clutch"]);
        between = std::min(between, car["input.throttle"]);
    });
    EXPECT_EQ(car["engine.gear"], 2);
    EXPECT_GT(pressed, 0.95);
    EXPECT_LT(between, 0.05);
    EXPECT_NEAR(car["engine.speed"], first * 2.2 / 3.83, 0.1 * first);
    car.drive(1, {.selector = Selector::manual, .gear = 20});  // limited to the highest gear
    EXPECT_EQ(car["engine.gear"], 5);
}

TEST(GearLever, EngagesSuitableGearFromNeutral) {
    DrivenSimulation car(test::shipped_car());
    car.drive(8, {.throttle = 1});
    car.drive(2, {.selector = Selector::neutral});
    EXPECT_EQ(car["engine.gear"], 0);
    EXPECT_LT(car["engine.speed"], 1500);
    const double before = car.speed();
    double fastest = 0, hardest = 0;
    car.drive(2, {.throttle = 0.1}, [&] {
        fastest = std::max(fastest, car["engine.speed"]);
        hardest = std::max(hardest, std::abs(car["chassis.longitudinal_acceleration"]));
    });
    EXPECT_GE(car["engine.gear"], 3);
    EXPECT_LT(fastest, 4000);
    EXPECT_LT(hardest, 4);
    EXPECT_NEAR(car.speed(), before, 2);
}

// Passing through all lower gears would spin the engine far beyond its limit.
TEST(GearLever, AutomaticGearboxSkipsGearsFromNeutral) {
    for (const char* name : {"truck_semitrailer", "offroader"}) {
        SCOPED_TRACE(name);
        DrivenSimulation car(test::shipped(name));
        car.drive(12, {.throttle = 1});
        car.drive(1, {.selector = Selector::neutral});
        const double before = car.speed(), idle = car["engine.speed"];
        double fastest = idle;
        car.drive(2, {}, [&] { fastest = std::max(fastest, car["engine.speed"]); });
        EXPECT_GE(car["engine.gear"], 2);
        EXPECT_LT(fastest, std::max(idle, 2500.0));
        EXPECT_NEAR(car.speed(), before, 2);
    }
}

TEST(GearLever, EngagesReverseOnlyNearStandstill) {
    DrivenSimulation car(test::shipped_car());
    car.drive(3, {.throttle = 0.5});
    ASSERT_GT(car.speed(), 3);
    car.drive(1, {.selector = Selector::reverse});
    EXPECT_EQ(car["engine.gear"], 0);
    car.drive(3, {.brake = 0.5, .selector = Selector::reverse});
    EXPECT_EQ(car["engine.gear"], -1);
    car.drive(3, {.throttle = 0.3, .selector = Selector::reverse});
    ASSERT_LT(car.speed(), -1.5);
    car.drive(1, {.throttle = 0.3});
    EXPECT_EQ(car["engine.gear"], 0);  // no forward gear yet either
    car.drive(3, {.brake = 0.5});
    car.drive(3, {.throttle = 0.5});
    EXPECT_GT(car.speed(), 1);
}

TEST(GearLever, StaysInNeutralWithoutReverseGear) {
    VehicleDescription vehicle = test::shipped_car();
    vehicle.power_units[0].gearbox.reverse_ratio = 0;
    DrivenSimulation car(vehicle);
    car.drive(2, {.throttle = 0.5, .selector = Selector::reverse});
    EXPECT_EQ(car["engine.gear"], 0);
    EXPECT_NEAR(car.speed(), 0, 0.01);
    EXPECT_GT(car["engine.speed"], 3000);  // the throttle pedal is pressed
}

TEST(GearLever, ClutchPedalOpensClutch) {
    DrivenSimulation car(test::shipped_car());
    car.drive(2, {.throttle = 0.4, .clutch = 1});
    EXPECT_EQ(car["engine.gear"], 1);
    EXPECT_NEAR(car.speed(), 0, 0.05);
    EXPECT_GT(car["engine.speed"], 3000);
    car.drive(2, {.throttle = 0.4});
    EXPECT_GT(car.speed(), 2);
}

// Forward, backward, and coasting in neutral; engines neither stall nor overspeed.
TEST(GearLever, DrivesEveryShippedCar) {
    std::vector<std::string> names = test::fleet();
    names.push_back("electric_hatchback");
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        DrivenSimulation car(test::shipped(name));
        ASSERT_TRUE(car.simulation.car().powered);
        const PowerUnitDescription& unit = car.simulation.vehicle().power_units[0];
        double fastest = 0, hardest = 0;
        const auto see = [&] {
            fastest = std::max(fastest, std::abs(car[unit.name + ".speed"]));
            hardest = std::max(hardest, std::abs(car["chassis.longitudinal_acceleration"]));
        };
        car.drive(5, {.throttle = 0.6}, see);
        EXPECT_GT(car.speed(), 2);
        car.drive(1, {.selector = Selector::neutral}, see);
        EXPECT_EQ(car[unit.name + ".gear"], 0);
        car.drive(1.5, {.throttle = 0.3}, see);
        EXPECT_GE(car[unit.name + ".gear"], 1);
        car.drive(12, {.brake = 0.4, .selector = Selector::reverse}, see);
        EXPECT_NEAR(car.speed(), 0, 0.1);
        car.drive(3, {.throttle = 0.5, .selector = Selector::reverse}, see);
        EXPECT_LT(car.speed(), -0.5);
        EXPECT_LT(hardest, 15);
        EXPECT_LT(fastest, 13000);
    }
}

Controls maneuver(long step) {
    if (step < 3000) return {.throttle = 0.9};
    if (step < 4000) return {.selector = Selector::manual, .gear = 1};
    return {.brake = 0.5, .selector = Selector::reverse, .clutch = 0.3};
}

TEST(GearLever, ResetIsBitIdentical) {
    for (const char* name : {"bmw_323i", "offroader", "electric_hatchback"}) {
        LiveSimulation simulation(1, {"car", "flat"}, test::shipped(name), test::scenario(1));
        const auto drive = [&](long show_every) {
            for (long i = 0; i < 5000; ++i) {
                simulation.advance({.controls = maneuver(i)});
                if (i % show_every == 0) simulation.publish_frame({});
            }
            return simulation.state();
        };
        const State<double> first = drive(3);
        simulation.advance({.controls = {.throttle = 1}});
        simulation.reset();
        const State<double> second = drive(1000);
        for (std::size_t k = 0; k < first.values.size(); ++k) {
            ASSERT_EQ(std::bit_cast<std::uint64_t>(first.values[k]), std::bit_cast<std::uint64_t>(second.values[k]))
                << name << " " << k;
        }
    }
}

TEST(GearLever, AllocatesNothing) {
    LiveSimulation simulation(1, {"car", "flat"}, test::shipped_car(), test::scenario(1));
    for (long i = 0; i < 20; ++i) simulation.advance({.controls = maneuver(0)}), simulation.publish_frame({});
    const test::AllocationGuard guard;
    for (long i = 2500; i < 4500; ++i) {
        simulation.advance({.controls = maneuver(i)});
        if (i % 10 == 0) simulation.publish_frame({});
    }
    simulation.reset();
    EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace hamilcar::live
