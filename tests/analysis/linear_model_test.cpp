// Operating points and linear models against differences of the equations in doubles, and against runs in time.
#include "hamilcar/analysis/linear_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>
#include <numbers>

#include "hamilcar/analysis/modes.hpp"
#include "hamilcar/math/convert.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

class LinearModels : public testing::TestWithParam<std::string> {};

// A at a cornering point, column by column, by differences of z' in doubles.
TEST_P(LinearModels, AreTheDerivativesOfTheEquations) {
    const Linearizer linearizer(test::shipped(GetParam()));
    const VehicleDescription& car = linearizer.vehicle();
    const OperatingPoint at = linearizer.operating_point({15, 2});
    ASSERT_TRUE(at.found) << at.problem;
    const LinearModel linear = linearizer.linearize(at);
    const Model<double>& model = linearizer.model();
    const ReducedCoordinates reduced(car);
    const Vec3<double> seat = vec3(car.chassis.center_of_mass);
    const auto rates = [&](const Eigen::VectorXd& z, const Input<double>& input) {
        Eigen::VectorXd rate(z.size());
        reduced_rates(model, reduced, input, z.data(), at.state, seat, rate.data());
        return rate;
    };
    const auto close = [&](const Eigen::VectorXd& column, const Eigen::VectorXd& difference, const std::string& which) {
        for (Eigen::Index i = 0; i < column.size(); ++i) {
            const double size = std::max(linear.A.row(i).cwiseAbs().maxCoeff() * 1e-3, std::abs(column[i]));
            EXPECT_NEAR(column[i], difference[i], 2e-5 * size + 1e-7)
                << "d(" << linear.states[static_cast<std::size_t>(i)] << ")'/d(" << which << ")";
        }
    };
    for (Eigen::Index j = 0; j < at.z.size(); ++j) {
        // a released brake sits in the kink between winding up to either side; it moves nothing else
        if (linear.states[static_cast<std::size_t>(j)].ends_with(".brake_windup")) continue;
        const bool momentum = linear.states[static_cast<std::size_t>(j)].find("momentum") != std::string::npos;
        const double step = momentum ? 1e-4 * (1 + std::abs(at.z[j]) * 1e-2) : 1e-7;
        Eigen::VectorXd above = at.z, below = at.z;
        above[j] += step, below[j] -= step;
        close(linear.A.col(j), (rates(above, at.input) - rates(below, at.input)) / (2 * step),
              linear.states[static_cast<std::size_t>(j)]);
    }
    Input<double> above = at.input, below = at.input;
    above.rack.displacement += 1e-6, below.rack.displacement -= 1e-6;
    close(linear.B.col(rack), (rates(at.z, above) - rates(at.z, below)) / 2e-6, "rack");
}

TEST_P(LinearModels, SteadyDrivingIsSteadyInTime) {
    const VehicleDescription car = test::shipped(GetParam());
    const Linearizer linearizer(car);
    const OperatingPoint at = linearizer.operating_point({15, 2});
    ASSERT_TRUE(at.found) << at.problem;
    State<double> state = at.state;
    Integrator<State<double>> integrator(*find_method("rk4"), 1e-3, linearizer.model().vehicle.state_size);
    const auto driver = [&](double) { return at.input; };
    for (int i = 0; i < 2000; ++i) integration_block(linearizer.model(), integrator, driver, 1e-3 * i, state);
    const std::vector<double> z = reduced_from(ReducedCoordinates(car), state);
    for (std::size_t i = 0; i < z.size(); ++i) {
        const double was = at.z[static_cast<Eigen::Index>(i)];
        EXPECT_NEAR(z[i], was, 1e-7 * (1 + std::abs(was))) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Vehicles, LinearModels, testing::ValuesIn(test::fleet()),
                         [](const auto& one) { return one.param; });

// A small push along a mode decays in a run of the full equations as the eigenvalue says: what the left eigenvector sees of
// the motion grows like exp(s t).
void expect_decay(const std::string& name, double speed, const char* mode_name) {
    const VehicleDescription car = test::shipped(name);
    const Linearizer linearizer(car);
    const OperatingPoint at = linearizer.operating_point({speed, 0});
    ASSERT_TRUE(at.found) << at.problem;
    const LinearModel linear = linearizer.linearize(at);
    const Eigen::EigenSolver<Eigen::MatrixXd> right(linear.A), left(linear.A.transpose());
    std::complex<double> wanted;
    for (const Mode& mode : modes(linear, car)) {
        if (mode.name == mode_name) wanted = mode.eigenvalue;
    }
    ASSERT_NE(wanted.imag(), 0) << mode_name;
    Eigen::Index r = 0, l = 0;
    (right.eigenvalues().array() - wanted).abs().minCoeff(&r);
    (left.eigenvalues().array() - wanted).abs().minCoeff(&l);
    const Eigen::VectorXcd v = right.eigenvectors().col(r), w = left.eigenvectors().col(l);
    const ReducedCoordinates reduced(car);
    const Eigen::VectorXd push = v.real() * (1e-5 / v.head(3).cwiseAbs().maxCoeff());
    const Eigen::VectorXd start = at.z + push;
    State<double> state = state_of<double>(linearizer.model(), reduced, start.data(), at.state, at.input.rack);
    const double step = 5e-4, duration = std::min(0.5, 3 / std::abs(wanted));
    Integrator<State<double>> integrator(*find_method("rk4"), step, linearizer.model().vehicle.state_size);
    const auto driver = [&](double) { return at.input; };
    const auto seen = [&] {
        const std::vector<double> z = reduced_from(reduced, state);
        const Eigen::VectorXd dz = Eigen::Map<const Eigen::VectorXd>(z.data(), at.z.size()) - at.z;
        return std::complex<double>(w.transpose() * dz.cast<std::complex<double>>());
    };
    const std::complex<double> before = seen();
    const int count = static_cast<int>(duration / step);
    std::complex<double> grown(0);
    std::complex<double> last = before;
    for (int i = 0; i < count; ++i) {
        integration_block(linearizer.model(), integrator, driver, step * i, state);
        grown += std::log(seen() / last);  // step by step, so that no turn is lost
        last = seen();
    }
    const std::complex<double> fitted = grown / (count * step);
    std::printf("%s at %g m/s, %s: eigenvalue %.4f %+.4fi, in time %.4f %+.4fi\n", name.c_str(), speed, mode_name,
                wanted.real(), wanted.imag(), fitted.real(), fitted.imag());
    EXPECT_LT(std::abs(fitted - wanted), 2e-3 * std::abs(wanted));
}

TEST(Modes, DecayInTimeAsTheirEigenvaluesSay) {
    expect_decay("bmw_323i", 0, "heave");
    expect_decay("bmw_323i", 0, "pitch");
    expect_decay("bmw_323i", 0, "roll");
    expect_decay("bmw_323i", 0, "rear wheel hop");
    expect_decay("bmw_323i", 30, "weave");
    expect_decay("hatchback", 0, "roll");
    expect_decay("pickup", 0, "roll");
    expect_decay("truck_semitrailer", 20, "weave");
}

// At rest, without dampers and friction: what a car on springs must show. A heavy pitch mode lies where the textbook has it.
TEST(Modes, OfAnUndampedCarDoNotDecay) {
    const VehicleDescription car = test::made_conservative(test::shipped("bmw_323i"));
    const Linearizer linearizer(car);
    const OperatingPoint at = linearizer.operating_point({});
    ASSERT_TRUE(at.found) << at.problem;
    for (const Mode& mode : modes(linearizer.linearize(at), car)) {
        if (mode.frequency > 0.5) {
            EXPECT_NEAR(mode.damping_ratio, 0, 1e-6) << mode.name;
        }
    }
}

// Slow enough for the seat to go with the road, fast enough to leave it behind.
TEST(Response, OfTheSeatToTheRoad) {
    const VehicleDescription car = test::shipped("bmw_323i");
    const Linearizer linearizer(car);
    const LinearModel linear = linearizer.linearize(linearizer.operating_point({20, 0}));
    const auto transmitted = [&](double frequency) {
        const double w = 2 * std::numbers::pi * frequency;
        const auto response = frequency_response(linear, 4, gravity, -1, {w});
        return std::abs(1.0 + std::complex<double>(0, w) * response[0]);
    };
    EXPECT_NEAR(transmitted(0.05), 1, 0.01);
    EXPECT_GT(transmitted(1.4), 1.3);
    EXPECT_LT(transmitted(20), 0.15);
}

// Steady yaw gain of a bicycle model with the linear model's own understeer: rack to yaw rate at low frequency against two
// circles driven by Newton.
TEST(Response, OfYawToTheRackAtZeroFrequencyIsThatOfCircles) {
    const VehicleDescription car = test::shipped("bmw_323i");
    const Linearizer linearizer(car);
    const OperatingPoint straight = linearizer.operating_point({20, 0}),
                         circle = linearizer.operating_point({20, 0.05});
    const LinearModel linear = linearizer.linearize(straight);
    // at constant drive torque the speed falls off in time: look faster than that, slower than everything else
    const double gain = std::abs(frequency_response(linear, 2, rack, rack_rate, {0.3})[0]);
    const double wanted = 0.05 / 20 / (circle.input.rack.displacement - straight.input.rack.displacement);
    EXPECT_NEAR(gain, wanted, 0.01 * wanted);
}

}  // namespace
}  // namespace hamilcar
