// Terms that are small or absent in every shipped vehicle, so that no whole run would miss them; each is made large here.
#include <gtest/gtest.h>

#include "hamilcar/block/powertrain_momenta.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

Model<double> powered_model(const VehicleDescription& car) {
    return {.vehicle = Vehicle<double>(car), .road = PlaneRoad<double>(0, 0, 1)};
}

// The wrench of a tire about its contact is what the tire model says, in ISO's signs (ISO 8855, tire axis system).
TEST(TireWrench, HasTheTiresMomentsAboutTheContact) {
    MagicFormulaDescription description = test::magic_tire();
    description.coefficients[QSX1] = 0.02, description.coefficients[QSX3] = 0.1;
    const Tire<double> tire = make_tire<double>(TireDescription(description));
    const double radius = description.casing.radius;
    const UnitGround<double> ground{TangentPlane<double>{Vec3<double>::UnitZ(), 0, 1}, nullptr};
    const Vec3<double> center(1.2, 0.7, radius - 0.02), axis = Vec3<double>::UnitY();
    const Spatial<double> motion = spatial<double>({20, -1, 0}, {0, 0, 0});
    TireForces<double> out;
    double torque = 0;
    const Spatial<double> wrench =
        tire_wrench<double>(tire, {ground, {0, 0}}, center, axis, motion, 20 / radius, 0, 1e-3, 5e-3, out, torque);
    const Vec3<double> contact(1.2, 0.7, 0), force = wrench.head<3>();
    const Vec3<double> moment = Vec3<double>(wrench.tail<3>()) - contact.cross(force);
    EXPECT_GT(std::abs(out.tire.Mx), 10);
    EXPECT_GT(std::abs(out.tire.Mz), 10);
    EXPECT_NEAR(moment[0], out.tire.Mx, 1e-9);
    EXPECT_NEAR(moment[2], out.tire.Mz, 1e-9);
    EXPECT_NEAR(force[0], out.tire.Fx, 1e-9);
    EXPECT_NEAR(force[1], out.tire.Fy, 1e-9);
    EXPECT_NEAR(force[2], out.tire.Fz, 1e-9);
}

// A wheel at rest on a post that rises is pressed at the rate at which its depth grows, and takes the power of the post.
TEST(TireWrench, FeelsThePostThatRises) {
    RoadDescription description;
    description.posts.height.push_back({{0, 1}, {0, 0.04}, Interpolation::smooth});
    const auto surface = make_surface(description);
    const Tire<double> tire = make_tire<double>(TireDescription(test::magic_tire()));
    const double radius = test::magic_tire().casing.radius;
    const Vec3<double> center(0.4, 0.7, radius), axis = Vec3<double>::UnitY();
    const auto at = [&](double time) {
        const UnevenGround<double> uneven{surface.get(),        Vec3<double>::UnitZ(),    1,
                                          Vec3<double>::Zero(), Mat3<double>::Identity(), time};
        const UnitGround<double> ground{TangentPlane<double>{Vec3<double>::UnitZ(), 0, 1}, &uneven};
        TireForces<double> out;
        double torque = 0;
        tire_wrench<double>(tire, {ground, {0, 0}}, center, axis, Spatial<double>::Zero(), 0, 0, 0, 0, out, torque);
        return out;
    };
    constexpr double time = 0.6, h = 1e-6;
    const TireForces<double> here = at(time);
    const double rate = (at(time + h).contact.depth - at(time - h).contact.depth) / (2 * h);
    EXPECT_GT(rate, 0.03);
    EXPECT_NEAR(here.contact.depth_rate, rate, 1e-7);
    EXPECT_NEAR(here.rise, rate, 1e-7);
    const double damped = here.tire.Fz - here.tire.elastic;  // what its damping takes of the power
    EXPECT_NEAR(lost_in_tire(here), here.tire.Fz * rate - damped * rate, 1e-6 * here.tire.Fz);
}

TEST(Trailer, LosesTheEnergyThatItsYawDampingTakes) {
    VehicleDescription truck = test::shipped("truck_semitrailer");
    ASSERT_FALSE(truck.trailers.empty());
    truck.trailers[0].yaw_damping = 1e6;
    ScenarioDescription s = test::everything_moves(truck);
    Simulation simulation(truck, s);
    test::run_to_end(simulation);
    const Sample end = simulation.sample();
    EXPECT_NEAR(end.energy.balance(), simulation.initial_energy_balance(), 1e-6 * end.energy.kinetic);
}

// What the wind does is what the aerodynamics do in a flow of that velocity, in the chassis's axes.
TEST(Wind, BlowsTowardItsDirectionOverTheGround) {
    const VehicleDescription car = test::shipped_car();
    const Model<double> model = test::make_model(car);
    for (const double heading : {0.0, 0.7, 2.5}) {
        const Mat3<double> R = axis_rotation<double>(Vec3<double>::UnitZ(), heading);
        const State<double> state = design_state(model, {0, 0, 1}, R);
        Input<double> calm, windy;
        windy.wind_x = 6, windy.wind_y = -15;
        const Velocity<double> velocity = velocity_block(model, state, calm);
        const Spatial<double> pushed = momenta_block(model, state, windy, velocity).external -
                                       momenta_block(model, state, calm, velocity).external;
        const Vec3<double> over_ground = R * Vec3<double>(pushed.head<3>());
        EXPECT_GT(over_ground.dot(Vec3<double>(6, -15, 0)), 1000) << heading;
        const auto expected =
            model.vehicle.aerodynamics.evaluate(Spatial<double>::Zero(), R.transpose() * Vec3<double>(6, -15, 0));
        EXPECT_LT((pushed - expected.wrench).norm(), 1e-9);
    }
}

// In a car that turns as one rigid body nothing turns in its driveline.
TEST(Shafts, StandStillInACarThatTurnsWithItsWheels) {
    const VehicleDescription car = test::shipped("pickup");
    const Model<double> model = powered_model(car);
    State<double> state = design_state(model, {0, 0, 5}, Mat3<double>::Identity());
    const Vec3<double> turning(0.3, 2.0, -0.5);
    Velocity<double> velocity = velocity_block(model, state, Input<double>{});
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = model.vehicle.suspensions[s];
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            suspension.wheel_state(static_cast<int>(w), state.values.data()).spin_momentum =
                suspension.wheels[w].wheel.spin_inertia * velocity.suspensions[s].axis[w].dot(turning);
        }
        for (auto& motion : velocity.suspensions[s].motion) motion = spatial<double>(Vec3<double>::Zero(), turning);
    }
    const auto speeds = powertrain_motion(model.vehicle, state, velocity).wheels;
    ASSERT_GE(model.vehicle.powertrain.wheels.size(), 2u);
    for (std::size_t i = 0; i < model.vehicle.powertrain.wheels.size(); ++i) EXPECT_NEAR(speeds[i], 0, 1e-12) << i;
}

// While a lock holds, its torsion winds up as fast as one wheel runs ahead of the other.
TEST(Lock, WindsUpWithTheDifferenceOfItsWheels) {
    const VehicleDescription car = test::shipped("formula");
    const Model<double> model = powered_model(car);
    const Powertrain<double>& powertrain = model.vehicle.powertrain;
    ASSERT_EQ(powertrain.differentials.size(), 1u);
    State<double> state = design_state(model, {0, 0, 5}, Mat3<double>::Identity());
    const auto [s, w] = locate_wheel(model.vehicle, powertrain.wheels[0]);
    const Suspension<double>& left = model.vehicle.suspensions[s];
    constexpr double ahead = 1e-4;  // [rad/s]
    left.wheel_state(static_cast<int>(w), state.values.data()).spin_momentum =
        left.wheels[w].wheel.spin_inertia * ahead;
    State<double> rate;
    evaluate_rhs(model, Input<double>{}, state, rate);
    EXPECT_NEAR(powertrain.windup(0, rate.values.data()), ahead, 1e-9);
}

// What the paper's chart stores is what it gives back, at any angles.
TEST(BryantChart, GivesBackTheMomentumThatItStores) {
    const Vector<double, 4> orientation(0.4, -0.7, 2.1, 0);
    const Spatial<double> momentum = (Spatial<double>() << 900, -300, 50, 700, -1100, 2500).finished();
    const Spatial<double> stored = BryantChart<double>::stored_momentum(orientation, momentum);
    EXPECT_LT((BryantChart<double>::momentum(orientation, stored) - momentum).norm(), 1e-10);
    EXPECT_GT((stored - momentum).norm(), 100) << "D is not the identity here";
}

// A step keeps |q| = 1 to the second order of what it loses; without that a coarse one would lose 1e-4 in this second.
TEST(Orientation, StaysAUnitQuaternion) {
    VehicleDescription car = test::shipped_car();
    ScenarioDescription s = test::scenario(1);
    s.solver.integrator = "ab2", s.solver.step = 2e-3;
    s.initial.settle = false, s.initial.height = 50, s.initial.angular_velocity = {4, 3, 5};
    Simulation simulation(car, s);
    test::run_to_end(simulation);
    EXPECT_NEAR(simulation.state().orientation().norm(), 1, 1e-12);
}

}  // namespace
}  // namespace hamilcar
