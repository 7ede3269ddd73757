// The course of ISO 3888-1: its geometry by the standard's widths, cones and clearance of boxes set by hand, and a car that is
// too fast for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/lane_course.hpp"
#include "support/car.hpp"
#include "support/recording.hpp"

namespace hamilcar {
namespace {

const Maneuver maneuver = double_lane_change();

ManeuverOptions quiet() {
    ManeuverOptions options;
    options.keep_runs = false;
    return options;
}

double figure(const Outcome& outcome, const std::string& name) {
    for (const Figure& one : outcome.figures) {
        if (one.name == name) return one.value;
    }
    ADD_FAILURE() << "no figure " << name;
    return 0;
}

// A car that stands for a moment, turned by `yaw`.
Recording standing(double x, double y, double yaw) {
    return test::recorded({channel::x, channel::y, channel::heading}, {0}, [&](double) {
        return std::vector<double>{x, y, yaw / degree};
    });
}

TEST(DoubleLaneChange, LanesAreAsWideAsTheStandardSays) {
    const VehicleDescription car = test::shipped_car();
    const double b = footprint(car).width();
    EXPECT_NEAR(b, 1.64, 0.02);  // overall width of the E30
    const Course course = maneuver.course(car, complete_settings(maneuver, car, {}));
    ASSERT_EQ(course.boundaries.size(), 6u);
    const auto width = [&](std::size_t lane) {
        return course.boundaries[2 * lane + 1].from[1] - course.boundaries[2 * lane].from[1];
    };
    EXPECT_NEAR(width(0), 1.1 * b + 0.25, 1e-12);
    EXPECT_NEAR(width(1), 1.2 * b + 0.25, 1e-12);
    EXPECT_NEAR(width(2), 1.3 * b + 0.25, 1e-12);
    EXPECT_NEAR(course.boundaries[2].from[1] - course.boundaries[0].from[1], 3.5, 1e-12);
    EXPECT_EQ(course.boundaries[4].to[0], 125);
}

TEST(DoubleLaneChange, TheLineLeavesRoomForTheWholeCar) {
    const VehicleDescription car = test::shipped_car();
    const Course course = maneuver.course(car, complete_settings(maneuver, car, {}));
    std::vector<Lane> lanes;
    for (std::size_t i = 0; i < course.boundaries.size(); i += 2) {
        const Gate &right = course.boundaries[i], &left = course.boundaries[i + 1];
        lanes.push_back({right.from[0], right.to[0], right.from[1], left.from[1]});
    }
    const int rows = static_cast<int>(course.line.size()) - 2;
    const auto along_the_line = [&](double time) {
        const auto i = static_cast<std::size_t>(time) + 1;
        const auto &before = course.line[i - 1], &after = course.line[i + 1];
        const double yaw = std::atan2(after[1] - before[1], after[0] - before[0]);
        return std::vector<double>{course.line[i][0], course.line[i][1], yaw / degree};
    };
    const Recording ghost =
        test::recorded({channel::x, channel::y, channel::heading}, test::instants(1, rows), along_the_line);
    const Passage ghostly = passage(car, lanes, ghost);
    EXPECT_TRUE(ghostly.clean());
    EXPECT_GT(ghostly.clearance, 0.05);
}

TEST(LaneCourse, FindsWhatABoxTouches) {
    const VehicleDescription car = test::shipped_car();
    const Footprint box = footprint(car);
    const std::vector<Lane> lanes{{0, 12, -2, 2}};
    const double beside = 2 - box.left;
    EXPECT_NEAR(passage(car, lanes, standing(6, 0, 0)).clearance, beside, 1e-12);
    const Passage across = passage(car, lanes, standing(6, beside + 0.1, 0));
    EXPECT_NEAR(across.clearance, -0.1, 1e-12);
    EXPECT_GT(across.cones, 0u);
    EXPECT_FALSE(across.clean());
    // Turned, its corners are what counts.
    const double yaw = 0.2, farther = std::max(box.front, -box.rear);
    const double corner = std::sin(yaw) * farther + std::cos(yaw) * box.left;
    EXPECT_NEAR(passage(car, lanes, standing(6, 0, yaw)).clearance, 2 - corner, 1e-12);
    // Out of the lane nothing counts, and only behind it the course is complete.
    EXPECT_FALSE(passage(car, lanes, standing(-20, 5, 0)).complete);
    EXPECT_TRUE(passage(car, lanes, standing(20, 5, 0)).clean());
}

TEST(DoubleLaneChange, TheCarPassesAtAModerateSpeed) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, {{"speed", 50}}), quiet());
    EXPECT_TRUE(outcome.passed());
    EXPECT_NEAR(figure(outcome, "entry speed"), 50, 0.5);
    EXPECT_NEAR(figure(outcome, "exit speed"), 50, 2);
    EXPECT_GT(figure(outcome, "least clearance"), 0);
    EXPECT_EQ(figure(outcome, "cones hit"), 0);
    EXPECT_LT(std::abs(outcome.energy.residual()), 1e-3 * outcome.energy.exchanged);
    ASSERT_FALSE(outcome.charts.empty());
    EXPECT_TRUE(outcome.charts[0].equal_axes);
}

// The line through the cones takes an acceleration that grows with the square of the speed. Tires that give 1.045 of the load at most
// (MagicFormula.ShippedSetHasItsDerivedFigures) bound the speed; the driver comes within a quarter of that.
TEST(DoubleLaneChange, TheHighestCleanSpeedIsNearWhatTiresAllow) {
    const VehicleDescription car = test::shipped_car();
    const Settings chosen{{"speed", 80}, {"search", 1}};
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, chosen), quiet());
    EXPECT_TRUE(outcome.passed()) << "the speed of ISO 3888-1";
    const double bound = 80 * std::sqrt(1.045 * car.gravity / figure(outcome, "largest lateral acceleration"));
    const double highest = figure(outcome, "highest clean entry speed");
    EXPECT_LT(highest, bound);
    EXPECT_GT(highest, 0.75 * bound);
}

TEST(DoubleLaneChange, FailsAtASpeedThatTiresCannotHold) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, {{"speed", 170}}), quiet());
    EXPECT_FALSE(outcome.passed());
}

// A car that cannot hold the speed up to the first cones has not driven the course at it, whether or not cones fell. The
// racing car's gears end below 120 km/h.
TEST(DoubleLaneChange, ASpeedThatIsOnlyAskedForIsNotDriven) {
    const VehicleDescription car = io::read_vehicle(test::source_path("vehicles/formula.toml"));
    const Settings chosen{{"speed", 140}, {"search", 1}, {"attempts", 1}};
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, chosen), quiet());
    EXPECT_LT(figure(outcome, "entry speed"), 137);
    ASSERT_EQ(outcome.verdicts.size(), 2u);
    EXPECT_FALSE(outcome.verdicts[0].passed);
    const double highest = figure(outcome, "highest clean entry speed");
    EXPECT_GT(highest, 60);
    EXPECT_LT(highest, 120);
    const auto told = [&](const std::string& words) {
        return std::ranges::any_of(outcome.notes,
                                   [&](const std::string& note) { return note.find(words) != std::string::npos; });
    };
    EXPECT_TRUE(told("no run of that speed"));
}

TEST(DoubleLaneChange, StopsWhenTold) {
    ManeuverOptions options = quiet();
    options.keep_going = [](double done) { return done < 0.05; };
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, {}), options);
    EXPECT_EQ(outcome.failed, "interrupted");
}

TEST(DoubleLaneChange, SaysWhichSettingIsWrong) {
    const VehicleDescription car = test::shipped_car();
    EXPECT_THROW(complete_settings(maneuver, car, {{"speed", 5}}), io::Error);
    EXPECT_THROW(complete_settings(maneuver, car, {{"sped", 80}}), io::Error);
}

}  // namespace
}  // namespace hamilcar
