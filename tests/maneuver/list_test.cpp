// What holds of every maneuver, whatever it is about: mathematics that gave up is no driving, and what was not driven was not met.
#include <gtest/gtest.h>

#include <algorithm>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/maneuver.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

Outcome driven(const Maneuver& maneuver, const VehicleDescription& car, const ManeuverOptions& options) {
    return maneuver.drive(car, complete_settings(maneuver, car, {}), options);
}

class AnyManeuver : public testing::TestWithParam<std::string> {};

TEST_P(AnyManeuver, TakesNoConstraintViolationForDriving) {
    const Maneuver& maneuver = *find_maneuver(GetParam());
    for (const double step : {0.1, 0.02}) {
        ManeuverOptions options;
        options.keep_runs = false;
        options.solver.step = step;
        const Outcome outcome = driven(maneuver, test::shipped_car(), options);
        ASSERT_TRUE(outcome.failed);
        EXPECT_EQ(outcome.stopped, Stopped::numerical);
        EXPECT_NE(outcome.failed->find("at t = "), std::string::npos) << *outcome.failed;
        EXPECT_TRUE(outcome.verdicts.empty());
        EXPECT_TRUE(outcome.figures.empty());
    }
}

TEST_P(AnyManeuver, GivesNoVerdictOnceInterrupted) {
    ManeuverOptions options;
    options.keep_runs = false;
    options.keep_going = [](double) { return false; };
    const Outcome outcome = driven(*find_maneuver(GetParam()), test::shipped_car(), options);
    EXPECT_EQ(outcome.failed, "interrupted");
    EXPECT_EQ(outcome.stopped, Stopped::interrupted);
    EXPECT_TRUE(outcome.verdicts.empty());
    EXPECT_FALSE(outcome.passed());
}

// All but those over bumps, which choose a fine step themselves.
std::vector<std::string> on_flat_roads() {
    std::vector<std::string> out;
    for (const Maneuver& maneuver : maneuvers()) {
        if (maneuver.name != "cleat" && maneuver.name != "rough_road") out.push_back(maneuver.name);
    }
    return out;
}

INSTANTIATE_TEST_SUITE_P(OnFlatRoads, AnyManeuver, testing::ValuesIn(on_flat_roads()),
                         [](const auto& name) { return name.param; });

TEST(Maneuvers, FailWhereADriveOfThemHasAWrongEnergyAccount) {
    VehicleDescription car = test::shipped_car();
    for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].wheel.spin_inertia = 1e-6;
    ManeuverOptions options;
    options.keep_runs = false;
    for (const char* name : {"acceleration", "step_steer"}) {
        const Outcome outcome = driven(*find_maneuver(name), car, options);
        ASSERT_TRUE(outcome.failed) << name;
        EXPECT_EQ(outcome.stopped, Stopped::numerical) << name;
        EXPECT_TRUE(outcome.verdicts.empty() && outcome.figures.empty()) << name;
    }
}

// Linear theory finds no steady motion of a vehicle that nothing drives: that is mathematics, and no slip of the program.
TEST(Maneuvers, TellAMotionThatIsNotThereAsNumerical) {
    VehicleDescription car = test::shipped_car();
    for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].drive_share = 0;
    try {
        driven(*find_maneuver("constant_radius"), car, {});
        ADD_FAILURE() << "steady driving without drive";
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::numerical) << error.what();
    }
}

}  // namespace
}  // namespace hamilcar
