#include "maneuver/straight_support.hpp"

namespace hamilcar::test {
namespace {

TEST(Cleat, SmallCleatsKnockInProportion) {
    const Outcome none = driven_straight(cleat(), shipped_car(), {{"height", 0}});
    EXPECT_LT(figure_named(none, "peak acceleration upward"), 0.02);
    EXPECT_NEAR(figure_named(none, "largest load of axle 1 (front)"), 100, 1);
    const Outcome one = driven_straight(cleat(), shipped_car(), {{"height", 2}});
    const Outcome two = driven_straight(cleat(), shipped_car(), {{"height", 4}});
    for (const char* name : {"peak acceleration upward", "peak acceleration downward", "a_wz"}) {
        EXPECT_NEAR(figure_named(two, name), 2 * figure_named(one, name), 0.2 * figure_named(one, name)) << name;
    }
    EXPECT_NEAR(figure_named(two, "largest load of axle 1 (front)") - 100,
                2 * (figure_named(one, "largest load of axle 1 (front)") - 100), 0.4);
}

// A wheel that went over it rigidly, at the height that the tire's patch leaves of it (docs/models/roads.md: a third), would
// carry the tire's stiffness times that more; it gives way, but damping and its own inertia add to it.
TEST(Cleat, TheLoadIsThatOfTheTiresStiffness) {
    const Outcome outcome = driven_straight(cleat(), shipped_car());
    const double rigid = 180e3 * 0.025 * 4 / 12 / 3090;  // of the load of a front wheel [1]
    const double more = figure_named(outcome, "largest load of axle 1 (front)") / 100 - 1;
    EXPECT_GT(more, 0.5 * rigid);
    EXPECT_LT(more, 2 * rigid);
    EXPECT_LT(figure_named(outcome, "a_wy"), 0.01) << "both sides at once";
    EXPECT_GT(figure_named(outcome, "decay"), 0);
}

TEST(Cleat, ThrowsWheelsOffTheRoadWhereItIsHigh) {
    const Outcome outcome = driven_straight(cleat(), shipped_car(), {{"height", 80}, {"length", 300}, {"speed", 30}});
    EXPECT_EQ(figure_named(outcome, "least load of axle 1 (front)"), 0);
    EXPECT_FALSE(outcome.failed);
}

TEST(Cleat, RefusesAndStops) {
    expect_bad_settings(cleat(), {{"speed", 0}});
    expect_interruptible(cleat());
}

}  // namespace
}  // namespace hamilcar::test
