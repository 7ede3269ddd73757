#include "maneuver/straight_support.hpp"

namespace hamilcar::test {
namespace {

// A class has four times the power of the one before it, and the same seed the same phases: twice as high at every place. The
// car answers in proportion while its wheels stay on the road.
TEST(RoughRoad, TheNextClassIsTwiceAsRough) {
    const Outcome smooth = driven_straight(rough_road(), shipped_car(), {{"road_class", 1}, {"length", 150}});
    const Outcome rougher = driven_straight(rough_road(), shipped_car(), {{"road_class", 2}, {"length", 150}});
    for (const char* name : {"a_wz", "a_wy", "VDV along z", "load variation of axle 1 (front)"}) {
        EXPECT_NEAR(figure_named(rougher, name), 2 * figure_named(smooth, name), 0.1 * figure_named(smooth, name))
            << name;
    }
    EXPECT_NEAR(figure_named(rougher, "crest factor along z"), figure_named(smooth, "crest factor along z"), 0.2);
}

TEST(RoughRoad, FiguresBelongTogether) {
    const Outcome outcome = driven_straight(rough_road(), shipped_car());
    const double x = figure_named(outcome, "a_wx"), y = figure_named(outcome, "a_wy"),
                 z = figure_named(outcome, "a_wz");
    EXPECT_NEAR(figure_named(outcome, "a_v"), std::sqrt(x * x + y * y + z * z), 1e-9);
    EXPECT_GE(figure_named(outcome, "MTVV along z"), z);
    EXPECT_NEAR(figure_named(outcome, "mean speed"), 80, 1);
    EXPECT_FALSE(outcome.notes.empty());
    const double duration = 300 / (80 / 3.6);  // [s]; of a Gaussian series the fourth moment is three
    EXPECT_NEAR(figure_named(outcome, "VDV along z"), z * std::pow(3 * duration, 0.25),
                0.15 * z * std::pow(3 * duration, 0.25));
}

TEST(RoughRoad, TheSameSeedIsTheSameRoad) {
    const Settings brief{{"length", 60}};
    const double once = figure_named(driven_straight(rough_road(), shipped_car(), brief), "a_v");
    EXPECT_EQ(once, figure_named(driven_straight(rough_road(), shipped_car(), brief), "a_v"));
    EXPECT_NE(once, figure_named(driven_straight(rough_road(), shipped_car(), {{"length", 60}, {"seed", 2}}), "a_v"));
}

TEST(RoughRoad, RefusesAndStops) {
    expect_bad_settings(rough_road(), {{"road_class", 9}});
    expect_interruptible(rough_road());
}

}  // namespace
}  // namespace hamilcar::test
