// A vehicle's figures by other routes: statics, the kinetic energy of the whole car turning as one, springs by hand, the linearized
// car's own steering ratio.
#include "hamilcar/analysis/vehicle_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/block/road_wheels.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using units::degree;

VehicleFigures figures_of(const VehicleDescription& car) {
    const Linearizer linearizer(car);
    const OperatingPoint rest = linearizer.operating_point({});
    EXPECT_TRUE(rest.found) << rest.problem;
    return vehicle_figures(linearizer, rest, kinematics(car, {.steps = 8}));
}

// Moments about the axles, of all that has two.
TEST(VehicleFigures, LoadsBalanceTheWeightAboutTheCenterOfMass) {
    for (const std::string& name : test::fleet()) {
        const VehicleDescription car = test::shipped(name);
        const VehicleFigures f = figures_of(car);
        double sum = 0;
        for (const StandingAxle& axle : f.axles) sum += axle.load;
        EXPECT_NEAR(sum, f.total_mass * car.gravity, 1e-6 * sum) << name;
        if (f.axles.size() != 2) continue;
        EXPECT_NEAR(f.axles[1].load * f.wheelbase, f.mass * car.gravity * f.center_of_mass[0], 0.01 * sum) << name;
    }
}

TEST(VehicleFigures, WheelbaseAndTrackAreThoseOfTheFile) {
    const VehicleFigures f = figures_of(test::shipped_car());
    EXPECT_NEAR(f.wheelbase, 2.57, 1e-3);  // published: W9 and W10 in vehicles/bmw_323i.toml
    EXPECT_NEAR(f.axles[0].track, 1.40, 1e-3);
    EXPECT_FALSE(f.axles[0].of_trailer);
}

// Turned as one about its center of mass, the car has half the inertia times the square of the rate.
TEST(VehicleFigures, InertiaIsThatOfTheKineticEnergy) {
    for (const char* name : {"bmw_323i", "pickup", "offroader"}) {
        const VehicleDescription car = test::shipped(name);
        const VehicleFigures f = figures_of(car);
        const Model<double> model = test::make_model(car);
        State<double> state = design_state(model, Vec3<double>(0, 0, 2), Mat3<double>::Identity());
        ASSERT_TRUE(assemble(model, {}, state).assembled);
        const Vec3<double> center = mass_moment(model, velocity_block(model, state, {})) / model.vehicle.total_mass;
        constexpr double rate = 0.3;  // [rad/s]
        const Vec3<double> w(rate, 0, 0);
        set_velocities(model, {}, spatial<double>(Vec3<double>(center.cross(w)), w), state);
        const double energy = test::energy_of(model, state, {}).kinetic;
        EXPECT_NEAR(2 * energy / (rate * rate), f.inertia[0], 2e-3 * f.inertia[0]) << name;
    }
}

// Of independent suspensions a wheel's rate acts at half the track; a solid axle's springs at half their own distance.
TEST(VehicleFigures, RollStiffnessIsThatOfSpringsAndBarsByHand) {
    const VehicleDescription car = test::shipped_car();
    const std::vector<AxleReport> axles = kinematics(car, {.steps = 8});
    const VehicleFigures f = figures_of(car);
    for (std::size_t i = 0; i < 2; ++i) {
        const double half = f.axles[i].track / 2, bars = 4 * car.anti_roll_bars[i].rate * half * half;
        const double springs = 2 * axles[i].design.left.wheel_rate * half * half;
        EXPECT_NEAR(f.axles[i].bar_stiffness, bars, 1e-9 * bars);
        EXPECT_NEAR(f.axles[i].roll_stiffness, springs + bars, 0.01 * (springs + bars));
    }
    const VehicleDescription offroader = test::shipped("offroader");
    const auto& coil = offroader.suspensions[1].springs[0];
    const double half = std::abs(coil.line.on_part[1]);
    const VehicleFigures solid = figures_of(offroader);
    const double springs = 2 * coil.spring.rate * half * half;
    EXPECT_NEAR(solid.axles[1].roll_stiffness - solid.axles[1].bar_stiffness, springs, 0.08 * springs)
        << "their preload takes a twentieth";
}

TEST(VehicleFigures, SteeringIsThatOfTheLinearizedCar) {
    for (const char* name : {"bmw_323i", "hatchback", "formula"}) {
        const VehicleDescription car = test::shipped(name);
        const VehicleFigures f = figures_of(car);
        ASSERT_TRUE(f.steering) << name;
        EXPECT_NEAR(f.steering->ratio, steady_handling(car, 10).steering_ratio, 0.01 * f.steering->ratio) << name;
        EXPECT_GT(f.steering->inner, f.steering->outer) << name;
    }
}

TEST(VehicleFigures, OscillationsAreListedAndNothingElse) {
    EXPECT_EQ(figures_of(test::shipped_car()).rides.size(), 7u) << "roll, pitch, heave, hop and tramp of both axles";
    for (const Mode& mode : figures_of(test::shipped("formula")).rides) EXPECT_GT(mode.frequency, 0) << mode.name;
}

}  // namespace
}  // namespace hamilcar
