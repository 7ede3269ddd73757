// The course of ISO 3888-2 and the search for the highest clean speed.

#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

const Maneuver maneuver = obstacle_avoidance();

using test::figure;

Outcome outcome_of(const VehicleDescription& car, const Settings& chosen) {
    return test::driven(maneuver, car, chosen);
}

TEST(ObstacleAvoidance, LanesAreAsWideAsTheStandardSays) {
    VehicleDescription car = test::shipped_car();
    const auto widths = [&] {
        const Course course = maneuver.course(car, complete_settings(maneuver, car, {}));
        std::vector<double> out;
        for (std::size_t i = 0; i < course.boundaries.size(); i += 2) {
            out.push_back(course.boundaries[i + 1].from[1] - course.boundaries[i].from[1]);
        }
        return out;
    };
    const double b = footprint(car).width();
    EXPECT_NEAR(widths().at(0), 1.1 * b + 0.25, 1e-12);
    EXPECT_NEAR(widths().at(1), b + 1, 1e-12);
    EXPECT_NEAR(widths().at(2), 3, 1e-12);  // 1.3 b + 0.25 is less
    for (Point& point : car.hull.points) point[1] *= 1.5;
    EXPECT_NEAR(widths().at(2), 1.3 * 1.5 * b + 0.25, 1e-9);
    const Course course = maneuver.course(car, complete_settings(maneuver, car, {}));
    EXPECT_EQ(course.boundaries.back().to[0], 61);
    EXPECT_NEAR(course.boundaries[2].from[1] - course.boundaries[1].from[1], 1, 1e-12);
}

// Between two lanes the center of mass goes aside by what the widths leave no way around, over a gap less the car's
// own length: a = 4 y / t^2 at least, with the acceleration there and back. Tires give about 1 g.
TEST(ObstacleAvoidance, FindsTheHighestCleanSpeed) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = outcome_of(car, {});
    const double highest = figure(outcome, "highest clean entry speed");
    EXPECT_GT(highest, 45);
    EXPECT_LT(highest, 90);
    EXPECT_TRUE(outcome_of(car, {{"speed", highest}, {"search", 0}}).passed());
    EXPECT_FALSE(outcome_of(car, {{"speed", highest + 15}, {"search", 0}}).passed());
}

TEST(ObstacleAvoidance, TheFootIsOffTheThrottle) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"speed", 45}, {"search", 0}});
    EXPECT_NEAR(figure(outcome, "entry speed"), 45, 0.5);
    EXPECT_LT(figure(outcome, "exit speed"), 43);
}

TEST(ObstacleAvoidance, SaysWhichSettingIsWrong) {
    const VehicleDescription car = test::shipped_car();
    EXPECT_THROW(complete_settings(maneuver, car, {{"search", 2}}), io::Error);
}

}  // namespace
}  // namespace hamilcar
