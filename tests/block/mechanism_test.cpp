// Mechanisms with published answers, through the program that moves suspensions (support/fixed_base.hpp).
//
// Three solutions are compared here: the program's; the closed-form poses, with the time from the energy integral; and
// published ones. Most published tables are runs of other programs with an error of integration of their
// own: the second solution shows how many of their digits are correct, and each table's tolerance reflects that.
#include <gtest/gtest.h>

#include "block/published_mechanisms.hpp"
#include "support/conservative_motion.hpp"
#include "support/fixed_base.hpp"

namespace hamilcar {
namespace {

using namespace test;
struct Case {
    const char* name;
    Mechanism mechanism;
    double rate, step;  // of the crank at design [rad/s]: it never stops; [s]
};
void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}
std::vector<Case> cases() {
    return {{"PlanarFourBar", msl_planar_four_bar(), 30, 1e-4},
            {"PlanarSliderCrank", flores_slider_crank(), 150, 1e-5},
            {"SpatialSliderCrank", iftomm_slider_crank(SmallMoment::along_rod), 6, 1e-4},
            {"SpatialFourBarWithSlider", msl_spatial_four_bar(), 5, 1e-4},
            {"SpatialFourBar", uraeus_spatial_four_bar(), 30, 2.5e-5}};
}

class Mechanisms : public testing::TestWithParam<Case> {};

TEST_P(Mechanisms, HaveTheClosedFormPosesOverARevolution) {
    const Mechanism& m = GetParam().mechanism;
    FixedBase simulated(m.suspension, m.gravity, 1);
    double worst = 0;
    for (int degree = 0; degree <= 720; ++degree) {
        simulated.place(degree * pi / 180);
        const Poses expected = m.poses(degree * pi / 180);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            worst = std::max({worst, (simulated.pose(i).R - expected[i].R).cwiseAbs().maxCoeff(),
                              (simulated.pose(i).p - expected[i].p).cwiseAbs().maxCoeff()});
        }
    }
    EXPECT_LT(worst, 1e-12);
}

TEST_P(Mechanisms, HaveTheRateOfTheEnergyIntegral) {
    const Mechanism& m = GetParam().mechanism;
    const ConservativeMotion expected(m, 0, GetParam().rate);
    FixedBase simulated(m.suspension, m.gravity, GetParam().step);
    simulated.start(0, GetParam().rate);
    EXPECT_NEAR(simulated.energy(), expected.energy(), 1e-10 * (1 + std::abs(expected.energy())));
    for (int turns = 1; turns <= 3; ++turns) {
        while (simulated.angle() < 2 * pi * turns) simulated.advance();
        EXPECT_NEAR(expected.time_to(simulated.angle()), simulated.time(), 1e-9 * simulated.time());
        EXPECT_NEAR(simulated.rate(), expected.rate(simulated.angle()), 1e-7 * std::abs(simulated.rate()));
    }
    EXPECT_NEAR(simulated.energy(), expected.energy(), 1e-8 * (1 + std::abs(expected.energy())));
    EXPECT_LT(simulated.violation(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(All, Mechanisms, testing::ValuesIn(cases()), [](const auto& one) { return one.param.name; });

// Published by the author of the problem (R. Masoudi): time, slider, crank angle every 5/299 s. Found in
// github.com/jgerstmayr/EXUDYN,
// docs/verification/Slidercrank3DiftommBenchmark/Spatial_rigid_slider-crank_mechanism_Masoudi.txt
// (iftomm-multibody.org/benchmark/problem/Spatial_rigid_slider-crank_mechanism). All nine digits of the slider come
// out at first, five after 22 strokes; by the energy integral the rest is the published run's own error.
TEST(IftommSliderCrank, AsItsAuthorPublished) {
    struct Row {
        int number;
        double slider, angle, slider_error, angle_error;  // [m], [rad]
    };
    const Row rows[] = {{1, 0.204068794, 0.097238887, 1e-9, 6e-8},  {6, 0.22678101, 0.55991297, 2e-8, 8e-7},
                        {12, 0.262960732, 1.285446537, 2e-7, 4e-6}, {30, 0.188148922, 5.278250602, 2e-7, 7e-6},
                        {60, 0.234415945, 10.47168146, 1e-6, 2e-5}, {120, 0.264900212, 20.1801119, 3e-6, 6e-5},
                        {240, 0.23007366, 41.97018299, 1e-5, 2e-4}, {299, 0.261012849, 51.50682085, 1.5e-5, 3e-4}};
    const Mechanism m = iftomm_slider_crank(SmallMoment::across_rod);
    const ConservativeMotion expected(m, 0, 6);
    FixedBase simulated(m.suspension, m.gravity, 5. / 299 / 200);
    simulated.start(0, 6);
    for (const Row& row : rows) {
        simulated.run_to(row.number * 5. / 299);
        EXPECT_NEAR(0.2 + simulated.coordinate(1), row.slider, row.slider_error) << row.number;
        EXPECT_NEAR(simulated.angle(), row.angle, row.angle_error) << row.number;
        EXPECT_NEAR(expected.time_to(simulated.angle()), simulated.time(), 1e-10) << row.number;
    }
}

// Published by M. Gonzalez (the same directory, .._Gonzalez.txt: time, slider), with the small moment along the rod.
// P. Masarati's table (MBDyn) reads it so, too, and is 0.018 s ahead after 5 s by the energy integral.
TEST(IftommSliderCrank, AsOthersPublished) {
    const double rows[][3] = {{0.01, 0.202420756, 2e-7}, {0.05, 0.212584746, 1e-6}, {0.1, 0.226785384, 2e-6},
                              {0.2, 0.263034975, 5e-6},  {0.5, 0.184952803, 1e-6},  {1, 0.211754668, 5e-5},
                              {2, 0.289063554, 5e-5},    {3, 0.228450093, 5e-5},    {4, 0.188208161, 5e-5},
                              {5, 0.240761815, 5e-5}};
    const Mechanism m = iftomm_slider_crank(SmallMoment::along_rod);
    FixedBase simulated(m.suspension, m.gravity, 1e-4);
    simulated.start(0, 6);
    for (const auto& [time, slider, error] : rows) {
        simulated.run_to(time);
        EXPECT_NEAR(0.2 + simulated.coordinate(1), slider, error) << time;
    }
}

struct Turning {
    double time, angle, rate;
};

// Reference results of the Modelica Association, Dymola, DASSL with a tolerance of 1e-6: github.com/modelica/
// MAP-LIB_ReferenceResults, Modelica/Mechanics/MultiBody/Examples/Loops/Fourbar1/Fourbar1.csv (j1.phi, j1.w).
TEST(ModelicaFourBars, SpatialOneTurnsAsPublished) {
    const Turning rows[] = {
        {0.01, 0.052656025367529363, 5.2972327013596194}, {0.1, 0.57372416914425883, 6.4607751522844037},
        {0.2, 1.3299958398273617, 8.8003233687036619},    {1, 7.8021338306942276, 9.3615884175904913},
        {1.1, 8.8656326583249925, 11.690280785115373},    {1.25, 10.54641935682757, 9.6645487114251534}};
    const Mechanism m = msl_spatial_four_bar();
    FixedBase simulated(m.suspension, m.gravity, 1e-4);
    simulated.start(0, 5.235987755982989);
    for (const Turning& row : rows) {
        simulated.run_to(row.time);
        EXPECT_NEAR(simulated.angle(), row.angle, 5e-5) << row.time;
        EXPECT_NEAR(simulated.rate(), row.rate, 2e-4) << row.time;
    }
}

// The same repository, .../Loops/PlanarFourbar/PlanarFourbar.csv (revolute1.phi, revolute1.w): from rest, with a
// damper of 0.1 N m s/rad in the crank's hinge.
TEST(ModelicaFourBars, PlanarOneSwingsAsPublished) {
    const Turning rows[] = {
        {0.01, -0.00135016438828984, -0.270033483721712}, {0.1, -0.135510108856004, -2.72234586489693},
        {0.2, -0.552227790356624, -5.69888467873734},     {0.3, -1.31824202202896, -10.0566051039023},
        {0.5, -3.29455208390301, -4.88732366001315},      {0.668, -3.6687464757918, -0.0805287883960648},
        {0.8, -3.46935046550771, 3.28934407140774},       {1, -1.82106780567352, 12.4555110108612},
        {1.25, -0.154156065031092, 2.41498365768641}};
    Mechanism m = msl_planar_four_bar();
    m.suspension.dampers.push_back({"hinge", {.on_part = {}, .on_base = {}, .coordinate = 0}, {{-1, 1}, {-0.1, 0.1}}});
    FixedBase simulated(m.suspension, m.gravity, 1e-4);
    simulated.start(0, 0);
    for (const Turning& row : rows) {
        simulated.run_to(row.time);
        EXPECT_NEAR(simulated.angle(), row.angle, 3e-5) << row.time;
        EXPECT_NEAR(simulated.rate(), row.rate, 3e-4) << row.time;
    }
}

// The benchmark's solution, ADAMS with 40 windows, six digits: github.com/mikevignos/simEngine3D-Vignos,
// testExamples/N-4barMechanism/A02_solution_data.txt, "Displacement point B0".
TEST(IftommFourBar, PassesTheSingularPositionAsPublished) {
    const double rows[][3] = {{0.05, 5.02096e-2, 0.998739}, {0.5, 0.687926, 0.725781}, {0.7, 0.994885, 0.101019},
                              {0.75, 0.990062, -0.140633},  {1, -0.115357, -0.993324}, {2, 3.44663e-2, 0.999406},
                              {3, -0.338518, -0.940960},    {4, 6.93421e-2, 0.997593}};
    const Mechanism m = windows(40);
    FixedBase simulated(m.suspension, m.gravity, 1e-3);
    simulated.start(0, -1);
    for (const auto& [time, x, y] : rows) {
        simulated.run_to(time);
        EXPECT_NEAR(-std::sin(simulated.angle()), x, 1e-6) << time;
        EXPECT_NEAR(std::cos(simulated.angle()), y, 1e-6) << time;
        EXPECT_NEAR(simulated.coordinate(2), simulated.angle(), 1e-12) << time;  // the cranks are parallel still
    }
}

// Two windows after 10 s, from Exudyn's run with its smallest step, 0.125 ms (its own error by its own sequence of
// steps: 7e-7): github.com/jgerstmayr/EXUDYN, main/pythonDev/TestModels/fourBarMechanismIftomm.py, comments at
// `h=0.000125`.
TEST(IftommFourBar, TwoWindowsAfterTenSeconds) {
    const Mechanism m = windows(2);
    FixedBase simulated(m.suspension, m.gravity, 1e-3);
    simulated.start(0, -1);
    simulated.run_to(10);
    EXPECT_NEAR(-std::sin(simulated.angle()), 0.3284573768, 1e-6);
    EXPECT_NEAR(std::cos(simulated.angle()), 0.9445187937, 1e-6);
}

// Positions over a turn of the crank, in millimeters: github.com/khaledghobashy/uraeus_smbd,
// use_cases/simulations/results_csv/spatial_fourbar_temp.csv. Of each row the y and z of the crank's center give the
// angle. The published rows close their own loops to 2.6e-5 mm (the row of 10: the rod between the published ends),
// which is where the digits end.
TEST(SpatialFourBar, StandsAsPublished) {
    struct Row {
        Vec crank, rocker, coupler;  // centers
    };
    const Row rows[] = {{{0, -9.902943021092883, 99.50845599292037},
                         {-590.7682524820867, -850, 316.00232657621575},
                         {-390.7682524820867, -434.9029430210929, 415.51078256913615}},
                        {{0, -83.70780352117539, 54.70837064907058},
                         {-661.610329630649, -850, 260.4035924225363},
                         {-461.610329630649, -508.7078035211754, 315.11196307160685}},
                        {{0, -91.59033578542265, -40.139898921417156},
                         {-538.456241500019, -850, 342.16936368748827},
                         {-338.456241500019, -516.5903357854227, 302.0294647660711}},
                        {{0, -44.69997693900935, -89.45341027022185},
                         {-344.283577410206, -850, 364.89132816262173},
                         {-144.28357741020602, -469.69997693900933, 275.43791789239987}},
                        {{0, 79.97130424111425, 60.0382442417091},
                         {-352.44428126785544, -850, 366.04433470243004},
                         {-152.44428126785542, -345.02869575888576, 426.08257894413913}},
                        {{0, 3.408245319826368, 99.94190791929049},
                         {-569.1925639207903, -850, 328.060777575429},
                         {-369.1925639207904, -421.5917546801736, 428.00268549471946}}};
    const Mechanism m = uraeus_spatial_four_bar();
    const Vec center[] = {{0, 0, 0.1}, {-0.375, -0.425, 0.425}, {-0.575, -0.85, 0.325}};
    FixedBase simulated(m.suspension, m.gravity, 1);
    double angle = 0;
    for (const Row& row : rows) {
        const double end = angle + std::fmod(std::atan2(-row.crank[1], row.crank[2]) - angle + 4 * pi, 2 * pi);
        for (int i = 1; i <= 50; ++i) simulated.place(angle + (end - angle) * i / 50);
        angle = end;
        EXPECT_LT((1e3 * simulated.pose(2).point(center[2]) - row.rocker).norm(), 1.5e-5);
        EXPECT_LT((1e3 * simulated.pose(1).point(center[1]) - row.coupler).norm(), 1.5e-5);
    }
}

TEST(AndrewsSqueezer, EndsAsPublished) {
    const Squeezer squeezer;
    const Mechanism m = squeezer.mechanism();
    FixedBase simulated(m.suspension, m.gravity, 2e-6, "abm5");
    simulated.start(0, 0);
    const double energy = simulated.energy();
    simulated.run_to(0.03);
    for (int i = 0; i < 7; ++i) {
        const double angle = squeezer.start[i] + simulated.coordinate(squeezer.coordinate[i]);
        const double rate = simulated.coordinate_rate(squeezer.coordinate[i]);
        EXPECT_NEAR(angle, squeezer.end[i], i < 2 ? 1.5e-9 : 3e-11) << i;
        EXPECT_NEAR(rate, squeezer.end_rate[i], 6e-8 * std::abs(squeezer.end_rate[i])) << i;
    }
    EXPECT_NEAR(squeezer.start[0] + simulated.angle(), 15.81077119515, 1e-11);  // long double
    EXPECT_NEAR(simulated.energy(), energy, 1e-12);
    EXPECT_LT(simulated.violation(), 1e-14);
}

}  // namespace
}  // namespace hamilcar
