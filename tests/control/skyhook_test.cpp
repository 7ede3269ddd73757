// Semi-active dampers at a made-up car: how firm they are told to be, by hand, for motions of body and wheels.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "control/made_up_car.hpp"

namespace hamilcar {
namespace {

using namespace test;
using Keys = std::vector<std::pair<std::string, double>>;
constexpr double g = 9.80665, soft = 0.4, firm = 2;  // [m/s^2], [1]
constexpr double rest = (1 - soft) / (firm - soft);

class MadeUpDampers {
public:
    explicit MadeUpDampers(const Keys& keys = {}, double rate = 500) : interval_(1 / rate) {
        const ControllerKind& kind = *find_controller_kind("skyhook");
        ControlledCar car = made_up_car();
        for (ControlledWheel& wheel : car.wheels) wheel.damper_soft = soft, wheel.damper_firm = firm;
        controller_ = kind.make(ControllerSettings(kind, {.kind = "skyhook", .rate = rate, .settings = keys}), car);
        memory_.assign(controller_->memory_size(), 0.0);
    }
    static VehicleDescription vehicle() {
        VehicleDescription car = made_up_vehicle();
        for (SuspensionDescription& suspension : car.suspensions) {
            SuspensionDamperDescription& one = suspension.dampers.emplace_back();
            one.name = suspension.wheels[0].name;
            one.damper = {{-1, 1}, {-1500, 1500}, soft, firm};
        }
        return car;
    }

    std::array<double, 3> turning{};       // of the chassis [rad/s]
    std::array<double, 4> travel_speed{};  // of the wheels, up positive [m/s]
    void decide(double up) {               // acceleration beyond that of gravity [m/s^2]
        const std::array<double, 4> travel{};
        const Measured measured{.interval = interval_,
                                .angular_rate = turning,
                                .acceleration = {0, 0, g + up},
                                .travel = travel,
                                .travel_speed = travel_speed};
        controller_->decide(measured, memory_, Commands(layout_, commands_));
    }
    void go(double duration, double up) {
        for (long i = std::lround(duration / interval_); i > 0; --i) decide(up);
    }
    // Share of the damper's own force that it is told.
    double share(std::size_t wheel) { return soft + (firm - soft) * Commands(layout_, commands_).damper(wheel); }
    double activity() const { return controller_->activity(memory_); }

private:
    double interval_;
    CommandLayout layout_{vehicle()};
    std::unique_ptr<const Controller> controller_;
    std::vector<double> memory_, commands_ = layout_.rest();
};

constexpr std::array every_wheel{front_left, front_right, rear_left, rear_right};

// The body rises at 0.2 m/s after this, all else at rest.
MadeUpDampers rising(const Keys& keys = {}) {
    MadeUpDampers car(keys);
    car.go(0.1, 0);
    car.go(0.04, 5);
    return car;
}

TEST(Skyhook, KeepsTheDampersOwnForceAtRest) {
    EXPECT_NEAR(rest, 0.375, 1e-15);
    MadeUpDampers car;
    car.go(2, 0);
    for (const std::size_t wheel : every_wheel) EXPECT_NEAR(car.share(wheel), 1, 1e-12);
    EXPECT_NEAR(car.activity(), 0, 1e-12);
}

TEST(Skyhook, IsFirmWhereThatSlowsTheBodyAndSoftWhereItWouldPushIt) {
    MadeUpDampers car = rising();
    for (const double apart : {0.05, -0.05, 0.15, -0.15}) {
        for (double& one : car.travel_speed) one = -apart;
        car.decide(0);
        for (const std::size_t wheel : every_wheel) {
            if (apart < 0) {
                EXPECT_NEAR(car.share(wheel), soft, 1e-12) << "a damper that is pushed together would push the body up";
            } else {
                EXPECT_GT(car.share(wheel), 1.5) << "one that is drawn out holds it back";
            }
        }
    }
    MadeUpDampers falling;
    falling.go(0.1, 0), falling.go(0.04, -5);
    for (double& one : falling.travel_speed) one = 0.05;
    falling.decide(0);
    EXPECT_NEAR(falling.share(front_left), firm, 1e-12);
    EXPECT_NEAR(falling.activity(), 1, 1e-12) << "as far from rest as it can be";
    for (double& one : falling.travel_speed) one = -0.05;
    falling.decide(0);
    EXPECT_NEAR(falling.share(front_left), soft, 1e-12);
}

// The force of a damper to the sky: share * own * apart = sky * own * body.
TEST(Skyhook, HasTheForceOfADamperToTheSkyWhereItCan) {
    double twice = 0;
    for (const double sky : {1.0, 2.0}) {
        MadeUpDampers car = rising({{"sky_damping", sky}});
        double product = 0;
        for (const double apart : {0.3, 0.4, 0.2}) {
            MadeUpDampers there = rising({{"sky_damping", sky}});
            for (double& one : there.travel_speed) one = -apart;
            there.decide(0);
            const double share = there.share(rear_left);
            if (share >= firm || share <= soft) continue;
            if (product != 0) {
                EXPECT_NEAR(share * apart, product, 1e-9) << "whatever the damper's speed";
            }
            product = share * apart;
        }
        EXPECT_NEAR(product, sky * 0.2, 0.04 * sky) << "5 m/s^2 for 40 ms, less what is forgotten";
        if (twice != 0) {
            EXPECT_NEAR(product, twice, 1e-9);
        }
        twice = 2 * product;
    }
}

TEST(Skyhook, SeesRollAndPitchAtEachWheel) {
    MadeUpDampers car;
    car.go(0.1, 0);
    for (double& one : car.travel_speed) one = -0.05;  // all are drawn out
    car.turning = {0.3, 0, 0};                         // the left side rises
    car.decide(0);
    for (const std::size_t wheel : {front_left, rear_left}) EXPECT_NEAR(car.share(wheel), firm, 1e-12);
    for (const std::size_t wheel : {front_right, rear_right}) EXPECT_NEAR(car.share(wheel), soft, 1e-12);
    car.turning = {0, 0.3, 0};  // the nose dives
    car.decide(0);
    for (const std::size_t wheel : {front_left, front_right}) EXPECT_NEAR(car.share(wheel), soft, 1e-12);
    for (const std::size_t wheel : {rear_left, rear_right}) EXPECT_NEAR(car.share(wheel), firm, 1e-12);
    car.turning = {0, 0, 0.3};  // yaw is none of it
    car.decide(0);
    for (const std::size_t wheel : every_wheel) EXPECT_NEAR(car.share(wheel), soft, 1e-12);
}

// The page's law of the heave by small steps, after 0.1 s at rest, 40 ms at 5 m/s^2 and some time without [m/s].
double heave_after(double rest_of_time) {
    constexpr double h = 1e-5;
    double offset = 0, heave = 0;
    for (double t = 0; t < 0.14 + rest_of_time; t += h) {
        const double up = t > 0.1 && t < 0.14 ? 5 : 0;
        heave += h * (up - offset - heave / 0.5), offset += h * (up - offset) / 2;
    }
    return heave;
}

TEST(Skyhook, ForgetsTheHeaveInHalfASecond) {
    for (const double time : {0.0, 0.2, 0.5}) {
        MadeUpDampers car = rising({{"sky_damping", 1}});
        car.go(time, 0);
        const double heave = heave_after(time);
        for (double& one : car.travel_speed) one = -heave;  // so that a share of one is asked for
        car.decide(0);
        EXPECT_NEAR(car.share(front_left), 1, 0.03) << time;
    }
}

TEST(Skyhook, ForgetsASlope) {
    for (const bool from_the_start : {true, false}) {
        MadeUpDampers car;
        for (double& one : car.travel_speed) one = -0.05;
        if (!from_the_start) car.go(1, 0);
        car.go(0.5, 0.3);
        if (from_the_start) {
            EXPECT_NEAR(car.share(front_left), soft, 1e-9) << "it begins with what it finds";
        } else {
            EXPECT_GT(car.share(front_left), 1.5) << "at first it is a heave";
        }
        car.go(15, 0.3);
        EXPECT_NEAR(car.share(front_left), soft, 1e-9) << "no heave";
    }
}

TEST(Skyhook, KeepsALeastDampingForTheWheels) {
    MadeUpDampers car = rising({{"least_damping", 0.9}});
    for (double& one : car.travel_speed) one = 0.2;
    car.decide(0);
    for (const std::size_t wheel : every_wheel) EXPECT_NEAR(car.share(wheel), 0.9, 1e-12);
}

TEST(Skyhook, WantsADamperThatCanBeAdjusted) {
    const ControllerKind& kind = *find_controller_kind("skyhook");
    VehicleDescription car = MadeUpDampers::vehicle();
    EXPECT_EQ(kind.lacks(car), "");
    for (SuspensionDescription& suspension : car.suspensions) suspension.dampers[0].damper.firm = soft;
    EXPECT_EQ(kind.lacks(car), "an [axle.damper.adjustable]");
}

}  // namespace
}  // namespace hamilcar
