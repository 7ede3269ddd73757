// Drives through courses along prescribed paths: contacts, verdicts, and the end of a run.
#include "hamilcar/live/course_judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hamilcar/live/course_result.hpp"
#include "live/test_catalog.hpp"
#include "support/allocation_guard.hpp"

namespace hamilcar::live {
namespace {

constexpr double update_interval = 0.005;  // [s]

class CourseJudgeTest : public testing::Test {
protected:
    VehicleDescription car = test::paper_car();
    Footprint box = footprint(car);
    CourseJudge judge{gates(), car};

    // Straight ahead at constant speed from x = -60 until the run is over or x = 60, at lateral offset `beside`.
    template <class F>
    CourseResult drive(double speed, const F& beside) {
        judge.begin();
        for (double t = 0; !judge.run().over && speed * t < 120; t += update_interval) {
            const double x = -60 + speed * t;
            judge.update({.time = t, .x = x, .y = beside(x), .speed = speed});
        }
        return course_result(judge.course().course, judge.run());
    }
    CourseResult drive(double speed, double beside = 0) {
        return drive(speed, [beside](double) { return beside; });
    }
    static double value(const CourseResult& result, const std::string& name) {
        for (const Figure& figure : result.values) {
            if (figure.name == name) return figure.value;
        }
        ADD_FAILURE() << "there is no " << name;
        return 0;
    }
};

TEST_F(CourseJudgeTest, PassesCleanRun) {
    const CourseResult result = drive(12.3);
    EXPECT_TRUE(result.finished);
    EXPECT_EQ(result.passed, std::optional(true));
    EXPECT_NEAR(result.time, 20 / 12.3, 1e-9);
    EXPECT_NEAR(value(result, "entry speed"), 12.3 * 3.6, 1e-9);
    EXPECT_NEAR(value(result, "exit speed"), 12.3 * 3.6, 1e-9);
    EXPECT_NEAR(value(result, "mean speed"), 12.3 * 3.6, 1e-6);
    EXPECT_EQ(value(result, "largest lateral acceleration"), 0);
    EXPECT_EQ(result.verdicts.size(), 3u);
}

TEST_F(CourseJudgeTest, StartsEightyMetersBeforeEntry) {
    const CourseJudge::Start start = judge.start();
    EXPECT_NEAR(start.x, -80, 1e-9);
    EXPECT_NEAR(start.y, 0, 1e-9);
    EXPECT_NEAR(start.yaw, 0, 1e-9);
}

TEST_F(CourseJudgeTest, CountsEachConeAndBoundaryOnce) {
    const CourseResult left = drive(10, 2 - box.left + 0.01);
    EXPECT_TRUE(left.finished);
    EXPECT_EQ(left.passed, std::optional(false));
    EXPECT_EQ(judge.run().cones, 2);
    EXPECT_EQ(judge.run().boundaries, 1);
    EXPECT_EQ(left.verdicts[0].found, "1 boundary");
    EXPECT_EQ(left.verdicts[1].found, "2 cones");
    EXPECT_EQ(drive(10, 2 - box.left - 0.01).passed, std::optional(true));
    EXPECT_EQ(drive(10, -2 - box.right + 0.01).passed, std::optional(true));
    EXPECT_EQ(drive(10, -2 - box.right - 0.01).passed, std::optional(false));
}

TEST_F(CourseJudgeTest, FailsOutsideBoundaries) {
    for (const double beside : {-6.0, 6.0}) {
        const CourseResult result = drive(10, beside);
        EXPECT_TRUE(result.finished);
        EXPECT_EQ(result.passed, std::optional(false));
        EXPECT_EQ(judge.run().cones, 0);
        EXPECT_EQ(judge.run().boundaries, 1);
    }
}

TEST_F(CourseJudgeTest, EndsFarFromLine) {
    const CourseResult result = drive(10, [](double x) { return x > 10 ? 3 * (x - 10) : 0.0; });
    EXPECT_TRUE(judge.run().over);
    EXPECT_FALSE(result.finished);
    EXPECT_EQ(result.passed, std::optional(false));
    EXPECT_TRUE(std::isnan(value(result, "exit speed")));
    EXPECT_GT(result.time, 1);
    EXPECT_THAT(result.verdicts.back().found, testing::EndsWith(" m"));
}

// An unfinished run can fail a criterion, but it cannot pass one.
TEST_F(CourseJudgeTest, UnfinishedRunCannotPassCones) {
    const auto turn_off = [](double x) { return x > -10 ? 3 * (x + 10) : 0.0; };
    CourseResult result = drive(10, turn_off);
    EXPECT_FALSE(result.finished);
    EXPECT_EQ(result.passed, std::optional(false));
    EXPECT_EQ(result.verdicts[0].passed, std::nullopt);
    EXPECT_EQ(result.verdicts[1].passed, std::nullopt);
    EXPECT_EQ(result.verdicts[1].found, "");
    EXPECT_EQ(result.verdicts[2].passed, std::optional(false));
    result = drive(10, [&](double x) { return x < 1 ? 2.0 : 3 * x; });
    EXPECT_FALSE(result.finished);
    EXPECT_EQ(result.verdicts[1].passed, std::optional(false));
}

TEST_F(CourseJudgeTest, SummaryNamesCriteria) {
    EXPECT_THAT(judge.course().summary, testing::HasSubstr("no cone may be hit and no boundary crossed"));
}

TEST_F(CourseJudgeTest, AbortEndsRun) {
    judge.update({.time = 0, .x = -60, .speed = 10});
    judge.abort();
    EXPECT_TRUE(judge.run().over);
    const CourseResult result = course_result(judge.course().course, judge.run());
    EXPECT_FALSE(result.finished);
    EXPECT_TRUE(std::isnan(value(result, "entry speed")));
    judge.begin();
    EXPECT_FALSE(judge.run().over);
}

TEST_F(CourseJudgeTest, UpdatesWithoutAllocation) {
    judge.begin();
    const test::AllocationGuard guard;
    for (int i = 0; i < 2000; ++i)
        judge.update({.time = i * update_interval, .x = -60 + 0.05 * i, .y = 1.5, .speed = 10});
    EXPECT_TRUE(judge.run().over);
    EXPECT_EQ(guard.allocations(), 0);
}

// The corners of a yawed car stand out.
TEST_F(CourseJudgeTest, ChecksCornersOfYawedCar) {
    judge.begin();
    const double yaw = 0.3, corner = box.front * std::sin(yaw) + box.left * std::cos(yaw);
    const auto touched = [&](double room) {
        judge.begin();
        for (const double t : {0.0, update_interval})
            judge.update({.time = t, .x = 10, .y = 2 - corner - room, .yaw = yaw});
        return judge.run().boundaries;
    };
    EXPECT_EQ(touched(0.01), 0);
    EXPECT_EQ(touched(-0.01), 1);
}

TEST(CourseJudge, MeasuresLapWithoutCriteria) {
    constexpr double radius = 40, speed = 15, outside = 0.5;
    TestCourse circle{.id = "circle"};
    for (int i = 0; i < 72; ++i) {
        const double angle = i * std::numbers::pi / 36;
        circle.course.line.push_back({radius * std::sin(angle), radius * (1 - std::cos(angle))});
    }
    CourseJudge judge(circle, test::paper_car());
    EXPECT_THAT(judge.course().summary, testing::StartsWith("One lap along the dashed line"));
    const CourseJudge::Start start = judge.start();
    EXPECT_NEAR(std::hypot(start.x, start.y - radius), radius, 1e-3);
    EXPECT_NEAR(start.yaw, -80 / radius, 1e-3);
    const double r = radius + outside;
    for (double t = 0; !judge.run().over && t < 60; t += update_interval) {
        const double angle = -80 / radius + speed / r * t;
        judge.update({.time = t,
                      .x = r * std::sin(angle),
                      .y = radius - r * std::cos(angle),
                      .yaw = std::remainder(angle, 2 * std::numbers::pi),
                      .speed = speed,
                      .yaw_rate = speed / r});
    }
    const CourseResult result = course_result(circle.course, judge.run());
    EXPECT_TRUE(result.finished);
    EXPECT_EQ(result.passed, std::nullopt);
    EXPECT_TRUE(result.verdicts.empty());
    EXPECT_NEAR(result.time, 2 * std::numbers::pi * r / speed, 0.01);
    const auto found = [&](const std::string& name) {
        for (const Figure& figure : result.values) {
            if (figure.name == name) return figure.value;
        }
        return -1.0;
    };
    EXPECT_NEAR(found("mean deviation"), outside, 1e-3);
    EXPECT_NEAR(found("mean lateral acceleration"), speed * speed / r, 1e-6);
}

// Driven by controls, from the start that the course defines.
TEST(LiveSimulation, JudgesDriveThroughCourse) {
    LiveSimulation simulation(1, {"car", "gates"}, test::paper_car(), test::scenario(1), gates());
    EXPECT_NEAR(simulation.state().position()[0], -80, 0.01);
    EXPECT_FALSE(simulation.frames().value().run.over);
    for (int round = 0; round < 2; ++round) {
        CourseRun run;
        for (int i = 0; i < 20000 && !run.over; ++i) {
            ASSERT_FALSE(simulation.advance({.controls = {.throttle = 0.8}}));
            if (i % 10 != 0) continue;
            simulation.publish_frame({});
            simulation.frames().fetch();
            run = simulation.frames().value().run;
        }
        EXPECT_TRUE(run.finished);
        EXPECT_EQ(course_result(simulation.course()->course, run).passed, std::optional(true));
        EXPECT_GT(run.entry_speed, 10);
        simulation.reset();
        simulation.frames().fetch();
        EXPECT_FALSE(simulation.frames().value().run.over);
    }
}

}  // namespace
}  // namespace hamilcar::live
