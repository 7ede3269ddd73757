// Handling from the linear theory against circles driven by Newton's method, the bicycle model on the tires' own stiffness,
// and sine steering in time.
#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/analysis/no_solution.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "hamilcar/analysis/kinematics.hpp"
#include "hamilcar/analysis/tire_curves.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double speed = 80 / 3.6;  // [m/s]

// A compiled suspension on Magic Formula tires, and a composed axle on linear ones.
class Handling : public testing::TestWithParam<std::string> {
protected:
    const VehicleDescription car = test::shipped(GetParam());
    const Linearizer linearizer{car};
    const double rack_per_angle = car.steering.rack_per_revolution / (2 * std::numbers::pi);

    struct Circle {
        double rack, yaw_rate, roll, sideslip, acceleration;
    };
    Circle circle(double v, double acceleration) const {
        const OperatingPoint at = linearizer.operating_point({v, acceleration});
        EXPECT_TRUE(at.found) << at.problem;
        const Eigen::VectorXd y = linearizer.linearize(at).output;
        return {at.input.rack.displacement, y[output_yaw_rate], y[output_roll],
                std::atan2(y[output_lateral_velocity], y[output_speed]), acceleration};
    }
};

void expect_close(double value, double wanted, double tolerance, const char* what) {
    EXPECT_NEAR(value, wanted, tolerance * std::abs(wanted)) << what;
}

// Straight ahead, and where the tires have become softer.
TEST_P(Handling, AtConstantSpeedIsThatOfNeighboringCircles) {
    constexpr double aside = 0.05, enough = 1e-4;
    for (const double acceleration : {0.0, 3.0}) {
        const SteadyHandling linear = steady_handling(linearizer, linearizer.operating_point({speed, acceleration}));
        const Circle more = circle(speed, acceleration + aside), less = circle(speed, acceleration - aside);
        const double rack = more.rack - less.rack, angle = rack / rack_per_angle;
        expect_close(linear.yaw_rate_gain, (more.yaw_rate - less.yaw_rate) / rack, enough, "yaw rate gain");
        expect_close(linear.lateral_acceleration_gain, 2 * aside / rack, enough, "lateral acceleration gain");
        expect_close(linear.roll_gain, (more.roll - less.roll) / rack, enough, "roll gain");
        expect_close(linear.sideslip_gain, (more.sideslip - less.sideslip) / rack, enough, "sideslip gain");
        expect_close(linear.roll_gradient, (more.roll - less.roll) / (2 * aside), enough, "roll gradient");
        expect_close(linear.sideslip_gradient, (more.sideslip - less.sideslip) / (2 * aside), enough,
                     "sideslip gradient");
        const double geometry = linear.steering_ratio * linear.wheelbase / (speed * speed);
        expect_close(linear.understeer_gradient, angle / (2 * aside) - geometry, enough, "understeer gradient");
        EXPECT_NEAR(linear.speed, speed, 1e-8);
        EXPECT_NEAR(linear.lateral_acceleration, acceleration, 1e-8);
    }
}

TEST_P(Handling, AtConstantRadiusIsThatOfFasterCircles) {
    constexpr double faster = 0.02;  // [m/s]
    for (const double radius : {100.0, 1000.0, -1000.0}) {
        const double v = radius == 100 ? 17 : speed;
        const auto at = [&](double one) { return circle(one, one * one / radius); };
        const Circle more = at(v + faster), less = at(v - faster);
        expect_close(constant_radius_gradient(car, radius, v),
                     (more.rack - less.rack) / rack_per_angle / (more.acceleration - less.acceleration), 1e-4,
                     "constant radius");
    }
}

// Angle of the steering wheel per curvature, on wide circles.
double angle_per_curvature(const SteadyHandling& h) {
    return h.speed / (h.yaw_rate_gain * h.rack_per_angle);
}

// The circle test by another name: straight ahead at different speeds, the angle per curvature grows with speed squared.
TEST_P(Handling, AtConstantRadiusIsTheGrowthOfTheAngle) {
    constexpr double faster = 0.05;  // [m/s]
    const SteadyHandling more = steady_handling(car, speed + faster), less = steady_handling(car, speed - faster);
    const double growth =
        (angle_per_curvature(more) - angle_per_curvature(less)) / (more.speed * more.speed - less.speed * less.speed);
    expect_close(constant_radius_gradient(car, 1e5, speed), growth, 2e-4, "growth");
}

// The ratio is that of the axle steered on the bench, and at a crawl, where nothing slips, the angle is that of the geometry.
// Caster leans steered wheels into the bend: what their camber pushes, one percent of the E30's angle, is taken away.
TEST_P(Handling, AtACrawlIsGeometry) {
    VehicleDescription upright = car;
    for (SuspensionDescription& corner : upright.suspensions) {
        auto* tire = std::get_if<MagicFormulaDescription>(&corner.wheels[0].tire);
        for (const MagicName name : {PHY3, PVY3, PVY4, PKY6, PKY7}) {
            if (tire) tire->coefficients[name] = 0;
        }
    }
    const SteadyHandling slow = steady_handling(upright, 0.5);
    expect_close(angle_per_curvature(slow), slow.steering_ratio * slow.wheelbase, 3e-3, "angle per curvature");
    const Sweep steer = kinematics(car, SweepRange{})[0].sweeps[2];
    const AxleFigures &right = steer.rows[steer.design - 1], &left = steer.rows[steer.design + 1];
    const double turned = (left.left.steer + left.right.steer - right.left.steer - right.right.steer) / 2;
    expect_close(slow.steering_ratio, (left.rack - right.rack) / rack_per_angle / turned, 5e-3, "steering ratio");
}

// One axle of a bicycle model: of both tires under their static load, and of its linkage while the body rolls to the right.
struct BicycleAxle {
    double load = 0, cornering_stiffness = 0, camber_stiffness = 0, trail = 0;  // [N], [N/rad], [N/rad], [m]
    double roll_steer = 0, roll_camber = 0;  // to the left; top to the right, over the road [rad/rad]
};

// The bicycle model by hand (Gillespie, Fundamentals of Vehicle Dynamics, chapter 6): a gradient of tires, aligning torque,
// camber and roll steer, each by itself; body and axle roll alike, and no wheel's toe and camber at rest count.
TEST_P(Handling, IsNearlyThatOfABicycle) {
    const OperatingPoint straight = linearizer.operating_point({speed, 0});
    const Eigen::VectorXd y = linearizer.linearize(straight).output;
    const SteadyHandling exact = steady_handling(linearizer, straight);
    BicycleAxle axle[2];
    const Eigen::Index wheels = (y.size() - first_wheel_output) / 2;
    Eigen::Index wheel = 0;
    for_each_wheel(car, [&](const auto& one, std::size_t) {
        BicycleAxle& of = axle[one.wheel.center[0] < -1 ? 1 : 0];
        const double load = y[first_wheel_output + wheels + wheel++];
        const TireFigures tire = tire_figures(make_tire<double>(one.tire), load);
        of.load += load, of.cornering_stiffness += tire.cornering_stiffness;
        of.camber_stiffness += tire.camber_stiffness, of.trail = tire.trail;
    });
    const std::vector<AxleReport> reports = kinematics(car, SweepRange{});
    for (std::size_t i = 0; i < 2; ++i) {
        const Sweep& roll = reports[i].sweeps[1];  // to the left: the left wheel rises
        const AxleFigures &right = roll.rows[roll.design - 1], &left = roll.rows[roll.design + 1];
        const auto slope = [&](auto&& of) { return (of(right) - of(left)) / (left.roll - right.roll); };
        axle[i].roll_steer = slope([](const AxleFigures& f) { return (f.left.steer + f.right.steer) / 2; });
        axle[i].roll_camber = 1 + slope([](const AxleFigures& f) { return (f.right.camber - f.left.camber) / 2; });
    }
    const double turning = (axle[0].load * axle[0].trail + axle[1].load * axle[1].trail) / exact.wheelbase;
    const auto slip = [&](const BicycleAxle& a, double pushed) {  // less what the axle steers by itself, per a_y
        const double force = pushed / car.gravity + a.camber_stiffness * a.roll_camber * exact.roll_gradient;
        return force / a.cornering_stiffness - a.roll_steer * exact.roll_gradient;
    };
    const double gradient = slip(axle[0], axle[0].load + turning) - slip(axle[1], axle[1].load - turning);
    const double gain = speed / (exact.wheelbase + gradient * speed * speed) / exact.steering_ratio;
    expect_close(exact.yaw_rate_gain * exact.rack_per_angle, gain, 0.06, "yaw rate gain");
}

// An oversteering car on soft rear tires: beyond its critical speed it leaves the straight by itself, an eigenvalue says so.
TEST(CriticalSpeed, IsWhereTheCarBecomesUnstable) {
    VehicleDescription car = test::shipped("hatchback");
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionWheelDescription& wheel : suspension.wheels) {
            if (wheel.name.starts_with("rear")) std::get<LinearTireDescription>(wheel.tire).cornering_reference *= 0.6;
        }
    }
    const Linearizer linearizer(car);
    double critical = 30;
    for (int i = 0; i < 30; ++i) {
        const SteadyHandling h = steady_handling(linearizer, linearizer.operating_point({critical, 0}));
        EXPECT_TRUE(std::isnan(h.characteristic_speed));
        critical = h.critical_speed;
    }
    const auto fastest_growth = [&](double v) {
        const LinearModel model = linearizer.linearize(linearizer.operating_point({v, 0}));
        return model.A.eigenvalues().real().maxCoeff();
    };
    EXPECT_LT(fastest_growth(0.999 * critical), 0);
    EXPECT_GT(fastest_growth(1.001 * critical), 0);
}

TEST(Steady, NeedsAVehicleThatDrives) {
    EXPECT_THROW(steady_handling(test::shipped("bmw_323i"), 0), NoSolution);
    VehicleDescription coasting = test::shipped("bmw_323i");
    for (SuspensionDescription& corner : coasting.suspensions) corner.wheels[0].drive_share = 0;
    EXPECT_THROW(steady_handling(coasting, speed), NoSolution);
}

// Amplitude and phase of a quantity over whole periods, as a factor of sin(w t); offset and trend apart.
std::complex<double> fitted(const std::vector<double>& t, const std::vector<double>& y, double w) {
    const auto n = static_cast<Eigen::Index>(t.size());
    Eigen::MatrixXd basis(n, 4);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double at = t[static_cast<std::size_t>(i)];
        basis.row(i) << std::sin(w * at), std::cos(w * at), 1, at;
    }
    const Eigen::VectorXd x = basis.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(y.data(), n));
    return {x[0], x[1]};
}

constexpr LinearOutput watched[] = {output_yaw_rate, output_lateral_acceleration, output_roll, output_lateral_velocity};
const char* const watched_names[] = {"yaw rate", "lateral acceleration", "roll", "lateral velocity"};

// What the linear model calls its outputs, of a run.
std::array<double, 4> outputs_of(const Simulation& run) {
    const Sample s = run.sample();
    const Mat3<double>& R = s.velocity.R_GC;
    const double heading = std::atan2(R(1, 0), R(0, 0));
    const auto across = [&](const Vec3<double>& v) { return std::cos(heading) * v[1] - std::sin(heading) * v[0]; };
    const double roll = std::atan2(R(2, 1), R(2, 2)), pitch = -std::asin(R(2, 0));
    const Vec3<double> w = s.velocity.chassis.tail<3>(), force = R * Vec3<double>(s.momenta.external.head<3>());
    return {(w[1] * std::sin(roll) + w[2] * std::cos(roll)) / std::cos(pitch),
            across(force) / s.model.vehicle.total_mass, roll,
            across(R * velocity_at<double>(s.velocity.chassis, s.model.vehicle.chassis.center))};
}

// Half a degree of the steering wheel, so that nothing leaves its linear range; two periods to forget the start.
std::array<std::complex<double>, 4> driven_response(const VehicleDescription& car, double drive_torque,
                                                    double frequency) {
    constexpr double start = 1;  // [s] of straight driving
    const double w = 2 * std::numbers::pi * frequency, lead = std::max(2 / frequency, 3.0);
    const double first = start + std::ceil(lead * frequency) / frequency, last = first + 2 / frequency;
    ScenarioDescription s = test::scenario(last, speed);
    s.steering_input = SteeringInput::steering_wheel;
    for (int i = 0; 1e-3 * i < last - start; ++i) {
        s.steering.time.push_back(start + 1e-3 * i);
        s.steering.value.push_back(0.5 * degree * std::sin(w * 1e-3 * i));
    }
    s.drive = test::table({0, 1}, {drive_torque, drive_torque});
    Simulation run(car, s);
    std::vector<double> time, angle;
    std::array<std::vector<double>, 4> outputs;
    while (!run.finished()) {
        if (const auto end = run.advance()) ADD_FAILURE() << end->message;
        if (run.time() < first + 1e-6 || run.steps_taken() % 10 != 0) continue;
        time.push_back(run.time() - start);
        angle.push_back(run.sample().input.rack.displacement * 2 * std::numbers::pi / car.steering.rack_per_revolution);
        const std::array<double, 4> now = outputs_of(run);
        for (std::size_t k = 0; k < 4; ++k) outputs[k].push_back(now[k]);
    }
    std::array<std::complex<double>, 4> out;
    for (std::size_t k = 0; k < 4; ++k) out[k] = fitted(time, outputs[k], w) / fitted(time, angle, w);
    return out;
}

TEST_P(Handling, RespondsToSineSteeringAsInTime) {
    const OperatingPoint straight = linearizer.operating_point({speed, 0});
    const LinearModel model = linearizer.linearize(straight);
    for (const double frequency : {0.2, 0.5, 1.0, 2.0}) {
        const auto in_time = driven_response(linearizer.vehicle(), straight.input.drive_torque, frequency);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::complex<double> linear =
                steering_response(model, rack_per_angle, watched[k], {2 * std::numbers::pi * frequency})[0];
            const std::complex<double> ratio = in_time[k] / linear;
            EXPECT_NEAR(std::abs(ratio), 1, 5e-4) << watched_names[k] << " at " << frequency << " Hz";
            EXPECT_NEAR(std::arg(ratio), 0, 0.06 * degree) << watched_names[k] << " at " << frequency << " Hz";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Vehicles, Handling, testing::Values("bmw_323i", "hatchback"),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace hamilcar
