// The picture of a vehicle against what the linkages must keep: rods their lengths, hinges their bushes, contacts the road.
#include "hamilcar/run/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "hamilcar/run/channels.hpp"
#include "hamilcar/suspension/recipe.hpp"
#include "support/fleet.hpp"
#include "support/hardpoints.hpp"
#include "support/json_schema.hpp"

namespace hamilcar {
namespace {

class Pictures : public testing::TestWithParam<std::string> {
protected:
    Pictures() : car_(test::shipped(GetParam())), scene_(make_scene(car_)), simulation_(car_, scenario()) {}

    // Every input moves; trailers swing.
    ScenarioDescription scenario() const { return test::everything_moves(car_, 1.5); }
    void drive(double until) {
        while (simulation_.time() < until) ASSERT_FALSE(simulation_.advance().has_value());
    }
    std::size_t unit_of(std::size_t frame) const { return scene_.frames[frame].unit; }
    // In the axes of its unit.
    Vec3<double> place(const Sample& sample, const FramePoint& point) const {
        const Vec3<double> p(point.point[0], point.point[1], point.point[2]);
        const bool chassis = point.frame < 1 + car_.trailers.size();
        return chassis ? p : scene_.frames[point.frame].pose(sample).point(p);
    }
    static double length_at_design(const SceneLink& link) {
        return std::hypot(link.a.point[0] - link.b.point[0], link.a.point[1] - link.b.point[1],
                          link.a.point[2] - link.b.point[2]);
    }
    double read(const Sample& sample, const std::string& name) const {
        for (const Channel& channel : all_channels(car_)) {
            if (channel.column.name == name) return channel.read(sample);
        }
        ADD_FAILURE() << name;
        return 0;
    }

    VehicleDescription car_;
    Scene scene_;
    Simulation simulation_;
};

// Rods are what cut joints keep the length of, and a carrier that its picture showed elsewhere would stretch them. A file may
// state an arm's length a little off its hardpoints'; that much a rod may differ from the picture at design, not while moving.
TEST_P(Pictures, KeepTheLengthOfEveryRod) {
    std::vector<double> first;
    for (const double until : {0.0, 0.6, 1.1, 1.5}) {
        drive(until);
        const Sample sample = simulation_.sample();
        std::size_t i = 0;
        for (const SceneLink& link : scene_.links) {
            if (link.kind != LinkKind::rod) continue;
            const double length = (place(sample, link.a) - place(sample, link.b)).norm();
            if (until == 0) first.push_back(length);
            EXPECT_NEAR(length, first[i++], 1e-8) << link.name << " at " << until;
            EXPECT_NEAR(length, length_at_design(link), 2e-3) << link.name;
        }
    }
}

TEST_P(Pictures, KeepTheSizeOfEveryPart) {
    drive(1);
    const Sample sample = simulation_.sample();
    for (const SceneLink& link : scene_.links) {
        if (link.a.frame != link.b.frame) continue;
        EXPECT_NEAR((place(sample, link.a) - place(sample, link.b)).norm(), length_at_design(link), 1e-12) << link.name;
    }
}

// A point on a joint's axis is where both of its parts say it is.
TEST_P(Pictures, HingeTheirPartsAtTheBushes) {
    drive(1.2);
    const Sample sample = simulation_.sample();
    for (const SuspensionDescription& suspension : car_.suspensions) {
        const auto frame = [&](std::size_t part) {
            if (part == 0) return suspension.unit;
            std::string name = suspension.name + "." + suspension.linkage.joints[part - 1].part;
            std::ranges::replace(name, ' ', '_');
            for (std::size_t i = 0; i < scene_.frames.size(); ++i) {
                if (scene_.frames[i].name == name) return i;
            }
            ADD_FAILURE() << name;
            return std::size_t{0};
        };
        for (std::size_t i = 0; i < suspension.linkage.joints.size(); ++i) {
            const TreeJointDescription& joint = suspension.linkage.joints[i];
            if (joint.kind == TreeJoint::free || joint.kind == TreeJoint::prismatic) continue;
            for (const Point& bush : {joint.point, joint.other_bush.value_or(joint.point)}) {
                EXPECT_NEAR((place(sample, {frame(i + 1), bush}) - place(sample, {frame(joint.parent), bush})).norm(),
                            0, 1e-9)
                    << suspension.name << " " << joint.part;
            }
        }
    }
}

TEST_P(Pictures, HaveTheirWheelsWhereTheTravelSays) {
    drive(1);
    const Sample sample = simulation_.sample();
    for (const SceneWheel& wheel : scene_.wheels) {
        const double travel = place(sample, {wheel.frame, wheel.center})[2] - wheel.center[2];
        EXPECT_NEAR(travel, read(sample, wheel.name + ".wheel.travel"), 1e-12) << wheel.name;
        const Vec3<double> axis = scene_.frames[wheel.frame].pose(sample).direction(
            Vec3<double>(wheel.axis[0], wheel.axis[1], wheel.axis[2]));
        const double steer = 180 / std::numbers::pi * std::atan2(-axis[0], axis[1]);
        EXPECT_NEAR(steer, read(sample, wheel.name + ".wheel.steer"), 1e-9) << wheel.name;
    }
}

TEST_P(Pictures, CarryTheWeightAtContactsOnTheRoad) {
    const Simulation standing(car_, test::scenario(1));
    const Sample sample = standing.sample();
    double weight = 0;
    for (const std::string& tire : scene_.tires) {
        EXPECT_NEAR(read(sample, tire + ".contact.z"), 0, 1e-9) << tire;
        weight += read(sample, tire + ".ground_force.z");
    }
    const Vehicle<double>& vehicle = sample.model.vehicle;
    EXPECT_NEAR(weight, vehicle.total_mass * vehicle.gravity, 1e-6 * weight);
}

TEST_P(Pictures, SayTheSameAsJson) {
    ScenarioDescription s = scenario();
    s.cones = {{10, 1.5}, {20, -1.5}};
    s.road.patches = {{.start = 5, .end = 8, .friction = 0.2}};
    const auto json = nlohmann::json::parse(scene_json(car_, s));
    EXPECT_EQ(test::PageSchema().mistake(json, "scene"), "");
    ASSERT_EQ(json["frames"].size(), scene_.frames.size());
    ASSERT_EQ(json["links"].size(), scene_.links.size());
    EXPECT_EQ(json["units"], 1 + car_.trailers.size());
    EXPECT_EQ(json["wheels"].size(), scene_.wheels.size());
    EXPECT_EQ(json["road"]["cones"][1][1], -1.5);
    EXPECT_EQ(json["road"]["uneven"], false);
    EXPECT_EQ(json["road"]["patches"][0]["friction"], 0.2);
    EXPECT_GT(json["road"]["patches"][0]["y"][1].get<double>(), 100);  // everywhere, and yet a number
    std::set<std::string> names;
    for (const Channel& channel : all_channels(car_)) names.insert(channel.column.name);
    for (const auto& frame : json["frames"]) {
        for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
            EXPECT_TRUE(names.contains(frame["name"].get<std::string>() + ".pose." + part)) << frame;
        }
    }
    for (const auto& link : json["links"]) {
        EXPECT_LT(link["a"]["frame"], scene_.frames.size());
        EXPECT_LT(link["b"]["frame"], scene_.frames.size());
    }
}

INSTANTIATE_TEST_SUITE_P(Fleet, Pictures, testing::ValuesIn(test::fleet()),
                         [](const auto& named) { return named.param; });

TEST_P(Pictures, HaveABodyOfItsStyleForEveryUnitThatHoldsItsWheels) {
    ASSERT_EQ(scene_.bodies.size(), 1 + car_.trailers.size());
    for (const SceneBody& body : scene_.bodies) EXPECT_TRUE(body.style.has_value()) << body.unit;
    for (const SceneWheel& wheel : scene_.wheels) {
        const SceneBody& body = scene_.bodies[unit_of(wheel.frame)];
        EXPECT_LT(wheel.center[0], body.high[0]) << wheel.name;
        EXPECT_GT(wheel.center[0], body.low[0]) << wheel.name;
        EXPECT_GT(wheel.center[2], 0) << wheel.name;
        EXPECT_LT(wheel.center[2], body.high[2]) << wheel.name;
    }
}

// A page finds a channel by its role and by whose it is: two of the same would hide each other.
TEST_P(Pictures, HaveNoTwoChannelsOfTheSameRole) {
    std::set<std::pair<io::ChannelRole, std::string>> known;
    for (const Channel& channel : all_channels(car_)) {
        if (channel.column.role == io::ChannelRole::none) continue;
        EXPECT_TRUE(known.emplace(channel.column.role, channel.column.of).second) << channel.column.name;
    }
    for (const SceneFrame& frame : scene_.frames) {
        EXPECT_TRUE(known.contains({io::ChannelRole::pose_qz, frame.name})) << frame.name;
    }
    for (const std::string& tire : scene_.tires) {
        EXPECT_TRUE(known.contains({io::ChannelRole::ground_force_z, tire})) << tire;
        EXPECT_TRUE(known.contains({io::ChannelRole::vertical_force, tire})) << tire;
    }
    for (const SceneWheel& wheel : scene_.wheels) {
        EXPECT_TRUE(known.contains({io::ChannelRole::wheel_spin, wheel.name})) << wheel.name;
    }
}

// A strut is a coil around a tube from the top mount to the carrier, two arms meet in the ball, the tie rod ends on the rack.
TEST(Picture, OfTheCarShowsItsOwnHardpoints) {
    const VehicleDescription car = test::paper_car();
    const Scene scene = make_scene(car);
    const test::MacPhersonPoints strut = test::strut_points(car.suspensions[0]);
    std::vector<Point> ends;
    for (const SceneLink& link : scene.links) {
        if (link.name == car.suspensions[0].name + ".strut" && link.kind == LinkKind::strut) {
            ends = {link.a.point, link.b.point};
        }
    }
    EXPECT_THAT(ends, testing::UnorderedElementsAre(strut.strut_top, strut.slide_point));
    std::vector<Point> arm, rod;
    for (const SceneLink& link : scene.links) {
        if (link.kind != LinkKind::rod) continue;
        if (link.name == car.suspensions[0].name + ".control arm")
            arm.push_back(link.a.point), arm.push_back(link.b.point);
        if (link.name == car.suspensions[0].name + ".tie rod") rod = {link.a.point, link.b.point};
    }
    EXPECT_THAT(arm,
                testing::UnorderedElementsAre(strut.ball_joint, strut.arm_front, strut.ball_joint, strut.arm_rear));
    EXPECT_THAT(rod, testing::UnorderedElementsAre(strut.tie_rod_outer, strut.rack_end));
}

// A bar from bush to bush, an arm on either side, and the drop links at their ends.
TEST(Picture, OfABarShowsItsArms) {
    const VehicleDescription car =
        test::shipped_with("bmw_323i", "front",
                           "anti_roll_bar = {rate_N_m_per_rad = 900, pivot_m = [-0.3, 0.45, 0.2], arm_end_m = [0.0, "
                           "0.56, 0.21], link_m = [0.02, 0.58, 0.5]}");
    const Scene scene = make_scene(car);
    const auto ends = [&](const std::string& name, LinkKind kind) {
        std::vector<Point> out;
        for (const SceneLink& link : scene.links) {
            if (link.name == name && link.kind == kind) out.push_back(link.a.point), out.push_back(link.b.point);
        }
        return out;
    };
    const Point pivot{-0.3, 0.45, 0.2}, end{0.0, 0.56, 0.21}, link{0.02, 0.58, 0.5};
    EXPECT_EQ(ends("anti-roll bar", LinkKind::body), (std::vector<Point>{pivot, mirrored(pivot)}));
    EXPECT_THAT(ends("front_left.drop link", LinkKind::rod), testing::UnorderedElementsAre(end, link));
    EXPECT_THAT(ends("front_right.bar arm", LinkKind::body), testing::Contains(mirrored(end)));
}

}  // namespace
}  // namespace hamilcar
