// The shaft to a differential on a live axle, and shafts behind a gearbox with an inertia: by conservation laws, statics and the closed
// form of two masses on two springs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hamilcar/block/road_wheels.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

ScenarioDescription in_gear(double duration, double speed, double gear, const SignalDescription& throttle) {
    ScenarioDescription s = test::scenario(duration, speed);
    s.throttle = throttle;
    s.gear = {{0}, {gear}, Interpolation::steps};
    return s;
}

double load(const Sample& s, std::size_t suspension, std::size_t wheel) {
    return s.momenta.suspensions[suspension].wheels[wheel].tire.Fz;
}

// Without gravity and ground nothing changes the angular momentum, whatever the engine does to axle and chassis.
TEST(PropellerShaft, ConservesAngularMomentumAndEnergy) {
    VehicleDescription car = test::shipped("pickup");
    car.gravity = 0, car.aerodynamics = {}, car.controllers.clear();
    ScenarioDescription s = in_gear(1, 0, 1, test::table({0.1, 0.3}, {0, 0.6}));
    s.initial.settle = false, s.initial.height = 50;
    s.initial.angular_velocity = {0.2, -0.3, 0.4};
    Simulation run(car, s);
    const auto about_the_ground = [&] {
        const Vec3<double> p = run.state().momentum().head<3>(), own = run.state().momentum().tail<3>();
        return Vec3<double>(own + Vec3<double>(run.state().position()).cross(p));
    };
    const Vec3<double> before = about_the_ground();
    test::run_to_end(run);
    const Sample end = run.sample();
    EXPECT_GT(std::abs(end.momenta.powertrain.inputs[0]), 20) << "the shaft is loaded";
    EXPECT_LT((about_the_ground() - before).norm(), 1e-7);
    EXPECT_NEAR(end.energy.balance(), run.initial_energy_balance(), 5e-4 * end.energy.kinetic);
}

// An axle that rolls against the chassis while its wheels stand turns the shaft by as much: its gears are on the axle.
TEST(PropellerShaft, TurnsWithTheAxleThatItDrives) {
    const Vehicle<double> car(test::shipped("pickup"));
    const Model<double> model{.vehicle = car, .road = PlaneRoad<double>(0, 0, 1)};
    const State<double> state = design_state(model, {0, 0, 5}, Mat3<double>::Identity());
    const Differential<double>& rear = car.powertrain.differentials[0];
    ASSERT_GE(rear.on_axle, 0);
    const auto s = static_cast<std::size_t>(rear.on_axle);
    Velocity<double> velocity = velocity_block(model, state, Input<double>{});
    const double still = car.powertrain.input_speeds(powertrain_motion(car, state, velocity))[0];
    for (auto& motion : velocity.suspensions[s].motion) motion[3] += 0.5;
    velocity.suspensions[s].motion[0][3] -= 0.5;  // the chassis stays
    const double rolling = car.powertrain.input_speeds(powertrain_motion(car, state, velocity))[0];
    EXPECT_NEAR(rolling - still, 0.5 * rear.shaft_axis[0], 1e-6);
}

// Held on its front brakes with its rear wheels pushed: the shaft's torque lifts one rear wheel, what the springs pass on lifts the
// opposite front wheel, and all together there is no moment about the car's longitudinal axis.
TEST(PropellerShaft, ShiftsTheLoadOfALiveAxle) {
    VehicleDescription car = test::shipped("pickup");
    const auto held = [&](double throttle) {
        ScenarioDescription s = in_gear(6, 0, 1, test::table({0.2, 0.6}, {0, throttle}));
        s.brake = {{0}, {1}};
        Simulation run(car, s);
        test::run_to_end(run);
        return run;
    };
    const Simulation idle = held(0), pushed = held(0.5);
    const Sample a = idle.sample(), b = pushed.sample();
    ASSERT_EQ(car.suspensions.back().wheels.size(), 2u) << "one live axle with both wheels";
    const std::size_t rear = car.suspensions.size() - 1;
    // Of the loads and of the weight about the ground's x axis through the chassis' origin: tires push at the contact, and a body that
    // leans moves its center.
    const auto moment = [&](const Sample& s) {
        const Mat3<double>& R = s.velocity.R_GC;
        double front = 0, behind = 0;
        for (std::size_t i = 0; i < car.suspensions.size(); ++i) {
            for (std::size_t w = 0; w < car.suspensions[i].wheels.size(); ++w) {
                const Vec3<double> contact = R * s.momenta.suspensions[i].wheels[w].frame.point;
                (i == rear ? behind : front) += contact[1] * load(s, i, w);
            }
        }
        const Vec3<double> weight = R * mass_moment(s.model, s.velocity);
        return std::array{front - car.gravity * weight[1], behind};
    };
    const double shaft = b.momenta.powertrain.inputs[0] - a.momenta.powertrain.inputs[0];
    EXPECT_GT(shaft, 100);
    const std::array still = moment(a), now = moment(b);
    const double front = now[0] - still[0], behind = now[1] - still[1];
    EXPECT_NEAR(front + behind, 0, 5e-3 * shaft) << "nothing from outside";
    EXPECT_GT(behind, 0.2 * shaft)
        << "the shaft turns about -x and takes load off the right wheel: American racers know";
    EXPECT_LT(behind, shaft) << "springs and bars pass on the rest";
}

// With an engine and a shaft that turn the other way everything is mirrored.
TEST(PropellerShaft, TurnsTheAxleTheOtherWayWithTheOtherAxis) {
    const auto shift = [](double direction) {
        VehicleDescription car = test::shipped("pickup");
        for (DifferentialDescription& one : car.differentials) one.shaft_axis = {direction, 0, 0};
        car.power_units[0].axis = {direction, 0, 0};
        ScenarioDescription s = in_gear(6, 0, 1, test::table({0.2, 0.6}, {0, 0.5}));
        s.brake = {{0}, {1}};
        Simulation run(car, s);
        test::run_to_end(run);
        const std::size_t rear = car.suspensions.size() - 1;
        return load(run.sample(), rear, 0) - load(run.sample(), rear, 1);
    };
    const double one = shift(-1), other = shift(1);
    EXPECT_GT(std::abs(one), 50);
    EXPECT_NEAR(one, -other, 0.02 * std::abs(one));
}

// An engine whose clutch is held, a gearbox and a car as heavy as a wall: the gearbox swings between two springs,
// w = sqrt((k_clutch + k_shafts / ratio^2) / I).
TEST(Shafts, LetTheGearboxSwingAtItsOwnFrequency) {
    VehicleDescription car = test::shipped("bmw_323i");
    car.controllers.clear();
    PowerUnitDescription& unit = car.power_units[0];
    unit.gearbox.efficiency = 1, unit.inertia = 50,
    unit.damping_ratio = 0;  // hardly moved; a clutch spring without damping
    for (std::size_t s : {2, 3}) car.suspensions[s].wheels[0].wheel.spin_inertia = 200;
    car.chassis.inertia[0] += 100;
    unit.shafts = {.exists = true, .gearbox_inertia = 0.02, .stiffness = 4000, .damping_ratio = 0.002, .backlash = 0};
    ScenarioDescription s = in_gear(0.6, 12, 4, test::table({0, 1}, {0.3, 0.3}));
    s.solver.integrator = "rk4", s.solver.step = 2e-4;
    Simulation run(car, s);
    const std::size_t place = static_cast<std::size_t>(run.model().vehicle.powertrain.units[0].place) + 4;
    Snapshot pushed;
    run.save(pushed);
    pushed.state.values[place] += 0.02 * 3;  // the gearbox alone, by 3 rad/s
    run.restore(pushed);
    std::vector<double> slip, time;
    while (!run.finished()) {
        ASSERT_FALSE(run.advance());
        const auto out = run.sample().momenta.powertrain.units[0];
        slip.push_back(out.shaft_speed - out.spin), time.push_back(run.time());
    }
    double mean = 0;
    for (const double x : slip) mean += x / static_cast<double>(slip.size());
    std::vector<double> crossings;
    for (std::size_t i = 1; i < slip.size(); ++i) {
        const double a = slip[i - 1] - mean, b = slip[i] - mean;
        if (a < 0 && b >= 0) crossings.push_back(time[i - 1] + (time[i] - time[i - 1]) * a / (a - b));
    }
    ASSERT_GT(crossings.size(), 5u);
    const double found =
        2 * std::numbers::pi * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
    const double ratio = unit.gearbox.ratios[3], final_drive = car.differentials[0].ratio;
    const double half_shafts = 2 * car.differentials[0].shaft_stiffness / (final_drive * final_drive);
    const double behind = 1 / (1 / 4000.0 + 1 / half_shafts) / (ratio * ratio);
    EXPECT_NEAR(found, std::sqrt((unit.stiffness + behind) / 0.02), 0.02 * found);
}

// Off the pedal and on again: through the play of its gears a car gives no torque for as long as it takes to cross it.
TEST(Shafts, CrossTheirPlayWithoutTorque) {
    VehicleDescription car = test::shipped("bmw_323i");
    car.controllers.clear();
    PowerUnitDescription& unit = car.power_units[0];
    unit.shafts = {.exists = true, .gearbox_inertia = 0.02, .stiffness = 8000, .damping_ratio = 0.1, .backlash = 0};
    const auto drive = [&](double backlash) {
        car.power_units[0].shafts.backlash = backlash;
        Simulation run(car, in_gear(3, 15, 2, test::table({0.5, 0.55, 1.5, 1.55}, {0.4, 0, 0, 0.6})));
        double idle = 0;
        while (!run.finished()) {
            const auto failed = run.advance();
            EXPECT_FALSE(failed);
            if (failed) break;
            if (run.sample().momenta.powertrain.units[0].out == 0) idle += 1e-3;
        }
        const Sample end = run.sample();
        EXPECT_NEAR(end.energy.balance(), run.initial_energy_balance(), 2e-3 * end.energy.kinetic);
        return idle;
    };
    EXPECT_EQ(drive(0), 0);
    const double small = drive(0.05), large = drive(0.15);
    EXPECT_GT(small, 5e-3);
    EXPECT_GT(large, small + 5e-3);
    EXPECT_LT(large, 0.6);
}

}  // namespace
}  // namespace hamilcar
