// A right side of its own: what [axle.right] says counts there and nowhere else, and what is one for both sides is refused.
#include <cmath>

#include "hamilcar/analysis/linear_model.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "io/files.hpp"
#include "support/fleet.hpp"

namespace hamilcar::io {
namespace {

using test::shipped;
using test::shipped_with;

// The same numbers, said for the right side once more.
TEST(RightSide, ThatSaysTheSameIsTheMirrorImage) {
    const VehicleDescription plain = shipped("bmw_323i");
    const VehicleDescription twice =
        shipped_with("bmw_323i", "front",
                     "right.spring.rate_N_per_m = 26200.0\nright.wheel.camber_deg = -0.69\n"
                     "right.anti_roll_bar.rate_N_per_m = 3493.0\n");
    Simulation one(plain, test::everything_moves(plain, 1)), other(twice, test::everything_moves(plain, 1));
    while (!one.finished()) ASSERT_FALSE(one.advance() || other.advance());
    EXPECT_EQ(one.state().values, other.state().values) << "bit for bit";
}

TEST(RightSide, DiffersInWhatItSays) {
    const VehicleDescription before = shipped("bmw_323i");
    const VehicleDescription after =
        shipped_with("bmw_323i", "front",
                     "right.spring.rate_N_per_m = 30e3\nright.hardpoints.tie_rod_outer_m = [0.1115, 0.69, 0.2]\n"
                     "right.carrier.mass_kg = 40\nright.bump_stop.gap_m = 0.01\n");
    const SuspensionDescription &left = after.suspensions[0], &right = after.suspensions[1];
    EXPECT_EQ(left.springs[0].spring.rate, before.suspensions[0].springs[0].spring.rate);
    EXPECT_EQ(left.linkage.cuts[1].tip, before.suspensions[0].linkage.cuts[1].tip);
    EXPECT_EQ(left.bodies[0].body.mass, before.suspensions[0].bodies[0].body.mass);
    EXPECT_EQ(right.springs[0].spring.rate, 30e3);
    EXPECT_EQ(right.linkage.cuts[1].tip, (Point{0.1115, -0.69, 0.2}));
    EXPECT_EQ(right.linkage.cuts[0].tip, before.suspensions[1].linkage.cuts[0].tip);
    EXPECT_EQ(right.bodies[0].body.mass, 40);
    EXPECT_EQ(right.wheels[0].bump.gap, 0.01);
    EXPECT_EQ(right.wheels[0].bump.rate, before.suspensions[1].wheels[0].bump.rate);
    EXPECT_EQ(right.wheels[0].name, "front_right");
}

// Where one suspension carries both wheels.
TEST(RightSide, OfASolidAxleHasItsOwnLinksSpringsAndTires) {
    const VehicleDescription before = shipped("offroader");
    const VehicleDescription after =
        shipped_with("offroader", "rear",
                     "right.hardpoints.lower_body_m = [-1.90, 0.46, 0.41]\nright.spring.rate_N_per_m = 20e3\n"
                     "right.wheel.spin_inertia_kg_m2 = 2.5\n");
    const auto rear = [](const VehicleDescription& car) -> const SuspensionDescription& {
        return car.suspensions.back();
    };
    ASSERT_EQ(rear(after).wheels.size(), 2u);
    EXPECT_EQ(rear(after).linkage.cuts[0].foot, rear(before).linkage.cuts[0].foot);
    EXPECT_EQ(rear(after).linkage.cuts[1].foot, (Point{-1.90, -0.46, 0.41}));
    EXPECT_EQ(rear(after).springs[0].spring.rate, rear(before).springs[0].spring.rate);
    EXPECT_EQ(rear(after).springs[1].spring.rate, 20e3);
    EXPECT_EQ(rear(after).wheels[1].wheel.spin_inertia, 2.5);
    EXPECT_NE(rear(after).wheels[0].wheel.spin_inertia, 2.5);
}

// Its own way to say something counts, as against a base.
TEST(RightSide, MaySayItsAnglesInAnotherWay) {
    const VehicleDescription car = shipped_with("bmw_323i", "front", "right.wheel.spin_axis = [0.0, 1.0, 0.02]\n");
    EXPECT_NEAR(car.suspensions[1].wheels[0].wheel.spin_axis[2], -0.02, 1e-5);
    EXPECT_GT(car.suspensions[0].wheels[0].wheel.spin_axis[2], 0.01) << "negative camber";
}

void expect_refusal(const std::string& vehicle, const std::string& axle, const std::string& keys,
                    const std::vector<std::string>& pieces) {
    expect_error([&] { shipped_with(vehicle, axle, keys); }, ExitCode::bad_file, pieces);
}

TEST(RightSide, HasNothingOfItsOwnThatIsOneForBoth) {
    expect_refusal("bmw_323i", "front", "right.name = \"x\"",
                   {"'axle[front].right.name'", "no such key: it is one for both sides, in axle[front]"});
    expect_refusal("bmw_323i", "front", "right.anti_roll_bar.rate_N_per_m = 1.0",
                   {"right.anti_roll_bar.rate_N_per_m' = 1.0", "the left side's: the bar is one for both sides"});
    expect_refusal("bmw_323i", "front", "right.hardpoints.rack_axis = [0, -1, 0]",
                   {"right.hardpoints.rack_axis'", "the left side's: it is one for both sides"});
    expect_refusal("offroader", "rear", "right.carrier.mass_kg = 90.0",
                   {"'axle[rear].right.carrier'", "it is one part for both sides"});
    expect_refusal("bmw_323i", "front", "right.sprang.rate = 1",
                   {"right.sprang'", "is unknown: did you mean 'spring'?"});
    expect_refusal("bmw_323i", "front", "right.spring.rat_N_per_m = 1",
                   {"right.spring.rat_N_per_m'", "did you mean 'rate_N_per_m'"});
    expect_refusal("bmw_323i", "front", "right = 3", {"'axle[front].right' = 3", "a table"});
}

// In a moment, not in a time that grows as the square of its length.
TEST(RightSide, RefusesALongListThatMeansNothing) {
    std::string zeros = "0";
    for (int i = 0; i < 300'000; ++i) zeros += ",0";
    expect_refusal("bmw_323i", "front", "right.nonsense = [" + zeros + "]", {"'axle[front].right.nonsense'"});
}

TEST(AlignmentKeys, AreThoseThatTheSuspensionCanSet) {
    expect_refusal("bmw_323i", "rear", "alignment.camber_deg = -1.0",
                   {"'axle[rear].alignment'", "no camber_deg: this suspension has nothing that sets it"});
    expect_refusal("bmw_323i", "front", "alignment.camber_deg = -20.0",
                   {"'axle[front].alignment'", "angles that its linkage can be set to"});
}

TEST(AntiRollBar, NeedsAnArmAndALink) {
    const std::string bar = "anti_roll_bar = {rate_N_m_per_rad = 900.0, pivot_m = [-0.3, 0.45, 0.2], ";
    expect_refusal("bmw_e90_330i", "rear", bar + "arm_end_m = [-0.3, 0.5, 0.2], link_m = [-0.3, 0.5, 0.4]}",
                   {"anti_roll_bar.arm_end_m'", "a point apart from the bar's axis"});
    expect_refusal("bmw_e90_330i", "rear", bar + "arm_end_m = [-0.1, 0.5, 0.2], link_m = [-0.1, 0.5, 0.2]}",
                   {"anti_roll_bar.link_m'", "a point apart from 'arm_end_m'"});
    expect_refusal("bmw_e90_330i", "rear",
                   bar + "arm_end_m = [-0.1, 0.5, 0.2], link_m = [-0.1, 0.5, 0.4], on = \"link_9\"}",
                   {"anti_roll_bar.on' = \"link_9\"", "'link_1'", "'link_2'", "did you mean"});
}

// The drop link is no link that something else may sit on: it is there only with the bar.
TEST(AntiRollBar, CarriesNothingOnItsDropLink) {
    expect_refusal("bmw_e90_330i", "rear",
                   "spring.on = \"drop_link\"\nanti_roll_bar = {rate_N_m_per_rad = 900.0, pivot_m = [-2.6, 0.45, 0.2], "
                   "arm_end_m = "
                   "[-2.7, 0.5, 0.2], link_m = [-2.7, 0.5, 0.3]}",
                   {"spring.on' = \"drop_link\"", "expected one of 'carrier', 'link_1', 'link_2'"});
}

// What a nearer file says of the axle does not count where the right side says it in its own way.
TEST(RightSide, CountsWhereverTheAxlesOwnKeysStand) {
    const TemporaryFolder folder;
    const std::string base =
        folder.write("base.toml", "base = \"" + repository_path("vehicles/bmw_323i.toml") +
                                      "\"\n[[axle]]\nname = \"front\"\nright.wheel.spin_axis = [0, 1, 0.02]\n");
    const std::string top =
        folder.write("top.toml", "base = \"base.toml\"\n[[axle]]\nname = \"front\"\nwheel.camber_deg = -1.0\n");
    const VehicleDescription car = read_vehicle(top);
    EXPECT_NEAR(car.suspensions[1].wheels[0].wheel.spin_axis[2], -0.02, 1e-5);
    EXPECT_NEAR(car.suspensions[0].wheels[0].wheel.spin_axis[2], 0.01745, 1e-4);
}

// A rod with a length of its own may carry something, too: its outer ball is that far out.
TEST(RightSide, MayHaveAnArmOfAnotherLengthThatIsAPart) {
    const std::string keys =
        "right.hardpoints.arm_length_m = 0.33\ncontrol_arm = {mass_kg = 2.0, center_of_mass_m = [-0.1, 0.5, 0.18], "
        "inertia_kg_m2 = [0.02, 0.02, 0.02]}\n";
    const VehicleDescription car = shipped_with("bmw_323i", "front", keys);
    for (const std::size_t s : {0, 1}) {
        const SuspensionDescription& side = car.suspensions[s];
        ASSERT_EQ(side.bodies.size(), 2u);
        EXPECT_EQ(side.linkage.joints[side.bodies[1].part - 1].part, "control arm");
        const CutJointDescription& ball = side.linkage.cuts[0];
        const Point& bush = side.linkage.joints.back().point;
        const double out = std::hypot(ball.foot[1] - bush[1], ball.foot[2] - bush[2]);
        if (s == 1) EXPECT_NEAR(out, 0.33, 2e-3);
        EXPECT_EQ(s == 0, ball.foot == ball.tip);
    }
}

TEST(AlignmentKeys, OfASuspensionWithBothWheelsAreForBoth) {
    expect_refusal("offroader", "front", "right.alignment.toe_in_deg = 0.3",
                   {"'axle[front].right.alignment'", "toe of both wheels, since one suspension carries them"});
}

TEST(RightSide, HasNoBarThatTheAxleHasNot) {
    expect_refusal("hatchback", "rear", "right.anti_roll_bar.rate_N_per_m = 9.0",
                   {"'axle[rear].right.anti_roll_bar'", "no such table: the axle itself has none"});
    expect_refusal("bmw_323i", "front", "right.hardpoints.steered = false",
                   {"right.hardpoints.steered' = false", "the left side's: it is one for both sides"});
}

// A seat that is turned up is a force more; the diagonal that it stands on carries more, and the car leans away.
TEST(SpringSeat, ShiftsLoadToItsDiagonal) {
    const VehicleDescription plain = shipped("bmw_323i"),
                             seated = shipped_with("bmw_323i", "front", "right.spring.seat_m = 0.01\n");
    const SpringDescription& spring = seated.suspensions[1].springs[0].spring;
    EXPECT_EQ(spring.seat, 0.01);
    EXPECT_EQ(seated.suspensions[0].springs[0].spring.seat, 0);
    EXPECT_EQ(Vehicle<double>(seated).suspensions[1].springs[0].spring.force_at_design,
              spring.force_at_design + 0.01 * spring.rate);
    const auto loads = [](const VehicleDescription& car) {
        const Linearizer linearizer(car);
        const OperatingPoint rest = linearizer.operating_point({});
        EXPECT_TRUE(rest.found);
        const Momenta<double> momenta = momenta_block(linearizer.model(), rest.state, rest.input,
                                                      velocity_block(linearizer.model(), rest.state, rest.input));
        std::vector<double> out;
        for (std::size_t s = 0; s < car.suspensions.size(); ++s)
            out.push_back(momenta.suspensions[s].wheels[0].tire.Fz);
        return out;
    };
    const auto before = loads(plain), after = loads(seated);
    EXPECT_GT(after[1], before[1] + 20);
    EXPECT_GT(after[2], before[2] + 20);
    EXPECT_LT(after[0], before[0] - 20);
    EXPECT_NEAR(after[0] + after[1] + after[2] + after[3], before[0] + before[1] + before[2] + before[3], 1e-6);
    const auto carried = loads(shipped_with("bmw_323i", "front", "spring.force_at_design_N = \"carry\"\n"));
    const auto turned_up =
        loads(shipped_with("bmw_323i", "front", "spring.force_at_design_N = \"carry\"\nright.spring.seat_m = 0.01\n"));
    EXPECT_NEAR(turned_up[1] - carried[1], after[1] - before[1], 1) << "a seat counts beyond what carries";
}

}  // namespace
}  // namespace hamilcar::io
