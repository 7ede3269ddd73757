// Rotors and shafts in a whole car, by conservation laws: internal torques change no momentum, and the energy
// supplied by engines is accounted for.
#include <gtest/gtest.h>

#include <numbers>

#include "hamilcar/block/road_wheels.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/simulation.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

ScenarioDescription powered(double duration, double speed, double gear) {
    ScenarioDescription s = test::scenario(duration, speed);
    s.throttle = {{0.1, 0.3}, {0, 1}};
    s.gear = {{0}, {gear}, Interpolation::steps};
    return s;
}

// Momentum and angular momentum about the ground's origin: what the quaternion's chart stores.
Spatial<double> momentum_of(const Simulation& car) {
    Spatial<double> out = car.state().momentum();
    const Vec3<double> p = out.head<3>();
    out.tail<3>() += Vec3<double>(car.state().position()).cross(p);
    return out;
}

// Far above the ground, without gravity and air: nothing from outside.
Simulation floating(const Vec3<double>& turning, double gear) {
    VehicleDescription car = test::shipped_car();
    car.gravity = 0;
    car.aerodynamics = {};
    ScenarioDescription s = powered(1.5, 0, gear);
    s.initial.settle = false, s.initial.height = 50;
    s.initial.angular_velocity = {turning[0], turning[1], turning[2]};
    return Simulation(car, s);
}

TEST(Rotor, ConservesTheCarsAngularMomentum) {
    for (const double gear : {0.0, 1.0, 3.0}) {
        Simulation car = floating({0.4, -0.3, 0.8}, gear);
        const Spatial<double> before = momentum_of(car);
        const double spin = car.sample().momenta.powertrain.units[0].spin;
        test::run_to_end(car);
        const Spatial<double> after = momentum_of(car);
        const Sample end = car.sample();
        EXPECT_GT(end.momenta.powertrain.units[0].spin, spin + 100) << "the engine was sped up";
        for (int i = 0; i < 6; ++i) EXPECT_NEAR(after[i], before[i], 1e-8) << "gear " << gear << ", " << i;
        EXPECT_NEAR(end.energy.balance(), car.initial_energy_balance(), 2e-4 * end.energy.kinetic);
    }
}

TEST(Rotor, LeansTheBodyWhileItSpeedsUp) {
    // About x: the body takes what the rotor gains, less what its springs hold; at once that is all.
    Simulation car = floating({0, 0, 0}, 0);
    const double inertia = car.model().vehicle.powertrain.units[0].inertia;
    for (int i = 0; i < 400; ++i) ASSERT_FALSE(car.advance());
    const Sample s = car.sample();
    const double rotor = inertia * (s.momenta.powertrain.units[0].spin -
                                    car.model().vehicle.powertrain.units[0].axis.dot(angular(s.velocity.chassis)));
    EXPECT_GT(rotor, 1);
    EXPECT_GT(s.velocity.chassis[3], 0) << "the rotor turns about -x, so the body about +x";
}

// Energy balance of all kinds of drivelines, at two steps: the residual is the integration error.
class DrivelineEnergy : public testing::TestWithParam<const char*> {};

TEST_P(DrivelineEnergy, BalancesAtTheMethodsOrder) {
    const VehicleDescription car = io::read_vehicle(test::source_path(std::string("vehicles/") + GetParam() + ".toml"));
    const auto gap = [&](double step) {
        const auto gears = static_cast<double>(car.power_units.front().gearbox.ratios.size());
        ScenarioDescription s = powered(2, 8, std::min(gears > 6 ? 6.0 : 2.0, gears));
        s.solver.step = step;
        s.brake = {{1.4, 1.5}, {0, 0.3}};
        s.steering_input = SteeringInput::steering_wheel;
        s.steering = {{0.5, 0.8}, {0, 0.5}};
        Simulation run(car, s);
        test::run_to_end(run);
        const Sample end = run.sample();
        EXPECT_GT(run.model().vehicle.powertrain.supplied(run.state().values.data()), 100);
        return std::abs(end.energy.balance() - run.initial_energy_balance()) / end.energy.kinetic;
    };
    const double coarse = gap(1e-3), fine = gap(5e-4);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_LT(fine, std::max(0.5 * coarse, 2e-6));
}

INSTANTIATE_TEST_SUITE_P(Vehicles, DrivelineEnergy,
                         testing::Values("bmw_323i", "hatchback", "offroader", "pickup", "truck_semitrailer",
                                         "electric_hatchback"));

// Held on the brake with throttle in first gear: nothing turns or oscillates.
struct HeldCar {
    const char* name;
    std::vector<double> pedals;  // that the brakes hold
};
class Stall : public testing::TestWithParam<HeldCar> {};

TEST_P(Stall, StandsStillUnderLoad) {
    const VehicleDescription car =
        io::read_vehicle(test::source_path(std::string("vehicles/") + GetParam().name + ".toml"));
    for (const double pedal : GetParam().pedals) {
        ScenarioDescription s = powered(3, 0, 1);
        s.throttle = {{0.2, 0.6}, {0, pedal}};
        s.brake = {{0}, {1}};
        s.clutch = {{0}, {car.power_units.front().gearbox.automatic ? 0.0 : 0.6}};
        Simulation run(car, s);
        double fastest = 0, torque = 0;
        while (!run.finished()) {
            ASSERT_FALSE(run.advance());
            if (run.time() < 2) continue;
            const Sample at = run.sample();
            fastest = std::max(fastest, std::abs(at.momenta.powertrain.units[0].shaft_speed));
            torque = at.momenta.powertrain.units[0].out;
        }
        const Sample end = run.sample();
        EXPECT_GT(torque, 10) << "the wheels are pushed";
        EXPECT_LT(fastest, 0.2) << "of the gearbox's input [rad/s], pedal " << pedal;
        const double supplied = end.model.vehicle.powertrain.supplied(end.state.values.data());
        EXPECT_NEAR(end.energy.balance(), run.initial_energy_balance(), 1e-3 * std::abs(supplied) + 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Vehicles, Stall,
                         testing::Values(HeldCar{"bmw_323i", {0.3, 1}}, HeldCar{"offroader", {0.3, 1}},
                                         HeldCar{"pickup", {0.3}}, HeldCar{"electric_hatchback", {0.3, 1}}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Powertrain, AcceleratesTheCarByItsTorqueLessInertiaAndLosses) {
    // Second gear, full throttle, after the clutch has settled: m_effective a = ratios T efficiency / r - resistance.
    ScenarioDescription s = powered(2, 10, 2);
    Simulation car(test::shipped_car(), s);
    test::run_to_end(car);
    const Sample at = car.sample();
    const auto& unit = at.momenta.powertrain.units[0];
    const double ratio = 2.20 * 3.25, radius = rolling_radius(at.model.vehicle.suspensions[2].wheels[0].tire);
    const Observation observation = car.observation();
    const double a = car.observation().speed;
    ASSERT_FALSE(car.advance());
    const double acceleration = (car.observation().speed - a) / car.scenario().solver.step;
    const double rotor_acceleration = acceleration / radius * ratio;
    EXPECT_NEAR(unit.clutch, unit.source - 0.18 * rotor_acceleration, 0.02 * unit.source);
    const double force = ratio * 0.9 * unit.clutch / radius;
    const double resisting = 0.5 * 1.2 * 0.38 * 1.85 * observation.speed * observation.speed;
    const double wheels = 4 * 0.85 / (radius * radius);
    EXPECT_NEAR((1150 + wheels) * acceleration, force - resisting, 0.04 * force) << "the rest is rolling resistance";
}

}  // namespace
}  // namespace hamilcar
