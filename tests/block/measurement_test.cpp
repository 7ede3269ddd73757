// What sensors read, against finite differences of the momentum of all bodies and against what channels show; the same bits from the
// plain blocks, from every engine and in every lane.
#include "hamilcar/block/measurement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "hamilcar/base/units.hpp"
#include "hamilcar/batch/batch.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "hamilcar/run/channels.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using Places = MeasurementPlaces;

std::vector<double> measured(const Model<double>& model, const State<double>& state, const Input<double>& input) {
    State<double> rate;
    const FlushDenormals flush;
    const auto evaluation = evaluate_rhs(model, input, state, rate);
    const auto size = static_cast<std::size_t>(Places(model.vehicle).size);
    return {evaluation.measured.begin(), evaluation.measured.begin() + static_cast<std::ptrdiff_t>(size)};
}
std::vector<double> measured(const Simulation& run) {
    return measured(run.model(), run.state(), run.schedule()(run.time()));
}
Vec3<double> three(const std::vector<double>& numbers, int first) {
    const auto at = static_cast<std::size_t>(first);
    return {numbers[at], numbers[at + 1], numbers[at + 2]};
}

// Body by body, as they move: in ground axes [kg m/s].
Vec3<double> momentum(const Simulation& run) {
    const Sample s = run.sample();
    Vec3<double> sum = linear(Spatial<double>(s.model.vehicle.chassis_inertia * s.velocity.chassis));
    for (std::size_t i = 0; i < s.model.vehicle.suspensions.size(); ++i) {
        const SuspensionVelocity<double>& at = s.velocity.suspensions[i];
        const auto& bodies = s.model.vehicle.suspensions[i].bodies;
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            sum += linear(Spatial<double>(at.inertia[b] * at.motion[bodies[b].frame]));
        }
    }
    return s.velocity.R_GC * sum;
}

// On a road that climbs and leans, in a lane change with the brake.
ScenarioDescription everything(double step) {
    ScenarioDescription s = test::scenario(2, 22);
    s.road.grade = 0.08, s.road.bank = 0.04;
    s.solver.step = step;
    s.solver.integrator = "rk4";
    s.brake = test::table({0.2, 0.4}, {0, 0.25});
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0, 0.3, 0.6}, {0, 1, -0.5});
    s.wind_y = test::table({0, 0.3}, {0, 8});
    return s;
}

TEST(Accelerometer, ShowsTheForcesOfGroundAndAirOverMass) {
    constexpr double h = 2e-4;
    const VehicleDescription car = test::shipped("bmw_e90_330i");
    Simulation run(car, everything(h));
    const double mass = run.model().vehicle.total_mass;
    double largest = 0;
    for (int instant = 0; instant < 6; ++instant) {
        for (int i = 0; i < 498; ++i) ASSERT_FALSE(run.advance());
        const Vec3<double> before = momentum(run);
        ASSERT_FALSE(run.advance());
        const Vec3<double> shown = three(measured(run), Places::acceleration);
        const Mat3<double> R = run.sample().velocity.R_GC;
        ASSERT_FALSE(run.advance());
        const Vec3<double> rate = (momentum(run) - before) / (2 * h * mass);
        const Vec3<double> felt = R.transpose() * Vec3<double>(rate + car.gravity * Vec3<double>::UnitZ());
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(shown[i], felt[i], 2e-4) << "at " << run.time() << ", axis " << i;
        largest = std::max(largest, std::abs(shown[1]));
    }
    EXPECT_GT(largest, 3) << "the car was driven hard";
}

TEST(Accelerometer, ShowsGravityUpwardAtRest) {
    for (const double grade : {0.0, 0.12, -0.12}) {
        ScenarioDescription s = test::scenario(3);
        s.road.grade = grade;
        s.brake = test::table({0}, {0.5});
        Simulation run(test::shipped("bmw_e90_330i"), s);
        test::run_to_end(run);
        const Vec3<double> shown = three(measured(run), Places::acceleration);
        const Vec3<double> up = run.sample().velocity.R_GC.row(2).transpose();
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(shown[i], run.vehicle().gravity * up[i], 1e-4) << grade;
        EXPECT_NEAR(shown[0], 9.81 * std::sin(std::atan(grade)), 0.1) << "a car that points uphill seems to speed up";
        EXPECT_NEAR(shown[1], 0, 0.01);
    }
}

TEST(Measurement, IsWhatChannelsShow) {
    for (const char* name : {"bmw_e90_330i", "truck_semitrailer", "electric_hatchback"}) {
        ScenarioDescription s = everything(1e-3);
        s.gear = {{0}, {1}, Interpolation::steps};
        s.initial.velocity[0] = 5;
        Simulation run(test::shipped(name), s);
        for (int i = 0; i < 500; ++i) ASSERT_FALSE(run.advance());
        const std::vector<double> shown = measured(run);
        const Places places(run.model().vehicle);
        ASSERT_EQ(shown.size(), static_cast<std::size_t>(places.size));
        const std::vector<Channel> all = all_channels(run.vehicle());
        const Sample sample = run.sample();
        const auto channel = [&](const std::string& wanted) {
            const auto found = std::ranges::find(all, wanted, [](const Channel& one) { return one.column.name; });
            EXPECT_NE(found, all.end()) << wanted;
            return found == all.end() ? 0 : found->read(sample);
        };
        const auto expect = [&](int place, const std::string& which, double unit) {
            const double value = shown[static_cast<std::size_t>(place)];
            EXPECT_NEAR(value, channel(which) * unit, 1e-9 * std::abs(value) + 1e-12) << name << ", " << which;
        };
        expect(Places::angular_rate, "chassis.rate.roll", units::degree);
        expect(Places::angular_rate + 1, "chassis.rate.pitch", units::degree);
        expect(Places::angular_rate + 2, "chassis.rate.yaw", units::degree);
        expect(Places::control_pressure, "brakes.control_pressure", 1e5);
        int wheel = 0;
        for_each_wheel(run.vehicle(), [&](const SuspensionWheelDescription& one, std::size_t) {
            expect(Places::wheel_speed + wheel, one.name + ".wheel.spin", units::rpm);
            expect(places.brake_pressure + wheel++, one.name + ".brake.pressure", 1e5);
        });
        int unit = 0;
        for (const PowerUnitDescription& one : run.vehicle().power_units) {
            expect(places.rotor_speed + unit++, one.name + ".speed", units::rpm);
        }
        EXPECT_GT(shown[Places::control_pressure], 1e4);
    }
}

TEST(Measurement, OfAWheelThatRollsIsSpeedOverRadius) {
    Simulation run(test::shipped("bmw_e90_330i"), test::scenario(1, 20));
    const std::vector<double> shown = measured(run);
    int wheel = Places::wheel_speed;
    for_each_wheel(run.vehicle(), [&](const SuspensionWheelDescription& one, std::size_t) {
        EXPECT_NEAR(shown[static_cast<std::size_t>(wheel++)] * casing_of(one.tire).rolling_radius, 20, 0.02);
    });
}

// A car alone takes them into the memory of its controllers with each step, a batch from every lane.
class MeasurementBits : public testing::TestWithParam<std::tuple<const char*, const Engine*>> {};
INSTANTIATE_TEST_SUITE_P(Shipped, MeasurementBits,
                         testing::Combine(testing::Values("bmw_e90_330i", "electric_hatchback", "truck_semitrailer"),
                                          testing::ValuesIn(engines())),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param)) + "_" +
                                    std::string(std::get<1>(test.param)->name);
                         });

TEST_P(MeasurementBits, AreThoseOfThePlainBlocksInEveryLane) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 5; ++i) {
        VehicleDescription car = test::shipped(std::get<0>(GetParam()));
        car.chassis.mass *= 1 + 0.03 * i;
        ScenarioDescription s = everything(1e-3);
        s.solver.integrator = "ab3";
        s.initial.velocity[0] = 15 + i;
        cars.emplace_back(car, s);
    }
    Batch batch(cars, {.threads = 1, .engine = std::string(std::get<1>(GetParam())->name)});
    batch.advance(300);
    std::vector<std::vector<double>> expected;
    for (std::size_t i = 0; i < cars.size(); ++i) {
        expected.push_back(measured(cars[i].model(), batch.state(i), batch.schedule(i)(batch.time(i))));
    }
    batch.advance(1);
    for (std::size_t i = 0; i < cars.size(); ++i) {
        Snapshot snapshot;
        batch.save(i, snapshot);
        for (std::size_t k = 0; k < expected[i].size(); ++k) {
            ASSERT_EQ(snapshot.control[k], expected[i][k]) << "car " << i << ", number " << k;
        }
    }
}

}  // namespace
}  // namespace hamilcar
