// The frequency response of ISO 7401 against that of the exact linearization.
#include "hamilcar/maneuver/steering_gain.hpp"
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

TEST(RandomSteer, IsLinearTheorysInTheSmall) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(random_steer(), car, {{"lateral_acceleration", 0.2}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    EXPECT_TRUE(outcome.passed());
    test::expect_linear_response(outcome, 0.2, 3, 0.02);
    const SteadyHandling handling = steady_handling(car, 80 * kilometer_per_hour);
    test::expect_share(test::figure(outcome, "yaw rate gain at the lowest line"),
                       handling.yaw_rate_gain * handling.rack_per_angle, 0.02, "steady gain");
}

// Hardly any of what the car does on ice is in proportion to its steering: the less friction, the less coherent.
TEST(RandomSteer, FailsOnIce) {
    const auto coherent = [](double friction) {
        const Outcome outcome = test::driven(random_steer(), test::shipped_car(), {}, friction);
        return outcome.verdicts.at(1).passed;
    };
    EXPECT_FALSE(coherent(0.05));
    EXPECT_FALSE(coherent(0.1));
    EXPECT_TRUE(coherent(0.4));
    EXPECT_TRUE(coherent(1));
}

// What is read off depends on how long it lasts only as far as lines lie apart, wherever the curve has a peak at all.
TEST(RandomSteer, TheDurationChangesLittle) {
    const Settings chosen{{"speed", 130}, {"lateral_acceleration", 1}};
    Settings shorter = chosen, longer = chosen;
    shorter["duration"] = 60, longer["duration"] = 200;
    const Outcome brief = test::driven(random_steer(), test::shipped_car(), shorter),
                  lasting = test::driven(random_steer(), test::shipped_car(), longer);
    constexpr double resolution = 100.0 / 2048;  // [Hz]
    EXPECT_GT(test::figure(brief, "yaw rate peak ratio"), 1.05);
    EXPECT_NEAR(test::figure(brief, "yaw rate peak frequency"), test::figure(lasting, "yaw rate peak frequency"),
                resolution + 1e-9);
    const io::Curve& gain = test::curve(lasting, "yaw rate gain");
    EXPECT_NEAR(gain.x.at(0), 0.195, 0.001);
    EXPECT_NEAR(gain.x.at(1) - gain.x.at(0), resolution, 1e-6);
    test::expect_share(test::figure(brief, "yaw rate gain at the lowest line"),
                       test::figure(lasting, "yaw rate gain at the lowest line"), 0.01, "gain");
}

TEST(RandomSteer, MindsItsSettings) {
    test::expect_settings_checked(random_steer(), "duration", 1);
    test::expect_obstacles(random_steer());
    test::expect_interruptible(random_steer(), {});
}

// There is no steady gain in such a drive: what it is compared with is said by the line that stands for it.
TEST(RandomSteer, NamesTheLineThatItsGainsAreComparedWith) {
    const SteeredOutput& yaw_rate = steered_outputs.front();
    const Answer found{.frequency = {0.2, 1, 2}, .response = {2.0, 2.01, 1.0}, .coherence = {}};
    const ComparedGain compared{lowest_gain(found).gain, 0.2};
    TestRun by_line(random_steer(), test::shipped_car(), {}, {}), by_steady(by_line);
    add_answer(by_line, yaw_rate, found, compared, {});
    const Outcome& outcome = by_line.outcome;
    EXPECT_EQ(test::figure(outcome, "yaw rate gain at the lowest line"), 2);
    EXPECT_TRUE(std::isnan(test::figure(outcome, "yaw rate peak frequency"))) << "half a percent is noise";
    for (const Figure& figure : outcome.figures) {
        EXPECT_EQ(figure.meaning.find("steady"), std::string::npos) << figure.name;
        EXPECT_EQ(figure.name.find("lateral"), std::string::npos) << figure.name;
    }
    add_answer(by_steady, yaw_rate, found, lowest_gain(found), {});
    EXPECT_EQ(test::figure(by_steady.outcome, "yaw rate peak frequency"), 1);
}

}  // namespace
}  // namespace hamilcar
