// ISO 7401's step against the linear model integrated over the same angle of the steering wheel.
#include <Eigen/Dense>

#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

constexpr double speed = 80 * kilometer_per_hour, width = 0.02;  // [m/s]; of the step [s]

// Yaw rate over its steady value, every millisecond from the step's beginning; by the trapezoidal rule.
std::vector<double> linear_step(const VehicleDescription& car) {
    const Linearizer linearizer(car);
    const LinearModel m = linearizer.linearize(linearizer.operating_point({.speed = speed}));
    constexpr double h = 1e-3, duration = 5;  // [s]
    const auto unity = Eigen::MatrixXd::Identity(m.A.rows(), m.A.cols());
    const Eigen::MatrixXd inverse = (unity - h / 2 * m.A).inverse(), forward = unity + h / 2 * m.A;
    const auto input = [&](double t) -> Eigen::VectorXd {
        const double s = std::clamp(t / width, 0.0, 1.0);
        Eigen::VectorXd u = Eigen::VectorXd::Zero(linear_input_count);
        u[rack] = s * s * (3 - 2 * s), u[rack_rate] = 6 * s * (1 - s) / width;
        return u;
    };
    const double gain = steady_handling(car, speed).yaw_rate_gain;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(m.A.rows());
    std::vector<double> out;
    for (int i = 0; i * h < duration; ++i) {
        const Eigen::VectorXd now = input(i * h), next = input((i + 1) * h);
        out.push_back((m.C.row(output_yaw_rate) * x + m.D.row(output_yaw_rate) * now)(0) / gain);
        x = inverse * (forward * x + h / 2 * m.B * (now + next));
    }
    return out;
}

TEST(StepSteer, IsLinearTheorysInTheSmall) {
    VehicleDescription car = test::shipped_car();
    car.power_units.clear(), car.differentials.clear();  // of which linear theory knows nothing
    constexpr double small = 0.1;                        // [m/s^2]
    const double angle = angle_for(car, speed, small) / degree;
    const Outcome outcome = test::driven(step_steer(), car, {{"lateral_acceleration", small}, {"rate", angle / width}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    EXPECT_TRUE(outcome.passed());
    const std::vector<double> linear = linear_step(car);
    const Series series{linear, 1000};
    const auto highest = peak(series, Extreme::highest);
    test::expect_share(test::figure(outcome, "yaw rate overshoot"), 100 * (highest->value - 1), 0.02, "overshoot");
    EXPECT_NEAR(test::figure(outcome, "yaw rate peak response time"), highest->time - width / 2, 0.005);
    EXPECT_NEAR(test::figure(outcome, "yaw rate response time"),
                *first_crossing(series, 0.9, Crossing::rising) - width / 2, 0.002);
    const SteadyHandling handling = steady_handling(car, speed);
    test::expect_share(test::figure(outcome, "yaw rate gain"), handling.yaw_rate_gain * handling.rack_per_angle, 0.02,
                       "gain");
    test::expect_share(
        test::figure(outcome, "TB value"),
        test::figure(outcome, "yaw rate peak response time") * std::abs(test::figure(outcome, "steady sideslip")), 1e-9,
        "TB");
}

TEST(StepSteer, FailsOnIce) {
    const Outcome outcome = test::driven(step_steer(), test::shipped_car(), {}, 0.2);
    EXPECT_FALSE(outcome.failed);
    EXPECT_FALSE(outcome.passed());
}

// A car that loses speed in the turn has peaks that come from that, not from the step.
TEST(StepSteer, FailsWhereTheSpeedFalls) {
    VehicleDescription car = test::shipped_car();
    car.aerodynamics.side_area.reset(),
        car.aerodynamics.yaw_volume = 0;  // which would let it turn in before it slows down
    const Outcome outcome = test::driven(step_steer(), car, {{"lateral_acceleration", 9}});
    ASSERT_FALSE(outcome.failed);
    ASSERT_EQ(outcome.verdicts.size(), 4u);
    EXPECT_FALSE(outcome.verdicts[1].passed) << outcome.verdicts[1].found;
    EXPECT_FALSE(outcome.verdicts[3].passed) << outcome.verdicts[3].found;
    const auto reached = std::ranges::find_if(
        outcome.notes, [](const std::string& note) { return note.find("the last second had") != std::string::npos; });
    EXPECT_NE(reached, outcome.notes.end());
}

TEST(StepSteer, ShowsWhatWasDriven) {
    const Outcome outcome = test::driven(step_steer(), test::shipped_car(), {});
    EXPECT_TRUE(outcome.passed());
    const auto last = [&](const std::string& what) { return test::curve(outcome, what + " over time").y.back(); };
    test::expect_share(last("steering wheel angle"), test::figure(outcome, "steering wheel angle"), 1e-6, "angle");
    test::expect_share(last("yaw rate"), test::figure(outcome, "steady yaw rate"), 0.02, "yaw rate");
    test::expect_share(last("lateral acceleration"), test::figure(outcome, "steady lateral acceleration"), 0.02,
                       "lateral acceleration");
    test::expect_share(last("sideslip angle"), test::figure(outcome, "steady sideslip"), 0.02, "sideslip");
}

TEST(StepSteer, MindsItsSettings) {
    test::expect_settings_checked(step_steer(), "rate", -1);
    test::expect_obstacles(step_steer());
    test::expect_interruptible(step_steer(), {});
}

}  // namespace
}  // namespace hamilcar
