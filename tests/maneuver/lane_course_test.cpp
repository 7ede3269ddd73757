// Trailers in a course of lanes: tires set by hand beside cones and borders, and a drive until the last one is out.
#include "hamilcar/maneuver/lane_course.hpp"

#include <gtest/gtest.h>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/course_driver.hpp"
#include "support/fleet.hpp"
#include "support/recording.hpp"

namespace hamilcar {
namespace {

const std::vector<Lane> one_lane{{0, 12, -2, 2}};

// A combination that has rolled straight ahead from one row to the next, its trailer moved aside as a whole. The contacts are
// written out from the description: of dual tires the outer one's.
Recording rolled(const VehicleDescription& truck, double from, double to, double aside) {
    const Point& center = truck.chassis.center_of_mass;
    std::vector<std::string> channels{channel::x, channel::y, channel::heading};
    for (const std::string& wheel : wheel_names(truck)) {
        channels.insert(channels.end(), {channel::contact_x(wheel), channel::contact_y(wheel)});
    }
    return test::recorded(channels, {from, to}, [&](double x) {
        std::vector<double> row{x, 0, 0};
        for_each_wheel(truck, [&](const auto& wheel, std::size_t unit) {
            const Point& at = wheel.wheel.center;
            const double side = at[1] > 0 ? 1 : -1, outer = at[1] + side * 0.5 * wheel.dual_spacing;
            row.push_back(x + at[0] - center[0]);
            row.push_back(outer - center[1] + (unit > 0 ? aside : 0));
        });
        return row;
    });
}

// Beside the trailer's middle, where its outer tires end.
double trailer_edge(const VehicleDescription& truck) {
    const SuspensionWheelDescription& wheel = truck.suspensions.back().wheels.front();
    return std::abs(wheel.wheel.center[1]) + 0.5 * wheel.dual_spacing + half_tire(truck);
}

TEST(LaneCourse, ATrailerHitsCones) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const double room = 2 - trailer_edge(truck);
    // The last axle runs through the whole lane, the tractor is far ahead of it.
    const Passage inside = passage(truck, one_lane, rolled(truck, 11, 30, room - 0.05));
    EXPECT_EQ(inside.cones, 0u);
    EXPECT_TRUE(inside.clean());
    const Passage left = passage(truck, one_lane, rolled(truck, 11, 30, room + 0.05));
    EXPECT_EQ(left.cones, 5u);  // every cone on the left, 3 m apart
    EXPECT_FALSE(left.clean());
    EXPECT_EQ(passage(truck, one_lane, rolled(truck, 11, 30, -room - 0.05)).cones, 5u);
    // A border so far in that the inner tires run over its cones, and one between left and right wheels.
    EXPECT_EQ(passage(truck, one_lane, rolled(truck, 11, 30, room + 2 * half_tire(truck) + 0.335 - 0.05)).cones, 5u);
    EXPECT_EQ(passage(truck, one_lane, rolled(truck, 11, 30, room + trailer_edge(truck))).cones, 0u);
}

TEST(LaneCourse, ATrailersTiresKeepTheirDistanceToTheBorder) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    for (const double aside : {0.6, 1.0, -0.9}) {
        const double clearance = passage(truck, one_lane, rolled(truck, 19, 20, aside)).clearance;
        EXPECT_NEAR(clearance, 2 - trailer_edge(truck) - std::abs(aside), 1e-12) << aside;
    }
}

TEST(LaneCourse, IsCompleteWhenTheTrailerIsOut) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const double last_axle = -14.92 + 1.25;
    EXPECT_FALSE(passage(truck, one_lane, rolled(truck, 11, 12 - last_axle - 0.1, 0)).complete);
    EXPECT_TRUE(passage(truck, one_lane, rolled(truck, 11, 12 - last_axle + 0.1, 0)).complete);
}

TEST(CourseDriver, DrivesOnUntilTheTrailerIsOut) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const LaneChange straight_on{.title = "one lane", .lanes = {{0, 20, -3, 3}}, .lift = {}};
    const Settings settings{{"preview_time", 0.8}, {"attempts", 1}};
    TestRun test(double_lane_change(), truck, settings, {.keep_runs = false});
    CourseDriver driver(test, straight_on, 1);
    const CourseDrive drive = driver.drive(50);
    EXPECT_TRUE(drive.passage.clean());
    for (const std::string& wheel : wheel_names(truck)) {
        EXPECT_GT(drive.drive.recording[channel::contact_x(wheel)].values.back(), 20) << wheel;
    }
}

}  // namespace
}  // namespace hamilcar
