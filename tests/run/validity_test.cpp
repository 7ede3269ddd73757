// What limits a run's validity is told, with its place, its time and its limit, and an ordinary run says nothing. Limits are
// provoked one by one; those of the step are held against what the run does there.
#include "hamilcar/run/validity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/tire_curves.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/road/road_area.hpp"
#include "hamilcar/run/record.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr, testing::StartsWith;
using units::degree;

RunSummary driven(const VehicleDescription& car, const ScenarioDescription& scenario) {
    Simulation simulation(car, scenario);
    return record(
        simulation, {}, 0.01, [](const Sample&, const std::vector<double>&) {},
        [](double, const RunSummary&) { return true; });
}

std::vector<ValidityWarning> of_kind(const std::vector<ValidityWarning>& list, const std::string& kind) {
    std::vector<ValidityWarning> out;
    std::ranges::copy_if(list, std::back_inserter(out), [&](const ValidityWarning& w) { return w.kind == kind; });
    return out;
}

// For the message of a test that expects none.
std::string told(const std::vector<ValidityWarning>& list) {
    std::string text;
    for (const ValidityWarning& w : list) text += sentence(w) + '\n';
    return text;
}

ScenarioDescription bend(double speed, double wheel_angle) {
    ScenarioDescription s = test::scenario(3, speed);
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0.2, 1}, {0, wheel_angle});
    return s;
}

void set_tires(VehicleDescription& car, const TireDescription& tire) {
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionWheelDescription& wheel : suspension.wheels) wheel.tire = tire;
    }
}

TEST(Validity, AnOrdinaryRunSaysNothing) {
    for (const std::string& name : test::fleet()) {
        const RunSummary run = driven(test::shipped(name), bend(15, 4 * degree));
        EXPECT_FALSE(run.ended_early) << name;
        EXPECT_TRUE(run.validity.empty()) << name << ": " << told(run.validity);
    }
}

// By another route: just below the limit that is told the run balances, a fifth above it falls apart.
TEST(Validity, TheStableStepThatIsToldIsTheLongestThatWorks) {
    for (const char* method : {"ab3", "rk4", "abm4"}) {
        ScenarioDescription s = bend(20, 10 * degree);
        s.duration = 4;
        s.solver.integrator = method, s.solver.step = 0.02;
        const auto limits = of_kind(driven(test::shipped_car(), s).validity, "step");
        ASSERT_EQ(limits.size(), 1u) << method;
        const double limit = limits[0].limit;
        EXPECT_EQ(limits[0].worst, 0.02);
        EXPECT_THAT(sentence(limits[0]), HasSubstr(method));
        s.solver.step = 0.9 * limit;
        const RunSummary below = driven(test::shipped_car(), s);
        EXPECT_TRUE(below.validity.empty()) << method << ": " << told(below.validity);
        EXPECT_LT(below.max_balance_error, 1e-3 * below.energy_exchanged()) << method;
        s.solver.step = 1.2 * limit;
        const RunSummary above = driven(test::shipped_car(), s);
        EXPECT_EQ(of_kind(above.validity, "step").size(), 1u) << method;
        EXPECT_TRUE(above.ended_early || above.max_balance_error > 1e-3 * above.energy_exchanged()) << method;
        std::printf("%s: stable up to %.3g ms, error there %.1e, a fifth above it %.1e\n", method, 1e3 * limit,
                    below.max_balance_error / below.energy_exchanged(),
                    above.max_balance_error / above.energy_exchanged());
    }
}

TEST(Validity, TheAdaptiveMethodKeepsItsStepsByItself) {
    ScenarioDescription s = test::scenario(1, 20);
    s.solver.integrator = "dopri5", s.solver.step = 0.02;
    EXPECT_TRUE(of_kind(driven(test::shipped_car(), s).validity, "step").empty());
}

TEST(Validity, AnEnergyAccountThatIsOffIsToldWithItsFigures) {
    EXPECT_TRUE(energy_warning(99, 1e5, 1e-3, 4).empty());
    EXPECT_TRUE(energy_warning(std::nan(""), 1e5, 1e-3, 4).empty()) << "no account was kept";
    const auto off = energy_warning(500, 1e5, 2e-3, 4);
    ASSERT_EQ(off.size(), 1u);
    EXPECT_EQ(off[0].worst, 5e-3);
    EXPECT_EQ(off[0].limit, 1e-3);
    EXPECT_TRUE(off[0].is_numerical());
    EXPECT_THAT(sentence(off[0]), HasSubstr("off by 500 J of 1e+05 J"));
    EXPECT_THAT(sentence(off[0]), HasSubstr("halve the step"));
    const auto endless = energy_warning(std::numeric_limits<double>::infinity(), 1e5, 2e-3, 4);
    ASSERT_EQ(endless.size(), 1u);
    EXPECT_TRUE(std::isfinite(endless[0].worst));
}

// The paper's tire in a bend near the limit, and in one that it is linear in.
TEST(Validity, TheLinearTireIsToldBeyondHalfItsFriction) {
    const auto hard = of_kind(driven(test::paper_car(), bend(20, 90 * degree)).validity, "linear_tire");
    ASSERT_FALSE(hard.empty());
    EXPECT_THAT(hard[0].where, HasSubstr("front_"));
    EXPECT_GT(hard[0].worst, 0.8);
    EXPECT_GT(hard[0].from, 0.2);
    EXPECT_LE(hard[0].from, hard[0].time);
    EXPECT_GE(hard[0].to, hard[0].time);
    const RunSummary gentle = driven(test::paper_car(), bend(20, 15 * degree));
    EXPECT_TRUE(gentle.validity.empty()) << told(gentle.validity);
}

// Why one half: with the same stiffness and friction a contact of uniform pressure is linear up to there, one of parabolic pressure a
// sixth below the line.
TEST(Validity, HalfTheFrictionIsWhereBrushesLeaveTheLine) {
    constexpr double load = 3000, stiffness = 38e3, friction = 1;
    const double alpha = linear_share * friction * load / stiffness, line = stiffness * alpha;
    DugoffDescription uniform = test::dugoff_tire();
    uniform.cornering_stiffness = stiffness, uniform.friction = friction;
    BrushDescription parabolic = test::brush_tire();
    parabolic.cornering_stiffness = stiffness, parabolic.friction = friction, parabolic.nominal_load = load;
    const auto side_force = [&](const TireDescription& tire, double angle) {
        return std::abs(steady_force(make_tire<double>(tire), {.load = load, .alpha = angle}).Fy);
    };
    EXPECT_NEAR(side_force(uniform, alpha) / line, 1, 5e-3);
    EXPECT_LT(side_force(uniform, 2 * alpha) / (2 * line), 0.8);
    EXPECT_NEAR(side_force(parabolic, alpha) / line, 1 - 0.5 / 3 + 0.25 / 27, 1e-2);
}

TEST(Validity, ATiresFileIsToldWhereItEnds) {
    VehicleDescription car = test::shipped_car();
    MagicFormulaDescription narrow = test::magic_tire();
    narrow.angle = {-1 * degree, 1 * degree}, narrow.camber = {-0.1 * degree, 0.1 * degree};
    narrow.load[1] = 3500;
    set_tires(car, narrow);
    const auto list = driven(car, bend(20, 60 * degree)).validity;
    EXPECT_FALSE(of_kind(list, "tire_slip_angle").empty());
    EXPECT_FALSE(of_kind(list, "tire_inclination").empty());
    const auto loads = of_kind(list, "tire_load");
    ASSERT_FALSE(loads.empty());
    EXPECT_EQ(loads[0].limit, 3500);
    EXPECT_GT(loads[0].worst, 3500);
    EXPECT_EQ(loads[0].unit, "N");
}

TEST(Validity, ALockedWheelBeyondTheFilesSlipIsTold) {
    VehicleDescription car = test::shipped_car();
    MagicFormulaDescription narrow = test::magic_tire();
    narrow.slip = {-0.5, 0.5};
    set_tires(car, narrow);
    ScenarioDescription s = test::scenario(2, 25);
    s.brake = test::table({0.2, 0.4}, {0, 1});
    const auto list = of_kind(driven(car, s).validity, "tire_slip");
    ASSERT_FALSE(list.empty());
    EXPECT_LT(list[0].worst, -0.5);
    EXPECT_EQ(list[0].limit, -0.5);
}

TEST(Validity, ACurveOfADamperAndOfAnEngineIsToldWhereItEnds) {
    VehicleDescription car = test::shipped_car();
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionDamperDescription& damper : suspension.dampers) {
            damper.damper = {{-0.02, 0, 0.02}, {-40, 0, 60}};
        }
    }
    for (TorqueCurve& curve : std::get<EngineDescription>(car.power_units[0].source).torque) {
        curve = {{50, 100}, {100, 100}};
    }
    ScenarioDescription s = test::scenario(2, 15);
    s.road.obstacles = {{.start = 3, .length = 0.1, .height = 0.02, .ramp = 0.03}};
    s.gear = test::table({0}, {2});
    const auto list = driven(car, s).validity;
    EXPECT_FALSE(of_kind(list, "damper_velocity").empty()) << told(list);
    EXPECT_FALSE(of_kind(list, "engine_speed").empty()) << told(list);
}

TEST(Validity, AVehicleInTheAirIsToldAndAHopIsNot) {
    ScenarioDescription s = test::scenario(1.5);
    s.initial.settle = false;
    s.initial.height = 0.6;
    const auto fall = of_kind(driven(test::shipped_car(), s).validity, "wheel_lift");
    EXPECT_EQ(fall.size(), 4u) << "two axles and two sides";
    s.initial.height = 0.1;
    EXPECT_TRUE(of_kind(driven(test::shipped_car(), s).validity, "wheel_lift").empty());
}

TEST(Validity, AVehicleOnItsSideIsTold) {
    ScenarioDescription s = test::scenario(0.05);
    s.initial.settle = false;
    s.initial.height = 1.5, s.initial.roll = 70 * degree;
    const auto list = of_kind(driven(test::shipped_car(), s).validity, "vehicle_inclination");
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NEAR(list[0].worst, 70, 5);
}

TEST(Validity, LeavingTheMeasuredRoadIsTold) {
    HeightGridDescription grid{.x = -5, .y = -4, .spacing_x = 1, .spacing_y = 1, .rows = 9, .columns = 26};
    grid.heights.assign(grid.rows * grid.columns, 0.01);
    ScenarioDescription s = test::scenario(2, 15);
    s.road.grid = std::make_shared<const HeightGridDescription>(grid);
    const auto list = of_kind(driven(test::shipped_car(), s).validity, "road_edge");
    ASSERT_EQ(list.size(), 4u) << "every wheel";
    EXPECT_GT(list[0].worst, 5);
    s.duration = 0.8;
    EXPECT_TRUE(of_kind(driven(test::shipped_car(), s).validity, "road_edge").empty());
}

TEST(RoadArea, IsThatOfTheFileUnlessItRepeatsItself) {
    auto crg = std::make_shared<CrgDescription>();
    crg->u_increment = 1, crg->v = {-2, 0, 2};  // 11 rows of 3
    crg->heights.assign(33, 0.0);
    RoadDescription road;
    EXPECT_FALSE(RoadArea(road).is_limited());
    road.crg = crg;
    EXPECT_EQ(RoadArea(road).outside(5, 1), 0);
    EXPECT_NEAR(RoadArea(road).outside(13, 0), 3, 1e-9);
    EXPECT_NEAR(RoadArea(road).outside(5, -4), 2, 1e-9);
    const auto endless = std::make_shared<CrgDescription>(*crg);
    endless->border_u = CrgBorder::repeat;
    road.crg = endless;
    EXPECT_EQ(RoadArea(road).outside(13, 0), 0);
    EXPECT_NEAR(RoadArea(road).outside(13, 5), 3, 1e-9);
}

// A run in two parts tells what one run tells.
TEST(Validity, GoesOnFromTheMarksOfAFirstPart) {
    ScenarioDescription s = bend(20, 90 * degree);
    s.solver.integrator = "rk4", s.solver.step = 4e-3;
    Simulation simulation(test::paper_car(), s);
    ValidityMonitor whole(simulation), first(simulation);
    std::vector<double> marks;
    for (int i = 0; i < 500; ++i) {
        whole.look(simulation.sample());
        if (i < 250) {
            first.look(simulation.sample());
            marks = first.marks();
        } else {
            ValidityMonitor second(simulation, marks);
            second.look(simulation.sample());
            marks = second.marks();
        }
        ASSERT_FALSE(simulation.advance());
    }
    EXPECT_EQ(marks, whole.marks());
    EXPECT_FALSE(whole.warnings().empty());
    EXPECT_TRUE(ValidityMonitor::fit(simulation, marks));
    EXPECT_TRUE(ValidityMonitor::fit(simulation, {}));
    marks.pop_back();
    EXPECT_FALSE(ValidityMonitor::fit(simulation, marks));
}

TEST(Validity, KeepsOfSeveralDrivesTheOneThatWentFarthest) {
    const auto warning = [](double worst) {
        return std::vector<ValidityWarning>{
            {.kind = "tire_load", .where = "front_left.tire", .worst = worst, .limit = 100}};
    };
    std::vector<ValidityWarning> all;
    add_warnings(warning(120), "first", all);
    add_warnings(warning(150), "second", all);
    add_warnings(warning(130), "third", all);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].drive, "second");
    EXPECT_THAT(sentence(all[0]), HasSubstr("second: front_left.tire"));
}

// Seventeen tires of a truck are one line, what is another matter is another.
TEST(Validity, IsToldOnceForManyPlaces) {
    const auto warning = [](std::string where, double worst, std::string advice) {
        return ValidityWarning{
            .kind = "tire_load", .where = std::move(where), .worst = worst, .limit = 100, .advice = std::move(advice)};
    };
    const std::vector<std::string> told =
        sentences({warning("front_left.tire", 120, "a"), warning("front_right.tire", 150, "a"),
                   warning("rear_left.tire", 110, "b"), warning("rear_right.tire", 130, "a")});
    ASSERT_EQ(told.size(), 2u);
    EXPECT_THAT(told[0], StartsWith("front_right.tire, farthest of 3 alike: "));
    EXPECT_THAT(told[1], StartsWith("rear_left.tire: "));
    EXPECT_TRUE(sentences({}).empty());
}

}  // namespace
}  // namespace hamilcar
