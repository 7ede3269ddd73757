// The preview controller keeps cars on their paths that differ from its internal model: the ISO 3888-1 double lane change, circles
// up to the friction limit, and the limits of the steering wheel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "driver/single_track.hpp"
#include "support/allocation_guard.hpp"

namespace hamilcar {
namespace {

using test::SingleTrack;
constexpr double pi = std::numbers::pi;

// A path through the lanes of ISO 3888-1: 3.5 m to the left between 15 and 45 m, back between 70 and 95 m, using the clearance of
// the lanes.
PathDescription double_lane_change() {
    const auto rise = [](double share) { return 0.5 - 0.5 * std::cos(pi * std::clamp(share, 0.0, 1.0)); };
    PathDescription path;
    for (double x = -40; x <= 200; x += 3) {
        path.points.push_back({x, 3.5 * (rise((x - 8) / 44) - rise((x - 63) / 39))});
    }
    return path;
}

PathDescription circle(double radius) {
    PathDescription path{.closed = true};
    for (int i = 0; i < 36; ++i) {
        const double angle = pi * i / 18;
        path.points.push_back({radius * std::sin(angle), radius * (1 - std::cos(angle))});
    }
    return path;
}

struct Drive {
    double worst = 0, last = 0;                   // offset [m]
    double fastest_turn = 0, most_angle = 0;      // of the steering wheel [rad/s], [rad]
    double most_acceleration = 0, rate_jump = 0;  // lateral [m/s^2]; of the rack, beyond its acceleration [m/s]
};

Drive drive(SingleTrack car, const PathFollowerDescription& description, double duration, double gain = 0) {
    constexpr double h = 1e-3, angle_per_rack = 2 * pi / SingleTrack::rack_per_revolution;
    constexpr int interval = 5;  // steps
    const PathFollower follower(description, car.known(), SingleTrack::column());
    PathMemory memory;
    SignalValue<double> rack;
    Drive out;
    for (int i = 0; i * h < duration; ++i) {
        if (i % interval == 0) {
            follower.update(car.observation(i * h), memory);
            rack = follower.steer(car.observation(i * h), {car.rack, car.rack_rate, 0}, interval * h, memory);
            out.rate_jump =
                std::max({out.rate_jump, std::abs(rack.rate - car.rack_rate), std::abs(rack.value - car.rack)});
            out.worst = std::max(out.worst, std::abs(memory.offset)), out.last = memory.offset;
        }
        car.step(rack.acceleration, h);
        car.speed += gain * h;
        out.fastest_turn = std::max(out.fastest_turn, angle_per_rack * std::abs(car.rack_rate));
        out.most_angle = std::max(out.most_angle, angle_per_rack * std::abs(car.rack));
        out.most_acceleration = std::max(out.most_acceleration, std::abs(car.acceleration));
    }
    return out;
}

SingleTrack at(double speed, double friction = 0) {
    SingleTrack car;
    car.speed = speed, car.friction = friction;
    return car;
}

TEST(PathFollower, DrivesTheDoubleLaneChangeAt80KilometersPerHour) {
    for (const double friction : {0.0, 1.0}) {
        SingleTrack car = at(80 / 3.6, friction);
        car.x = -40;
        const Drive driven = drive(car, {.path = double_lane_change()}, 8);
        EXPECT_LT(driven.worst, 0.2);
        EXPECT_NEAR(driven.last, 0, 0.05);
        EXPECT_EQ(driven.rate_jump, 0) << "the rack moves continuously";
        EXPECT_LT(driven.fastest_turn, 5);
        EXPECT_GT(driven.most_acceleration, 4);
    }
}

// Stiff or compliant axles, light or heavy: the internal model need not be exact.
TEST(PathFollower, HandlesOtherCars) {
    const auto driven = [](double front_stiffness, double rear_stiffness, double inertia) {
        SingleTrack car = at(80 / 3.6);
        car.x = -40;
        car.front_stiffness = front_stiffness, car.rear_stiffness = rear_stiffness, car.inertia = inertia;
        return drive(car, {.path = double_lane_change()}, 8).worst;
    };
    EXPECT_LT(driven(60e3, 140e3, 2600), 0.4) << "understeers";
    EXPECT_LT(driven(110e3, 100e3, 2600), 0.1) << "hardly understeers";
    EXPECT_LT(driven(80e3, 105e3, 4500), 0.3) << "turns in late";
}

TEST(PathFollower, KeepsACircleWithoutAnError) {
    for (const double speed : {5.0, 15.0, 25.0}) {
        const Drive driven = drive(at(speed), {.path = circle(100)}, 40);
        EXPECT_NEAR(driven.last, 0, 0.002) << speed;
        EXPECT_LT(driven.worst, 0.2) << speed << ": a circle without a transition";
    }
}

TEST(PathFollower, KeepsACircleUpToTheFrictionLimit) {
    const Drive driven = drive(at(10, 1), {.path = circle(100)}, 100, 0.2);
    EXPECT_GT(driven.most_acceleration, 8.9);
    EXPECT_LT(driven.worst, 0.2);
}

TEST(PathFollower, SteersLessWithALongerPreview) {
    SingleTrack car = at(80 / 3.6);
    car.x = -40;
    const Drive near = drive(car, {.path = double_lane_change(), .preview_time = 0.4}, 8);
    const Drive far = drive(car, {.path = double_lane_change(), .preview_time = 0.9}, 8);
    EXPECT_LT(near.worst, far.worst);
    EXPECT_GT(near.fastest_turn, far.fastest_turn);
}

TEST(PathFollower, ReturnsFromALargeOffset) {
    for (const double speed : {3.0, 15.0, 30.0}) {
        SingleTrack car = at(speed, 1);
        car.y = 6;
        const Drive driven = drive(car, {.path = {.points = {{-10, 0}, {500, 0}}}}, 16);
        EXPECT_LT(driven.worst, 6.01) << speed;
        EXPECT_NEAR(driven.last, 0, 0.1) << speed;
        EXPECT_LT(driven.most_acceleration, 8) << speed;
    }
}

TEST(PathFollower, RespectsLimitsOfAngleAndRate) {
    SingleTrack car = at(5);
    car.y = 8;
    const PathFollowerDescription description{
        .path = {.points = {{-10, 0}, {500, 0}}}, .largest_angle = 1.5, .largest_rate = 3};
    const Drive driven = drive(car, description, 20);
    EXPECT_LE(driven.most_angle, 1.5 + 1e-9);
    EXPECT_GT(driven.most_angle, 1.4);
    EXPECT_LE(driven.fastest_turn, 3 + 1e-9);
    EXPECT_GT(driven.fastest_turn, 2.9);
}

TEST(PathFollower, DoesNotSteerAtAStandstill) {
    SingleTrack car = at(0);
    car.y = 2;
    EXPECT_EQ(drive(car, {.path = {.points = {{-10, 0}, {500, 0}}}}, 3).most_angle, 0);
}

// A mirrored maneuver is mirrored to the last bit.
TEST(PathFollower, IsMirrorSymmetric) {
    const auto first_turn = [](double side) {
        SingleTrack car = at(20);
        car.y = 0.4 * side, car.yaw = 0.02 * side, car.yaw_rate = 0.1 * side;
        PathFollowerDescription description{.path = {.points = {{-10, 0}, {30, 2 * side}, {60, -side}, {90, 0}}}};
        const PathFollower follower(description, car.known(), SingleTrack::column());
        PathMemory memory;
        follower.update(car.observation(0), memory);
        return follower.steer(car.observation(0), {1e-3 * side, 2e-3 * side, 0}, 5e-3, memory).acceleration;
    };
    EXPECT_EQ(first_turn(1), -first_turn(-1));
    EXPECT_NE(first_turn(1), 0);
}

TEST(PathFollower, RequiresASteeringWheel) {
    EXPECT_THROW(PathFollower({.path = circle(20)}, {}, Column()), std::invalid_argument);
}

TEST(PathFollower, AllocatesNothing) {
    const SingleTrack car;
    const PathFollower follower({.path = circle(100)}, car.known(), SingleTrack::column());
    PathMemory memory;
    const test::AllocationGuard guard;
    follower.update(car.observation(0), memory);
    follower.steer(car.observation(0), {}, 5e-3, memory);
    EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace hamilcar
