// Active anti-roll bars at a made-up car: what they are told for travels and a lateral acceleration, by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "control/made_up_car.hpp"

namespace hamilcar {
namespace {

using namespace test;
using Keys = std::vector<std::pair<std::string, double>>;
constexpr double max_force = 4000;  // [N]
constexpr double turning = 6;       // a lateral acceleration of a sharp turn [m/s^2]

// Bars in front and behind.
class MadeUpBars {
public:
    explicit MadeUpBars(const Keys& keys = {}, double rate = 200) : interval_(1 / rate) {
        const ControllerKind& kind = *find_controller_kind("active_anti_roll");
        ControlledCar car = made_up_car();
        car.bars = {{front_left, front_right, max_force}, {rear_left, rear_right, max_force}};
        controller_ =
            kind.make(ControllerSettings(kind, {.kind = "active_anti_roll", .rate = rate, .settings = keys}), car);
        memory_.assign(controller_->memory_size(), 0.0);
    }
    static VehicleDescription vehicle() {
        VehicleDescription car = made_up_vehicle();
        car.anti_roll_bars = {{front_left, front_right, 8000, max_force}, {rear_left, rear_right, 8000, max_force}};
        return car;
    }

    std::array<double, 4> travel{}, travel_speed{};  // of the wheels [m], [m/s]
    // Decisions for a time [s], at that lateral acceleration.
    void go(double duration, double lateral) {
        for (long i = std::lround(duration / interval_); i > 0; --i) {
            const Measured measured{.interval = interval_,
                                    .acceleration = {0, lateral, 9.81},
                                    .travel = travel,
                                    .travel_speed = travel_speed};
            controller_->decide(measured, memory_, Commands(layout_, commands_));
        }
    }
    double front() { return Commands(layout_, commands_).bar(0); }
    double rear() { return Commands(layout_, commands_).bar(1); }
    double activity() const { return controller_->activity(memory_); }

private:
    double interval_;
    CommandLayout layout_{vehicle()};
    std::unique_ptr<const Controller> controller_;
    std::vector<double> memory_, commands_ = layout_.rest();
};

TEST(ActiveAntiRoll, LetsGoStraightAhead) {
    MadeUpBars car;
    car.travel = {0.04, -0.02, 0.03, 0}, car.travel_speed = {1, 0, -1, 0};
    car.go(1, 0);
    EXPECT_EQ(car.front(), 0);
    EXPECT_EQ(car.rear(), 0);
    EXPECT_EQ(car.activity(), 0);
}

TEST(ActiveAntiRoll, AsksForStiffnessAndDampingInATurn) {
    MadeUpBars car({{"stiffness_N_per_m", 50e3}, {"damping_N_s_per_m", 1e3}, {"front_share", 0.7}});
    car.travel = {0.01, -0.02, 0.005, -0.01}, car.travel_speed = {0.1, -0.2, -0.3, 0.1};
    car.go(2, turning);
    EXPECT_NEAR(car.front(), 0.7 * (50e3 * 0.03 + 1e3 * 0.3) / max_force, 1e-9) << "pushes the higher wheel down";
    EXPECT_NEAR(car.rear(), 0.3 * (50e3 * 0.015 - 1e3 * 0.4) / max_force, 1e-9);
    EXPECT_NEAR(car.activity(), (car.front() + car.rear()) / 2, 1e-12);
    const double front = car.front(), rear = car.rear();
    for (std::array<double, 4>* one : {&car.travel, &car.travel_speed}) {
        std::swap((*one)[0], (*one)[1]), std::swap((*one)[2], (*one)[3]);
    }
    car.go(2, -turning);
    EXPECT_NEAR(car.front(), -front, 1e-9) << "to the right as to the left";
    EXPECT_NEAR(car.rear(), -rear, 1e-9);
    EXPECT_GT(car.activity(), 0);
}

TEST(ActiveAntiRoll, AsksForNoMoreThanThereIs) {
    MadeUpBars car;
    car.travel = {0.3, -0.3, -0.5, 0.5};
    car.go(2, turning);
    EXPECT_EQ(car.front(), 1);
    EXPECT_EQ(car.rear(), -1);
    EXPECT_EQ(car.activity(), 1);
}

TEST(ActiveAntiRoll, SharesTheStiffness) {
    for (const double share : {0.0, 0.25, 1.0}) {
        MadeUpBars car({{"front_share", share}, {"stiffness_N_per_m", 40e3}});
        car.travel = {0.02, -0.02, 0.02, -0.02};
        car.go(2, turning);
        EXPECT_NEAR(car.front() * max_force, share * 40e3 * 0.04, 1e-6);
        EXPECT_NEAR(car.rear() * max_force, (1 - share) * 40e3 * 0.04, 1e-6);
    }
}

// Between half a meter per second squared and what the file says they come in, as the lag of 0.1 s shows the turn.
TEST(ActiveAntiRoll, TellsATurnFromABump) {
    constexpr double full = 3, straight = 0.5, rate = 1000;
    MadeUpBars car({{"full_from_m_per_s2", full}, {"stiffness_N_per_m", 40e3}, {"front_share", 0.6}}, rate);
    car.travel = {0.02, -0.02, 0.02, -0.02};
    double seen = 0, least = 1;
    const auto expect_after = [&](int decisions, double lateral) {
        for (int i = 0; i < decisions; ++i) seen += (lateral - seen) / (0.1 * rate);
        car.go(decisions / rate, lateral);
        const double share = std::clamp((seen - straight) / (full - straight), 0.0, 1.0);
        EXPECT_NEAR(car.front(), share * 0.6 * 40e3 * 0.04 / max_force, 1e-12);
        return car.front();
    };
    EXPECT_EQ(expect_after(2000, 0.49), 0) << "a road that leans";
    EXPECT_EQ(expect_after(10, 0), 0);
    for (const int decisions : {20, 50, 100, 200}) least = std::min(least, expect_after(decisions, full + 1));
    EXPECT_GT(least, 0) << "a turn that goes on";
    EXPECT_NEAR(expect_after(1000, full + 1), 0.6 * 40e3 * 0.04 / max_force, 1e-12) << "in full";
    EXPECT_EQ(expect_after(1000, 0), 0) << "over";
    EXPECT_EQ(expect_after(10, 4), 0) << "a blow of 10 ms";
}

TEST(ActiveAntiRoll, WantsABarWithAnActuator) {
    const ControllerKind& kind = *find_controller_kind("active_anti_roll");
    VehicleDescription car = MadeUpBars::vehicle();
    EXPECT_EQ(kind.lacks(car), "");
    for (AntiRollBarDescription& bar : car.anti_roll_bars) bar.max_force = 0;
    EXPECT_EQ(kind.lacks(car), "an [axle.anti_roll_bar.actuator]");
    car.anti_roll_bars.clear();
    EXPECT_NE(kind.lacks(car), "");
}

}  // namespace
}  // namespace hamilcar
