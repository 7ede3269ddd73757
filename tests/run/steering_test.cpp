// What a steering with mechanics does by itself, on whole cars: it returns, kicks, sticks and keeps its energy.
#include <cmath>

#include "run/steered_sedan.hpp"

namespace hamilcar {
namespace {

// With less friction than usual, so that the wheel comes back at low speed as well, and more damping, without which the free weave grows
// at high speed.
VehicleDescription easy() {
    VehicleDescription car = sedan();
    SteeringMechanicsDescription& d = *car.steering.mechanics;
    d.rack_friction = 10, d.rack_stiffness = 1e5, d.rack_damping = 400, d.wheel_friction = 0.02, d.wheel_stiffness = 2;
    d.wheel_damping = 0.3;
    return car;
}

struct Released {
    double before, opposite,
        after;     // of the rack: as held, its largest swing to the other side, where it comes to rest [m]
    double speed;  // in the end [m/s]
};

Released released(const VehicleDescription& car, double speed, double angle) {
    ScenarioDescription s = test::set_free(steered(14, speed, test::table({0.2, 2}, {0, angle})));
    s.hands = test::table({4, 4.05}, {1, 0});
    s.drive = test::table({0}, {60});  // against rolling resistance
    Simulation run(car, s);
    Released out{};
    watch(run, [&](const Sample& at) {
        const double rack = at.velocity.rack.displacement;
        if (at.time < 4) out.before = rack;
        out.opposite = std::max(out.opposite, -rack), out.after = rack, out.speed = at.velocity.chassis[0];
    });
    return out;
}

// The force of the tie rods per displacement of a rack that is held [N/m].
double aligning_stiffness(double speed, double rack) {
    ScenarioDescription s = test::scenario(4, speed);
    s.steering_input = SteeringInput::rack, s.steering = test::table({0.2, 1}, {0, rack});
    Simulation run(sedan(), s);
    test::run_to_end(run);
    return force_of_tie_rods(run.sample()) / rack;
}

double friction_at_rack(const VehicleDescription& car) {  // of rack and steering wheel [N]
    return car.steering.mechanics->rack_friction + car.steering.mechanics->wheel_friction * ratio();
}

TEST(SelfCentering, BringsTheWheelBackWithMoreOvershootAtSpeed) {
    double least = 0;
    const VehicleDescription light = easy();
    for (const auto& [speed, angle] :
         {std::pair(10.0, 3.4), std::pair(50.0, 1.2), std::pair(100.0, 0.45), std::pair(130.0, 0.35)}) {
        const Released car = released(light, speed / 3.6, angle);
        const double stiffness = aligning_stiffness(car.speed, 1e-3), friction = friction_at_rack(light),
                     overshoot = car.opposite / car.before;
        std::printf("%3.0f km/h: rack from %.2f mm to %.2f mm, friction holds %.2f mm, overshoot %.3f\n", speed,
                    1e3 * car.before, 1e3 * car.after, 1e3 * friction / stiffness, overshoot);
        EXPECT_GT(stiffness, 0);
        EXPECT_LT(std::abs(car.after), 0.5 * car.before) << "it returns";
        EXPECT_LT(std::abs(car.after), 1.05 * friction / stiffness);
        EXPECT_GE(overshoot, least) << "more of it at speed";
        least = overshoot;
    }
    EXPECT_GT(least, 0.1);
}

TEST(SelfCentering, EndsWhereUsualFrictionHolds) {
    for (const auto& [speed, angle] : {std::pair(50.0, 1.2), std::pair(100.0, 0.45), std::pair(130.0, 0.35)}) {
        const Released car = released(sedan(), speed / 3.6, angle);
        const double held = friction_at_rack(sedan()) / aligning_stiffness(car.speed, 1e-3);
        std::printf("%3.0f km/h: rack from %.2f mm to %.2f mm, friction holds %.2f mm\n", speed, 1e3 * car.before,
                    1e3 * car.after, 1e3 * held);
        EXPECT_LT(std::abs(car.after), 1.05 * held);
        EXPECT_GT(std::abs(car.after), 1e-6) << "not in the middle";
        EXPECT_LT(std::abs(car.after), 0.5 * car.before);
    }
}

// Torque of the hands over time, with a cleat under the wheels on one side or on both.
std::vector<double> kickback(double right, double left) {
    ScenarioDescription s = test::set_free(test::scenario(1, 15));
    s.road.obstacles.push_back({.start = 6, .length = 0.3, .height = 0.02, .right = right, .left = left});
    VehicleDescription car = sedan();
    car.steering.mechanics->joint_error = 0;  // which has a side
    Simulation run(car, s);
    std::vector<double> out;
    watch(run, [&](const Sample& at) { out.push_back(at.momenta.steering.hands_torque); });
    return out;
}

TEST(Kickback, ComesFromACleatOnOneSideWithTheSignOfTheSide) {
    const std::vector<double> left = kickback(0, everywhere), right = kickback(-everywhere, 0);
    const std::vector<double> both = kickback(-everywhere, everywhere);
    double most = 0, of_both = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_NEAR(left[i], -right[i], 1e-7) << i;
        most = std::max(most, std::abs(left[i])), of_both = std::max(of_both, std::abs(both[i]));
    }
    std::printf("hands feel up to %.2f N m, %.1e N m of a cleat under both wheels\n", most, of_both);
    EXPECT_LT(std::abs(left[20]), 1e-9) << "nothing before";
    EXPECT_GT(most, 0.2);
    EXPECT_LT(of_both, 1e-6 * most);
}

// Hands off on a side slope for an hour: what friction holds, it holds for good.
TEST(StickSlip, TheRackStandsStillUnderAConstantLoad) {
    ScenarioDescription s = test::set_free(test::scenario(3600));
    s.road.bank = 0.1, s.brake = test::table({0}, {0.5}), s.hands = test::table({0}, {0});
    s.solver.energy_balance = false;
    Simulation run(sedan(), s);
    double least = everywhere, most = -everywhere, after_a_minute = 0;
    while (!run.finished()) {
        ASSERT_FALSE(run.advance());
        if (run.time() < 10) continue;
        const double rack = test::steering_state(run.model(), run.state()).rack;
        least = std::min(least, rack), most = std::max(most, rack);
        if (run.time() < 60) after_a_minute = rack;
    }
    const double load = force_of_tie_rods(run.sample()), rack = test::steering_state(run.model(), run.state()).rack;
    std::printf("under %.1f N the rack moves by %.1e m in an hour, by %.1e m after the first minute\n", load,
                most - least, rack - after_a_minute);
    EXPECT_GT(std::abs(load), 10) << "there is a load";
    EXPECT_LT(std::abs(load), 150) << "that friction can hold";
    EXPECT_LT(most - least, 1e-9);
    EXPECT_LT(std::abs(rack - after_a_minute), 1e-14) << "it does not creep";
}

// All that hands, assist and friction exchange in a lane change, to a thousandth.
TEST(SteeringBalance, ClosesForALaneChange) {
    for (const char* name : {"bmw_323i", "bmw_e90_330i", "offroader"}) {
        const VehicleDescription car = test::with_mechanics(test::shipped(name), test::full_mechanics());
        Simulation run(car, test::set_free(steered(4, 25, test::table({0.2, 0.7, 1.4, 2.0}, {0, 0.5, -0.5, 0}))));
        double exchanged = 0;
        while (!run.finished()) {
            ASSERT_FALSE(run.advance());
            const Sample at = run.sample();
            const auto& steering = at.momenta.steering;
            exchanged += 1e-3 * (std::abs(steering.hands_torque * steering.wheel_rate) +
                                 std::abs((steering.assist_force + steering.friction) * at.velocity.rack.rate));
        }
        const double error = std::abs(run.sample().energy.balance() - run.initial_energy_balance());
        std::printf("%s: %.2f J exchanged by the steering, %.1e J missing\n", name, exchanged, error);
        EXPECT_GT(exchanged, 1);
        EXPECT_LT(error, 1e-3 * exchanged);
    }
}

}  // namespace
}  // namespace hamilcar
